// Suballocation: a few large blocks of device memory serve many buffers and images.
#pragma once

#include "burnish/vulkan/handle.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vulkan/vulkan.h>

namespace burnish::vulkan {

enum class MemoryUse {
    device,    // read and written by shaders; host access only if the device happens to share its memory
    upload,    // written by the host, read by the device
    read_back, // written by the device, read by the host
};

struct MemoryStatistics {
    std::size_t blocks = 0;          // VkDeviceMemory objects alive
    std::size_t allocations = 0;     // buffers and images placed in them
    VkDeviceSize reserved_bytes = 0; // size of all blocks
    VkDeviceSize used_bytes = 0;     // of these, in use
};

/// A size as messages give it: "12.5 MiB".
std::string mebibytes(VkDeviceSize size_bytes);

class MemoryPool;
struct MemoryBlock;

/// A range of a block; given back to its pool when dropped. Host-visible memory is always coherent and stays
/// mapped.
class Allocation {
public:
    Allocation() = default;
    Allocation(Allocation&& other) noexcept;
    Allocation& operator=(Allocation&& other) noexcept;
    ~Allocation();

    VkDeviceMemory memory() const;
    VkDeviceSize offset() const { return offset_; }
    VkDeviceSize size() const { return size_; }
    std::byte* mapped() const; // null if the host cannot see it

private:
    friend class MemoryPool;
    DevicePointer device_;
    MemoryBlock* block_ = nullptr;
    VkDeviceSize offset_ = 0, size_ = 0;
};

/// First fit over the free ranges of each block, neighbours merged on release. Buffers and optimally tiled
/// images live in separate blocks, so bufferImageGranularity never matters. Thread-safe.
class MemoryPool {
public:
    explicit MemoryPool(const Device& device, std::optional<VkDeviceSize> limit_bytes = {});
    ~MemoryPool();

    static constexpr VkDeviceSize block_bytes = VkDeviceSize{64} << 20;

    /// Throws OutOfMemoryError.
    Allocation allocate(const DevicePointer& device, const VkMemoryRequirements& needs, MemoryUse use,
                        bool is_image);
    MemoryStatistics statistics() const;

private:
    friend class Allocation;
    MemoryBlock& add_block(const Device& device, uint32_t memory_type, bool is_image, VkDeviceSize size);
    VkResult allocate_memory(const Device& device, uint32_t memory_type, MemoryBlock& block) const;
    void free_block(const MemoryBlock& block);
    void free_spares();
    void release(MemoryBlock& block, VkDeviceSize offset, VkDeviceSize size);
    uint32_t memory_type(uint32_t allowed_types, MemoryUse use) const;

    VkDevice device_;
    VkDeviceSize max_allocation_bytes_;
    std::optional<VkDeviceSize> limit_bytes_;
    VkPhysicalDeviceMemoryProperties properties_{};
    mutable std::mutex mutex_;
    std::list<std::unique_ptr<MemoryBlock>> blocks_;
    MemoryStatistics statistics_;
};

} // namespace burnish::vulkan
