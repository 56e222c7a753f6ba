#include "burnish/vulkan/command_frames.h"

#include "burnish/vulkan/result.h"

namespace burnish::vulkan {

CommandFrames::~CommandFrames() {
    for (const CommandFrame& frame : idle_)
        destroy(frame);
}

CommandFrame CommandFrames::acquire() {
    {
        std::scoped_lock lock(mutex_);
        if (!idle_.empty()) {
            CommandFrame frame = std::move(idle_.back());
            idle_.pop_back();
            return frame;
        }
    }
    return make();
}

void CommandFrames::release(CommandFrame frame) {
    std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(frame));
}

CommandFrame CommandFrames::make() const {
    CommandFrame frame;
    try {
        VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.queueFamilyIndex = queue_family_;
        vk_check(vkCreateCommandPool(device_, &pool, nullptr, &frame.pool), "vkCreateCommandPool");
        VkCommandBufferAllocateInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        buffer.commandPool = frame.pool;
        buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        buffer.commandBufferCount = 1;
        vk_check(vkAllocateCommandBuffers(device_, &buffer, &frame.commands), "vkAllocateCommandBuffers");
        const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        vk_check(vkCreateFence(device_, &fence, nullptr, &frame.fence), "vkCreateFence");
    } catch (...) {
        destroy(frame);
        throw;
    }
    return frame;
}

VkQueryPool CommandFrames::make_query_pool() const {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = queries_per_pool;
    VkQueryPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateQueryPool(device_, &info, nullptr, &pool), "vkCreateQueryPool");
    return pool;
}

void CommandFrames::destroy(const CommandFrame& frame) const {
    for (const VkQueryPool queries : frame.queries)
        vkDestroyQueryPool(device_, queries, nullptr);
    vkDestroyFence(device_, frame.fence, nullptr);
    vkDestroyCommandPool(device_, frame.pool, nullptr); // frees its command buffer
}

} // namespace burnish::vulkan
