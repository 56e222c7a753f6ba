// Moves data of any size between host and device through a bounded staging buffer. Each call submits and
// waits.
#pragma once

#include "burnish/vulkan/commands.h"

#include <cstddef>
#include <span>
#include <vector>

namespace burnish::vulkan {

struct TransferSettings {
    // Half a memory block, so that the staging buffer shares a block that is already there.
    VkDeviceSize staging_bytes = MemoryPool::block_bytes / 2;
    bool direct = true; // copy straight into buffers that the host can see
};

void upload(const Buffer& target, std::span<const std::byte> data, VkDeviceSize offset = 0,
            const TransferSettings& settings = {});
template <typename T>
void upload(const Buffer& target, std::span<const T> data, VkDeviceSize offset_bytes = 0) {
    upload(target, std::as_bytes(data), offset_bytes, TransferSettings{});
}
/// A new device buffer that holds `data`.
Buffer make_buffer(const DevicePointer& device, std::span<const std::byte> data, VkBufferUsageFlags usage);

/// `data` is tightly packed, layer after layer, and must fill the region exactly (std::invalid_argument
/// otherwise). The image is left in `final_layout`.
void upload(Image& target, const ImageRegion& region, std::span<const std::byte> data,
            VkImageLayout final_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
            const TransferSettings& settings = {});

std::vector<std::byte> read_back(const Buffer& source, VkDeviceSize offset = 0,
                                 VkDeviceSize size_bytes = VK_WHOLE_SIZE);
void read_back(const Buffer& source, std::span<std::byte> data, VkDeviceSize offset = 0,
               const TransferSettings& settings = {});

template <typename T>
std::vector<T> read_elements(const Buffer& source, std::size_t count) {
    std::vector<T> result(count);
    read_back(source, std::as_writable_bytes(std::span(result)));
    return result;
}

/// The image is brought back to the layout it was in.
std::vector<std::byte> read_back(Image& source, const ImageRegion& region);
void read_back(Image& source, const ImageRegion& region, std::span<std::byte> data,
               const TransferSettings& settings = {});

} // namespace burnish::vulkan
