// A scope that records commands; submit() runs them and waits.
#pragma once

#include "burnish/vulkan/buffer.h"
#include "burnish/vulkan/command_frames.h"
#include "burnish/vulkan/descriptor_set.h"
#include "burnish/vulkan/image.h"
#include "burnish/vulkan/pipeline.h"

#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace burnish::vulkan {

/// The bytes of a push-constant struct.
template <typename T>
std::span<const std::byte> push_bytes(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(std::span<const T, 1>(&value, 1));
}

struct ColorTarget {
    Image* image = nullptr;
    VkImageView view = VK_NULL_HANDLE;        // null = level 0 of every layer
    std::optional<VkClearColorValue> clear{}; // none = keep what is there
    bool store = true;
};

struct DepthTarget {
    Image* image = nullptr;
    VkImageView view = VK_NULL_HANDLE;
    std::optional<float> clear{};
    bool store = true;
};

struct RenderingTargets {
    std::vector<ColorTarget> colors{};
    std::optional<DepthTarget> depth{};
    VkRect2D area{}; // also the first viewport and scissor; extent 0 = all of the first target's level 0
    uint32_t view_mask = 0; // multiview; then the views are arrays
};

/// Texels of one level, of consecutive layers. Buffer side: tightly packed, layer after layer.
struct ImageRegion {
    uint32_t level = 0;
    uint32_t base_layer = 0, layer_count = 1;
    uint32_t x = 0, y = 0;
    uint32_t width = 0, height = 0; // 0 = up to the level's edge
};

/// The region with "up to the edge" spelled out. Throws std::invalid_argument if it leaves the image.
ImageRegion resolve_region(const Image& image, ImageRegion region);

struct PassTime {
    std::string kind;
    double milliseconds = 0; // 0 where the device has no timestamps
    std::string name = kind; // with its number, where there are several of a kind
};

/// Everything that the commands use must live until submit() returns. Nothing runs, and tracked image layouts
/// go back, if the scope ends without submit(). One thread per scope; several scopes may record and submit at
/// once.
class Commands {
public:
    explicit Commands(DevicePointer device);
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;
    ~Commands();

    // Every command below sees the results of an earlier one only after barrier() or transition().

    void dispatch(const ComputePipeline& pipeline, const DescriptorSet& set, std::span<const std::byte> push,
                  uint32_t groups_x, uint32_t groups_y = 1, uint32_t groups_z = 1);
    /// Reads a VkDispatchIndirectCommand at `offset` of `arguments`.
    void dispatch_indirect(const ComputePipeline& pipeline, const DescriptorSet& set,
                           std::span<const std::byte> push, const Buffer& arguments, VkDeviceSize offset = 0);

    /// Brings the targets into attachment layout (or leaves them in GENERAL) and starts drawing.
    void begin_rendering(const RenderingTargets& targets);
    void end_rendering();
    void set_viewport(const VkViewport& viewport);
    void set_scissor(const VkRect2D& scissor);
    void bind_graphics(const GraphicsPipeline& pipeline, const DescriptorSet& set,
                       std::span<const std::byte> push = {});
    /// New push constants for the pipeline bound last.
    void push_graphics(std::span<const std::byte> push);
    void bind_vertex_buffer(uint32_t binding, const Buffer& buffer, VkDeviceSize offset = 0);
    void bind_index_buffer(const Buffer& buffer, VkIndexType type, VkDeviceSize offset = 0);
    void draw(uint32_t vertices, uint32_t instances = 1, uint32_t first_vertex = 0,
              uint32_t first_instance = 0);
    void draw_indexed(uint32_t indices, uint32_t instances = 1, uint32_t first_index = 0,
                      int32_t vertex_offset = 0, uint32_t first_instance = 0);

    // Transfers bring images into a transfer layout first, unless they are in GENERAL.
    void copy_buffer(const Buffer& source, const Buffer& target, VkDeviceSize size_bytes,
                     VkDeviceSize source_offset = 0, VkDeviceSize target_offset = 0);
    void copy_buffer_to_image(const Buffer& source, VkDeviceSize offset, Image& target,
                              const ImageRegion& region);
    void copy_image_to_buffer(Image& source, const ImageRegion& region, const Buffer& target,
                              VkDeviceSize offset);
    /// `size_bytes` and `offset` are multiples of 4.
    void fill_buffer(const Buffer& buffer, uint32_t value, VkDeviceSize offset = 0,
                     VkDeviceSize size_bytes = VK_WHOLE_SIZE);
    void clear_color_image(Image& image, const VkClearColorValue& value);
    /// Whole regions, stretched; the same image may be both sides if it is in GENERAL and the levels differ.
    void blit(Image& source, const ImageRegion& from, Image& target, const ImageRegion& to, VkFilter filter);
    /// Makes each level of all layers from the one above it, by linear blits; the image is in GENERAL.
    void blit_levels(Image& image);

    /// Makes all earlier commands' results visible to all later ones and moves the image to `layout`.
    void transition(Image& image, VkImageLayout layout);
    /// Makes all earlier commands' results (compute, graphics, transfer) visible to all later ones, also to
    /// indirect arguments.
    void barrier();

    /// A span of commands that is timed and labelled; not inside begin_rendering, not nested. Both ends are
    /// barriers.
    void begin_pass(std::string kind, std::optional<uint32_t> number = {});
    void end_pass();

    /// Runs the commands and waits. Throws VulkanError (also for validation errors). Once per scope.
    void submit();
    /// After submit(): the passes in order. Passes of one name are listed separately.
    const std::vector<PassTime>& pass_times() const;

    VkCommandBuffer handle() const { return frame_.commands; }

private:
    void bind(const PipelineInterface& interface, VkPipeline pipeline, const DescriptorSet& set,
              std::span<const std::byte> push);
    void push(const PipelineInterface& interface, std::span<const std::byte> bytes);
    void require(bool condition, const char* text) const;
    void require_outside_rendering(const char* what) const;
    void use_for_transfer(Image& image, VkImageLayout layout);
    void record_barrier(const VkImageMemoryBarrier2* image);
    void write_timestamp(std::size_t query);
    void read_timestamps();

    struct LayoutChange {
        std::shared_ptr<VkImageLayout> layout;
        VkImageLayout before;
    };

    DevicePointer device_;
    CommandFrame frame_;
    std::vector<LayoutChange> layout_changes_;
    std::vector<PassTime> passes_;
    std::shared_ptr<const PipelineInterface> graphics_; // of the pipeline bound last
    bool is_rendering_ = false, is_in_pass_ = false, is_submitted_ = false;
};

} // namespace burnish::vulkan
