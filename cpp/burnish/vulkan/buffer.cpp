#include "burnish/vulkan/buffer.h"

#include "burnish/vulkan/device.h"
#include "burnish/vulkan/result.h"

namespace burnish::vulkan {

Buffer::Buffer(const DevicePointer& device, VkDeviceSize size_bytes, VkBufferUsageFlags usage, MemoryUse use)
    : size_bytes_(size_bytes) {
    const VkDeviceSize largest = device->features().max_allocation_bytes;
    if (size_bytes == 0)
        throw std::invalid_argument(message("size_bytes: expected 1..", largest, " for a buffer, got 0"));
    if (size_bytes > largest) { // vkCreateBuffer need not know such sizes
        throw OutOfMemoryError(message("expected at most ", mebibytes(largest), " in one buffer on ",
                                       device->info().name, ", got ", mebibytes(size_bytes)));
    }
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size_bytes;
    info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    vk_check(vkCreateBuffer(device->handle(), &info, nullptr, &buffer), "vkCreateBuffer");
    buffer_ = {device, buffer};

    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device->handle(), buffer, &needs);
    allocation_ = device->memory().allocate(device, needs, use, false);
    vk_check(vkBindBufferMemory(device->handle(), buffer, allocation_.memory(), allocation_.offset()),
             "vkBindBufferMemory");
}

bool Buffer::is_host_memory() const {
    return is_mapped() && device()->info().is_software;
}

std::byte* Buffer::mapped_bytes() const {
    if (!is_mapped())
        throw std::logic_error("buffer: expected memory that the host can see, got device memory");
    return allocation_.mapped();
}

TexelView texel_view(const Buffer& buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size_bytes) {
    VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
    info.buffer = buffer.handle();
    info.format = format;
    info.offset = offset;
    info.range = size_bytes;
    VkBufferView view = VK_NULL_HANDLE;
    vk_check(vkCreateBufferView(buffer.device()->handle(), &info, nullptr, &view), "vkCreateBufferView");
    return {buffer.device(), view};
}

} // namespace burnish::vulkan
