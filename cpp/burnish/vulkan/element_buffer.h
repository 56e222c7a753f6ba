// Elements that kernels read as texels where a texel buffer of the device holds so many, else from a storage
// buffer.
#pragma once

#include <string>

#include "burnish/vulkan/buffer.h"
#include "burnish/vulkan/descriptor_set.h"

namespace burnish::vulkan {

/// How a kernel gets at the elements of a buffer. Texels are several times cheaper on CPU devices; Vulkan
/// promises no more than 65536 of them, and storage buffers of 2^27 bytes.
enum class ElementAccess { texels, storage };

/// Kernels declare both bindings and choose by a specialization constant; both are always written.
class ElementBuffer {
public:
    ElementBuffer() = default;
    /// `count` elements of `format`, not initialised.
    ElementBuffer(const DevicePointer& device, uint64_t count, VkFormat format, ElementAccess access);

    const Buffer& buffer() const { return buffer_; }
    ElementAccess access() const { return access_; }
    void bind(DescriptorSet& set, uint32_t texel_binding, uint32_t storage_binding) const;

private:
    Buffer buffer_;
    TexelView view_; // of the first element alone where it is storage
    VkDeviceSize element_bytes_ = 0;
    ElementAccess access_ = ElementAccess::texels;
};

/// Texels where they fit. Throws VulkanError, which begins with `what`, where a storage buffer cannot hold
/// them either.
ElementAccess fitting_access(const Device& device, uint64_t count, VkFormat format, const std::string& what);

} // namespace burnish::vulkan
