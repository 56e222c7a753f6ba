// Finds the devices and says why each can or cannot be used. Internal to the Vulkan layer.
#pragma once

#include "burnish/vulkan/device.h"

namespace burnish::vulkan {

struct Instance {
    VkInstance handle = VK_NULL_HANDLE;
    bool has_debug_utils = false;
};

/// `log` != null turns the validation layer on. Throws VulkanError that names the package that is missing.
Instance make_instance(ValidationLog* log);

struct Candidate {
    DeviceInfo info;
    VkPhysicalDevice device = VK_NULL_HANDLE;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    uint32_t queue_family = 0;
};

std::vector<Candidate> find_candidates(VkInstance instance);

/// The best usable candidate whose name contains `name`. Throws VulkanError that lists every device.
const Candidate& choose_candidate(const std::vector<Candidate>& candidates, const std::string& name);

} // namespace burnish::vulkan
