// Turns a failed Vulkan call into a VulkanError that names the call, the result code and the place.
#pragma once

#include "burnish/error.h"

#include <source_location>
#include <vulkan/vulkan.h>

namespace burnish::vulkan {

/// The enumerator's own name, e.g. "VK_ERROR_DEVICE_LOST".
const char* result_name(VkResult result);

bool is_out_of_memory(VkResult result);

/// Throws VulkanError, for lack of memory OutOfMemoryError, unless `result` is VK_SUCCESS. `what` is the
/// Vulkan function that returned it.
void vk_check(VkResult result, const char* what,
              std::source_location place = std::source_location::current());

} // namespace burnish::vulkan
