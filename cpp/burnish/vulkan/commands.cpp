// The scope itself: begin, compute, barriers, passes, submit. Drawing and copying have their own files.
#include "burnish/vulkan/commands.h"

#include "burnish/vulkan/device.h"
#include "burnish/vulkan/result.h"

#include <limits>

namespace burnish::vulkan {

Commands::Commands(DevicePointer device) : device_(std::move(device)) {
    device_->require_usable();
    frame_ = device_->frames().acquire();
    try {
        vk_check(vkResetCommandPool(device_->handle(), frame_.pool, 0), "vkResetCommandPool");
        VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        vk_check(vkBeginCommandBuffer(frame_.commands, &info), "vkBeginCommandBuffer");
    } catch (...) {
        device_->frames().release(std::move(frame_));
        throw;
    }
}

Commands::~Commands() {
    if (!is_submitted_) {
        for (auto change = layout_changes_.rbegin(); change != layout_changes_.rend(); ++change) {
            *change->layout = change->before;
        }
    }
    device_->frames().release(std::move(frame_));
}

void Commands::require(bool condition, const char* text) const {
    if (!condition) throw std::logic_error(message("commands: expected ", text));
}

void Commands::require_outside_rendering(const char* what) const {
    if (is_submitted_)
        throw std::logic_error(message("commands: expected no ", what, " after submit(), got one"));
    if (is_rendering_) {
        throw std::logic_error(
            message("commands: expected ", what, " outside begin_rendering, got it inside"));
    }
}

void Commands::push(const PipelineInterface& interface, std::span<const std::byte> bytes) {
    if (bytes.size() != interface.push_constant_bytes) {
        throw std::invalid_argument(message(interface.name, ": expected ", interface.push_constant_bytes,
                                            " bytes of push constants, got ", bytes.size()));
    }
    if (bytes.empty()) return;
    vkCmdPushConstants(frame_.commands, interface.layout.get(), interface.stages, 0,
                       interface.push_constant_bytes, bytes.data());
}

void Commands::bind(const PipelineInterface& interface, VkPipeline pipeline, const DescriptorSet& set,
                    std::span<const std::byte> push_constants) {
    set.require_complete();
    if (&set.interface() != &interface && !is_same_layout(set.interface(), interface)) {
        throw std::logic_error(message(
            interface.name, ": expected a descriptor set made for it, got one for ", set.interface().name));
    }
    vkCmdBindPipeline(frame_.commands, interface.bind_point, pipeline);
    const VkDescriptorSet handle = set.handle();
    vkCmdBindDescriptorSets(frame_.commands, interface.bind_point, interface.layout.get(), 0, 1, &handle, 0,
                            nullptr);
    push(interface, push_constants);
}

void Commands::dispatch(const ComputePipeline& pipeline, const DescriptorSet& set,
                        std::span<const std::byte> push_constants, uint32_t groups_x, uint32_t groups_y,
                        uint32_t groups_z) {
    require_outside_rendering("dispatch");
    bind(pipeline.interface(), pipeline.handle(), set, push_constants);
    const auto& most = device_->limits().maxComputeWorkGroupCount;
    if (groups_x > most[0] || groups_y > most[1] || groups_z > most[2]) {
        throw std::invalid_argument(message(pipeline.interface().name, ": expected at most ", most[0], " x ",
                                            most[1], " x ", most[2], " groups, got ", groups_x, " x ",
                                            groups_y, " x ", groups_z));
    }
    vkCmdDispatch(frame_.commands, groups_x, groups_y, groups_z);
}

void Commands::dispatch_indirect(const ComputePipeline& pipeline, const DescriptorSet& set,
                                 std::span<const std::byte> push_constants, const Buffer& arguments,
                                 VkDeviceSize offset) {
    require_outside_rendering("dispatch_indirect");
    bind(pipeline.interface(), pipeline.handle(), set, push_constants);
    vkCmdDispatchIndirect(frame_.commands, arguments.handle(), offset);
}

void Commands::transition(Image& image, VkImageLayout layout) {
    require_outside_rendering("transition");
    if (image.layout() == layout) {
        barrier();
        return;
    }
    VkImageMemoryBarrier2 change{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    change.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    change.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    change.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    change.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    change.oldLayout = image.layout();
    change.newLayout = layout;
    change.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    change.image = image.handle();
    change.subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    record_barrier(&change);
    layout_changes_.push_back({image.layout_, image.layout()});
    *image.layout_ = layout;
}

void Commands::barrier() {
    require_outside_rendering("barrier");
    record_barrier(nullptr);
}

void Commands::record_barrier(const VkImageMemoryBarrier2* image) {
    VkMemoryBarrier2 all{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    all.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    all.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    // The host is not among "all commands"; it reads mapped buffers after the wait in submit().
    all.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
    all.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &all;
    info.imageMemoryBarrierCount = image ? 1 : 0;
    info.pImageMemoryBarriers = image;
    vkCmdPipelineBarrier2(frame_.commands, &info);
}

void Commands::begin_pass(std::string kind, std::optional<uint32_t> number) {
    require_outside_rendering("begin_pass"); // drivers defer draws, so a time inside would mean nothing
    require(!is_in_pass_, "passes one after the other, got a nested one");
    is_in_pass_ = true;
    passes_.push_back({std::move(kind), 0});
    if (number) passes_.back().name += message(" ", *number);
    if (device_->begin_label) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = passes_.back().name.c_str();
        device_->begin_label(frame_.commands, &label);
    }
    write_timestamp(2 * (passes_.size() - 1));
    // lavapipe 22.3 puts the time down when it next flushes, which compute work alone does not make it do:
    // without a barrier here a pass of dispatches starts when it ends.
    barrier();
}

void Commands::end_pass() {
    require_outside_rendering("end_pass");
    require(is_in_pass_, "begin_pass before end_pass");
    is_in_pass_ = false;
    barrier(); // the pass ends when its work does
    write_timestamp(2 * (passes_.size() - 1) + 1);
    if (device_->end_label) device_->end_label(frame_.commands);
}

void Commands::write_timestamp(std::size_t query) {
    if (!device_->features().timestamps) return;
    const std::size_t pool = query / CommandFrames::queries_per_pool;
    const uint32_t slot = static_cast<uint32_t>(query % CommandFrames::queries_per_pool);
    if (frame_.queries.size() <= pool) frame_.queries.push_back(device_->frames().make_query_pool());
    if (slot == 0) {
        vkCmdResetQueryPool(frame_.commands, frame_.queries[pool], 0, CommandFrames::queries_per_pool);
    }
    // Both ends wait for all earlier commands, so that passes divided by barriers do not share time.
    vkCmdWriteTimestamp2(frame_.commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, frame_.queries[pool], slot);
}

void Commands::read_timestamps() {
    const DeviceFeatures& features = device_->features();
    if (!features.timestamps) return;
    const uint64_t mask = features.timestamp_valid_bits >= 64
                              ? std::numeric_limits<uint64_t>::max()
                              : (uint64_t{1} << features.timestamp_valid_bits) - 1;
    for (std::size_t i = 0; i < passes_.size(); ++i) {
        const std::size_t query = 2 * i; // a pool holds an even number, so both ends are in one
        uint64_t ticks[2] = {};
        device_->check(
            vkGetQueryPoolResults(device_->handle(), frame_.queries[query / CommandFrames::queries_per_pool],
                                  static_cast<uint32_t>(query % CommandFrames::queries_per_pool), 2,
                                  sizeof(ticks), ticks, sizeof(uint64_t), VK_QUERY_RESULT_64_BIT),
            "vkGetQueryPoolResults");
        const uint64_t elapsed = (ticks[1] - ticks[0]) & mask; // right also across a wrap
        passes_[i].milliseconds = static_cast<double>(elapsed) * features.timestamp_period_ns * 1e-6;
    }
}

void Commands::submit() {
    require_outside_rendering("submit");
    require(!is_in_pass_, "end_pass before submit");
    record_barrier(nullptr);
    vk_check(vkEndCommandBuffer(frame_.commands), "vkEndCommandBuffer");
    device_->raise_validation_errors();
    device_->submit(frame_.commands, frame_.fence);
    is_submitted_ = true;
    device_->wait(frame_.fence);
    read_timestamps();
    device_->raise_validation_errors();
}

const std::vector<PassTime>& Commands::pass_times() const {
    require(is_submitted_, "pass_times after submit, got it before");
    return passes_;
}

} // namespace burnish::vulkan
