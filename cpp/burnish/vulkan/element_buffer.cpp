#include "burnish/vulkan/element_buffer.h"

#include "burnish/error.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/image.h"

namespace burnish::vulkan {

ElementBuffer::ElementBuffer(const DevicePointer& device, uint64_t count, VkFormat format,
                             ElementAccess access)
    : buffer_(device, count * texel_bytes(format),
              VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
      view_(texel_view(buffer_, format, 0,
                       access == ElementAccess::texels ? VK_WHOLE_SIZE : texel_bytes(format))),
      element_bytes_(texel_bytes(format)), access_(access) {}

void ElementBuffer::bind(DescriptorSet& set, uint32_t texel_binding, uint32_t storage_binding) const {
    set.bind_texel_buffer(texel_binding, view_)
        .bind(storage_binding, buffer_, 0,
              access_ == ElementAccess::storage ? VK_WHOLE_SIZE : element_bytes_);
}

ElementAccess fitting_access(const Device& device, uint64_t count, VkFormat format, const std::string& what) {
    if (count <= device.limits().maxTexelBufferElements) return ElementAccess::texels;
    const uint64_t most = device.limits().maxStorageBufferRange / texel_bytes(format);
    if (count <= most) return ElementAccess::storage;
    throw VulkanError(message(what, ": expected at most ", most,
                              " elements, which a storage buffer of the device holds, got ", count));
}

} // namespace burnish::vulkan
