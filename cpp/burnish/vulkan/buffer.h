// A buffer and its memory.
#pragma once

#include "burnish/vulkan/memory.h"

#include <span>

namespace burnish::vulkan {

class Buffer {
public:
    Buffer() = default;
    /// `usage` is what shaders and draws do with it; transfer in both directions is always allowed.
    Buffer(const DevicePointer& device, VkDeviceSize size_bytes, VkBufferUsageFlags usage,
           MemoryUse use = MemoryUse::device);

    VkBuffer handle() const { return buffer_.get(); }
    VkDeviceSize size_bytes() const { return size_bytes_; }
    const DevicePointer& device() const { return buffer_.device(); }
    bool is_mapped() const { return allocation_.mapped() != nullptr; }
    /// Whether the host reads it as fast as its own memory: it is mapped, and the device is a CPU.
    bool is_host_memory() const;

    /// The whole elements that fit, as the host sees them. Throws std::logic_error if the host cannot see the
    /// memory.
    template <typename T = std::byte>
    std::span<T> mapped() const {
        return {reinterpret_cast<T*>(mapped_bytes()), static_cast<std::size_t>(size_bytes_ / sizeof(T))};
    }

private:
    std::byte* mapped_bytes() const;

    Allocation allocation_; // before buffer_, so that it is given back after the buffer is gone
    Handle<VkBuffer, vkDestroyBuffer> buffer_;
    VkDeviceSize size_bytes_ = 0;
};

using TexelView = Handle<VkBufferView, vkDestroyBufferView>;

/// The buffer seen as texels of `format` (samplerBuffer, imageBuffer). The buffer must outlive it.
TexelView texel_view(const Buffer& buffer, VkFormat format, VkDeviceSize offset = 0,
                     VkDeviceSize size_bytes = VK_WHOLE_SIZE);

} // namespace burnish::vulkan
