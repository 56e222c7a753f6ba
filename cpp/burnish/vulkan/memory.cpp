#include "burnish/vulkan/memory.h"

#include "burnish/vulkan/device.h"
#include "burnish/vulkan/result.h"

#include <algorithm>
#include <iomanip>
#include <limits>

namespace burnish::vulkan {

namespace {

constexpr VkMemoryPropertyFlags host_visible =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags host_readable = host_visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

} // namespace

struct MemoryBlock {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    uint32_t memory_type = 0;
    bool is_image = false;
    bool is_dedicated = false; // holds one large resource and goes away with it
    std::byte* mapped = nullptr;
    std::map<VkDeviceSize, VkDeviceSize> free; // offset -> size, no two ranges touch

    bool is_empty() const { return free.size() == 1 && free.begin()->second == size; }

    /// Offset of `bytes` free bytes, taken; or nothing.
    bool take(VkDeviceSize bytes, VkDeviceSize alignment, VkDeviceSize& offset) {
        for (auto range = free.begin(); range != free.end(); ++range) {
            const auto [begin, length] = *range;
            offset = align_up(begin, alignment);
            if (offset + bytes > begin + length) continue;
            free.erase(range);
            if (offset > begin) free[begin] = offset - begin;
            if (offset + bytes < begin + length) free[offset + bytes] = begin + length - offset - bytes;
            return true;
        }
        return false;
    }

    void give_back(VkDeviceSize offset, VkDeviceSize bytes) {
        const auto next = free.lower_bound(offset);
        if (next != free.begin()) {
            const auto previous = std::prev(next);
            if (previous->first + previous->second == offset) {
                offset = previous->first;
                bytes += previous->second;
                free.erase(previous);
            }
        }
        if (next != free.end() && offset + bytes == next->first) {
            bytes += next->second;
            free.erase(next);
        }
        free[offset] = bytes;
    }
};

Allocation::Allocation(Allocation&& other) noexcept {
    *this = std::move(other);
}

Allocation& Allocation::operator=(Allocation&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(block_, other.block_);
    std::swap(offset_, other.offset_);
    std::swap(size_, other.size_);
    return *this;
}

Allocation::~Allocation() {
    if (block_) device_->memory().release(*block_, offset_, size_);
}

VkDeviceMemory Allocation::memory() const {
    return block_->memory;
}

std::byte* Allocation::mapped() const {
    return block_ && block_->mapped ? block_->mapped + offset_ : nullptr;
}

std::string mebibytes(VkDeviceSize size_bytes) {
    const double size = static_cast<double>(size_bytes) / (1 << 20);
    return message(std::fixed, std::setprecision(size < 10 ? 3 : 1), size, " MiB");
}

MemoryPool::MemoryPool(const Device& device, std::optional<VkDeviceSize> limit_bytes)
    : device_(device.handle()), max_allocation_bytes_(device.features().max_allocation_bytes),
      limit_bytes_(limit_bytes) {
    vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties_);
}

MemoryPool::~MemoryPool() {
    for (const auto& block : blocks_)
        vkFreeMemory(device_, block->memory, nullptr);
}

uint32_t MemoryPool::memory_type(uint32_t allowed_types, MemoryUse use) const {
    // Wishes, best first. Vulkan promises a host-visible coherent type for every buffer.
    std::vector<VkMemoryPropertyFlags> wishes;
    if (use == MemoryUse::device) wishes = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    if (use == MemoryUse::upload) wishes = {host_visible};
    if (use == MemoryUse::read_back) wishes = {host_readable, host_visible};
    for (const VkMemoryPropertyFlags wish : wishes) {
        for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
            const bool is_allowed = (allowed_types >> i & 1u) != 0;
            if (is_allowed && (properties_.memoryTypes[i].propertyFlags & wish) == wish) return i;
        }
    }
    throw VulkanError("memory: expected a memory type that fits, got none");
}

VkResult MemoryPool::allocate_memory(const Device& device, uint32_t memory_type, MemoryBlock& block) const {
    if (limit_bytes_ && block.size > *limit_bytes_ - std::min(*limit_bytes_, statistics_.reserved_bytes))
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (const VkResult fault = device.take_fault("vkAllocateMemory"); fault != VK_SUCCESS) return fault;
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = block.size;
    info.memoryTypeIndex = memory_type;
    return vkAllocateMemory(device_, &info, nullptr, &block.memory);
}

MemoryBlock& MemoryPool::add_block(const Device& device, uint32_t memory_type, bool is_image,
                                   VkDeviceSize size) {
    auto block = std::make_unique<MemoryBlock>();
    block->size = size;
    block->memory_type = memory_type;
    block->is_image = is_image;
    block->free[0] = size;
    VkResult result = allocate_memory(device, memory_type, *block);
    if (is_out_of_memory(result)) {
        free_spares();
        result = allocate_memory(device, memory_type, *block);
    }
    if (is_out_of_memory(result)) {
        const std::string limit = limit_bytes_ ? " of the allowed " + mebibytes(*limit_bytes_) : "";
        throw OutOfMemoryError(message("expected ", mebibytes(size), " more memory on ", device.info().name,
                                       ", got ", result_name(result), " with ",
                                       mebibytes(statistics_.reserved_bytes), limit, " taken"));
    }
    vk_check(result, "vkAllocateMemory");
    // Uncached memory is mapped only where the host just writes: reading it back is slower than a copy.
    const VkMemoryPropertyFlags flags = properties_.memoryTypes[memory_type].propertyFlags;
    const bool is_shared = (flags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
    const VkMemoryPropertyFlags needed = is_shared ? host_readable : host_visible;
    if (!is_image && (flags & needed) == needed) {
        void* address = nullptr;
        const VkResult mapping = vkMapMemory(device_, block->memory, 0, VK_WHOLE_SIZE, 0, &address);
        if (mapping != VK_SUCCESS) vkFreeMemory(device_, block->memory, nullptr);
        vk_check(mapping, "vkMapMemory");
        block->mapped = static_cast<std::byte*>(address);
    }
    statistics_.blocks += 1;
    statistics_.reserved_bytes += size;
    blocks_.push_back(std::move(block));
    return *blocks_.back();
}

Allocation MemoryPool::allocate(const DevicePointer& device, const VkMemoryRequirements& needs, MemoryUse use,
                                bool is_image) {
    if (needs.size > max_allocation_bytes_) {
        throw OutOfMemoryError(message("expected at most ", mebibytes(max_allocation_bytes_),
                                       " in one buffer or image on ", device->info().name, ", got ",
                                       mebibytes(needs.size)));
    }
    const uint32_t type = memory_type(needs.memoryTypeBits, use);
    const VkDeviceSize heap = std::min(properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size,
                                       limit_bytes_.value_or(std::numeric_limits<VkDeviceSize>::max()));
    const VkDeviceSize usual = std::min(block_bytes, align_up(heap / 8, 4096)); // small heaps: small blocks

    std::scoped_lock lock(mutex_);
    Allocation allocation;
    const bool is_dedicated = needs.size > usual / 2;
    for (const auto& block : blocks_) {
        if (is_dedicated || block->is_dedicated) continue;
        if (block->memory_type != type || block->is_image != is_image) continue;
        if (!block->take(needs.size, needs.alignment, allocation.offset_)) continue;
        allocation.block_ = block.get();
        break;
    }
    if (!allocation.block_) {
        MemoryBlock& block = add_block(*device, type, is_image, is_dedicated ? needs.size : usual);
        block.is_dedicated = is_dedicated;
        block.take(needs.size, needs.alignment, allocation.offset_);
        allocation.block_ = &block;
    }
    allocation.device_ = device;
    allocation.size_ = needs.size;
    statistics_.allocations += 1;
    statistics_.used_bytes += needs.size;
    return allocation;
}

void MemoryPool::release(MemoryBlock& block, VkDeviceSize offset, VkDeviceSize size) {
    std::scoped_lock lock(mutex_);
    statistics_.allocations -= 1;
    statistics_.used_bytes -= size;
    block.give_back(offset, size);
    if (!block.is_empty()) return;
    // One empty block of a kind stays, so that work in a loop does not allocate and free in turns.
    const bool is_spare = std::none_of(blocks_.begin(), blocks_.end(), [&](const auto& other) {
        return other.get() != &block && !other->is_dedicated && other->is_empty() &&
               other->memory_type == block.memory_type && other->is_image == block.is_image;
    });
    if (is_spare && !block.is_dedicated) return;
    free_block(block);
    blocks_.remove_if([&](const auto& other) { return other.get() == &block; });
}

void MemoryPool::free_block(const MemoryBlock& block) {
    vkFreeMemory(device_, block.memory, nullptr);
    statistics_.blocks -= 1;
    statistics_.reserved_bytes -= block.size;
}

void MemoryPool::free_spares() {
    blocks_.remove_if([&](const auto& block) {
        if (block->is_empty()) free_block(*block);
        return block->is_empty();
    });
}

MemoryStatistics MemoryPool::statistics() const {
    std::scoped_lock lock(mutex_);
    return statistics_;
}

} // namespace burnish::vulkan
