// Command buffers, fences and query pools, recycled so that many small frames leave memory flat.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>
#include <vulkan/vulkan.h>

namespace burnish::vulkan {

/// What one Commands scope needs. Raw handles: the device owns them.
struct CommandFrame {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    std::vector<VkQueryPool> queries; // timestamps, `queries_per_pool` each
};

/// Thread-safe.
class CommandFrames {
public:
    CommandFrames(VkDevice device, uint32_t queue_family) : device_(device), queue_family_(queue_family) {}
    ~CommandFrames();

    static constexpr uint32_t queries_per_pool = 64;

    CommandFrame acquire();
    void release(CommandFrame frame);
    VkQueryPool make_query_pool() const;

private:
    CommandFrame make() const;
    void destroy(const CommandFrame& frame) const;

    VkDevice device_;
    uint32_t queue_family_;
    std::mutex mutex_;
    std::vector<CommandFrame> idle_;
};

} // namespace burnish::vulkan
