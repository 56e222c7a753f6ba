// Commands: dynamic rendering and draws.
#include "burnish/vulkan/commands.h"

#include "burnish/error.h"
#include "burnish/vulkan/device.h"

namespace burnish::vulkan {

namespace {

VkImageView whole_level(const Image& image) {
    return image.settings().layers > 1 ? image.level_view(0) : image.layer_view(0, 0);
}

/// What a color and a depth attachment have in common.
VkRenderingAttachmentInfo attachment_info(const Image& image, VkImageView view, bool is_cleared, bool store) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = view != VK_NULL_HANDLE ? view : whole_level(image);
    info.imageLayout = image.layout();
    info.loadOp = is_cleared ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return info;
}

} // namespace

void Commands::begin_rendering(const RenderingTargets& targets) {
    require_outside_rendering("begin_rendering");
    require(!targets.colors.empty() || targets.depth, "at least one target, got none");
    const auto use = [&](Image& image) {
        if (image.layout() != VK_IMAGE_LAYOUT_GENERAL &&
            image.layout() != VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL) {
            transition(image, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
        }
    };
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const ColorTarget& color : targets.colors) {
        use(*color.image);
        colors.push_back(attachment_info(*color.image, color.view, color.clear.has_value(), color.store));
        if (color.clear) colors.back().clearValue.color = *color.clear;
    }
    VkRenderingAttachmentInfo depth{};
    if (targets.depth) {
        use(*targets.depth->image);
        depth = attachment_info(*targets.depth->image, targets.depth->view, targets.depth->clear.has_value(),
                                targets.depth->store);
        if (targets.depth->clear) depth.clearValue.depthStencil = {*targets.depth->clear, 0};
    }

    VkRect2D area = targets.area;
    if (area.extent.width == 0 || area.extent.height == 0) {
        const Image& first = targets.colors.empty() ? *targets.depth->image : *targets.colors.front().image;
        area = {{0, 0}, {first.settings().width, first.settings().height}};
    }
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = area;
    info.layerCount = 1;
    info.viewMask = targets.view_mask;
    info.colorAttachmentCount = static_cast<uint32_t>(colors.size());
    info.pColorAttachments = colors.data();
    info.pDepthAttachment = targets.depth ? &depth : nullptr;
    vkCmdBeginRendering(frame_.commands, &info);
    is_rendering_ = true;
    set_viewport({static_cast<float>(area.offset.x), static_cast<float>(area.offset.y),
                  static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1});
    set_scissor(area);
}

void Commands::end_rendering() {
    require(is_rendering_, "begin_rendering before end_rendering");
    vkCmdEndRendering(frame_.commands);
    is_rendering_ = false;
    graphics_.reset();
}

void Commands::set_viewport(const VkViewport& viewport) {
    vkCmdSetViewport(frame_.commands, 0, 1, &viewport);
}

void Commands::set_scissor(const VkRect2D& scissor) {
    vkCmdSetScissor(frame_.commands, 0, 1, &scissor);
}

void Commands::bind_graphics(const GraphicsPipeline& pipeline, const DescriptorSet& set,
                             std::span<const std::byte> push_constants) {
    require(is_rendering_, "bind_graphics inside begin_rendering, got it outside");
    bind(pipeline.interface(), pipeline.handle(), set, push_constants);
    graphics_ = pipeline.shared_interface();
}

void Commands::push_graphics(std::span<const std::byte> push_constants) {
    require(graphics_ != nullptr, "bind_graphics before push_graphics");
    push(*graphics_, push_constants);
}

void Commands::bind_vertex_buffer(uint32_t binding, const Buffer& buffer, VkDeviceSize offset) {
    const VkBuffer handle = buffer.handle();
    vkCmdBindVertexBuffers(frame_.commands, binding, 1, &handle, &offset);
}

void Commands::bind_index_buffer(const Buffer& buffer, VkIndexType type, VkDeviceSize offset) {
    vkCmdBindIndexBuffer(frame_.commands, buffer.handle(), offset, type);
}

void Commands::draw(uint32_t vertices, uint32_t instances, uint32_t first_vertex, uint32_t first_instance) {
    require(graphics_ != nullptr, "bind_graphics before a draw");
    vkCmdDraw(frame_.commands, vertices, instances, first_vertex, first_instance);
}

void Commands::draw_indexed(uint32_t indices, uint32_t instances, uint32_t first_index, int32_t vertex_offset,
                            uint32_t first_instance) {
    require(graphics_ != nullptr, "bind_graphics before a draw");
    vkCmdDrawIndexed(frame_.commands, indices, instances, first_index, vertex_offset, first_instance);
}

} // namespace burnish::vulkan
