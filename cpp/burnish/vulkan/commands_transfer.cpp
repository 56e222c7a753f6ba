// Commands: copies, fills, clears and blits.
#include "burnish/vulkan/commands.h"

#include "burnish/error.h"
#include "burnish/vulkan/device.h"

namespace burnish::vulkan {

namespace {

VkImageSubresourceLayers subresource(const Image& image, const ImageRegion& region) {
    return {image.aspect(), region.level, region.base_layer, region.layer_count};
}

VkBufferImageCopy buffer_copy(const Image& image, const ImageRegion& region, VkDeviceSize offset) {
    VkBufferImageCopy copy{};
    copy.bufferOffset = offset;
    copy.imageSubresource = subresource(image, region);
    copy.imageOffset = {static_cast<int32_t>(region.x), static_cast<int32_t>(region.y), 0};
    copy.imageExtent = {region.width, region.height, 1};
    return copy;
}

void require_room(const Image& image, const ImageRegion& region, const Buffer& buffer, VkDeviceSize offset) {
    const VkDeviceSize bytes = VkDeviceSize{region.width} * region.height * region.layer_count *
                               texel_bytes(image.settings().format);
    if (offset <= buffer.size_bytes() && bytes <= buffer.size_bytes() - offset) return;
    throw std::invalid_argument(message("buffer: expected ", bytes, " bytes at offset ", offset,
                                        " for the image's region, got a buffer of ", buffer.size_bytes()));
}

} // namespace

ImageRegion resolve_region(const Image& image, ImageRegion region) {
    const ImageSettings& settings = image.settings();
    const bool has_level = region.level < settings.levels;
    const uint32_t width = has_level ? image.level_width(region.level) : 0;
    const uint32_t height = has_level ? image.level_height(region.level) : 0;
    if (region.width == 0 && region.x < width) region.width = width - region.x;
    if (region.height == 0 && region.y < height) region.height = height - region.y;
    const bool fits = has_level && region.layer_count > 0 &&
                      uint64_t{region.base_layer} + region.layer_count <= settings.layers &&
                      region.width > 0 && uint64_t{region.x} + region.width <= width && region.height > 0 &&
                      uint64_t{region.y} + region.height <= height;
    if (!fits) {
        throw std::invalid_argument(message("region: expected a part of ", settings.width, " x ",
                                            settings.height, ", ", settings.levels, " levels, ",
                                            settings.layers, " layers, got level ", region.level, ", layers ",
                                            region.base_layer, " + ", region.layer_count, ", x ", region.x,
                                            " + ", region.width, ", y ", region.y, " + ", region.height));
    }
    return region;
}

void Commands::use_for_transfer(Image& image, VkImageLayout layout) {
    if (image.layout() != VK_IMAGE_LAYOUT_GENERAL && image.layout() != layout) transition(image, layout);
}

void Commands::copy_buffer(const Buffer& source, const Buffer& target, VkDeviceSize size_bytes,
                           VkDeviceSize source_offset, VkDeviceSize target_offset) {
    require_outside_rendering("copy_buffer");
    const auto fits = [&](const Buffer& buffer, VkDeviceSize offset) {
        return offset <= buffer.size_bytes() && size_bytes <= buffer.size_bytes() - offset;
    };
    if (size_bytes == 0 || !fits(source, source_offset) || !fits(target, target_offset)) {
        throw std::invalid_argument(message("copy_buffer: expected bytes within both buffers, got ",
                                            size_bytes, " from ", source_offset, " of ", source.size_bytes(),
                                            " to ", target_offset, " of ", target.size_bytes()));
    }
    const VkBufferCopy copy{source_offset, target_offset, size_bytes};
    vkCmdCopyBuffer(frame_.commands, source.handle(), target.handle(), 1, &copy);
}

void Commands::copy_buffer_to_image(const Buffer& source, VkDeviceSize offset, Image& target,
                                    const ImageRegion& region) {
    require_outside_rendering("copy_buffer_to_image");
    const ImageRegion whole = resolve_region(target, region);
    require_room(target, whole, source, offset);
    use_for_transfer(target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy copy = buffer_copy(target, whole, offset);
    vkCmdCopyBufferToImage(frame_.commands, source.handle(), target.handle(), target.layout(), 1, &copy);
}

void Commands::copy_image_to_buffer(Image& source, const ImageRegion& region, const Buffer& target,
                                    VkDeviceSize offset) {
    require_outside_rendering("copy_image_to_buffer");
    const ImageRegion whole = resolve_region(source, region);
    require_room(source, whole, target, offset);
    use_for_transfer(source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy copy = buffer_copy(source, whole, offset);
    vkCmdCopyImageToBuffer(frame_.commands, source.handle(), source.layout(), target.handle(), 1, &copy);
}

void Commands::fill_buffer(const Buffer& buffer, uint32_t value, VkDeviceSize offset,
                           VkDeviceSize size_bytes) {
    require_outside_rendering("fill_buffer");
    if (offset % 4 != 0 || (size_bytes != VK_WHOLE_SIZE && size_bytes % 4 != 0)) {
        throw std::invalid_argument(
            message("fill_buffer: expected multiples of 4, got offset ", offset, ", size ", size_bytes));
    }
    vkCmdFillBuffer(frame_.commands, buffer.handle(), offset, size_bytes, value);
}

void Commands::clear_color_image(Image& image, const VkClearColorValue& value) {
    require_outside_rendering("clear_color_image");
    use_for_transfer(image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkImageSubresourceRange range{image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0,
                                        VK_REMAINING_ARRAY_LAYERS};
    vkCmdClearColorImage(frame_.commands, image.handle(), image.layout(), &value, 1, &range);
}

void Commands::blit(Image& source, const ImageRegion& from, Image& target, const ImageRegion& to,
                    VkFilter filter) {
    require_outside_rendering("blit");
    const ImageRegion a = resolve_region(source, from), b = resolve_region(target, to);
    if (&source == &target) {
        require(source.layout() == VK_IMAGE_LAYOUT_GENERAL,
                "an image blitted to itself to be in layout GENERAL");
    }
    use_for_transfer(source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    use_for_transfer(target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const auto corner = [](uint32_t x, uint32_t y, int32_t z) {
        return VkOffset3D{static_cast<int32_t>(x), static_cast<int32_t>(y), z};
    };
    VkImageBlit info{};
    info.srcSubresource = subresource(source, a);
    info.dstSubresource = subresource(target, b);
    info.srcOffsets[0] = corner(a.x, a.y, 0);
    info.srcOffsets[1] = corner(a.x + a.width, a.y + a.height, 1);
    info.dstOffsets[0] = corner(b.x, b.y, 0);
    info.dstOffsets[1] = corner(b.x + b.width, b.y + b.height, 1);
    vkCmdBlitImage(frame_.commands, source.handle(), source.layout(), target.handle(), target.layout(), 1,
                   &info, filter);
}

void Commands::blit_levels(Image& image) {
    ImageRegion from, to;
    from.layer_count = to.layer_count = image.settings().layers;
    for (uint32_t level = 1; level < image.settings().levels; ++level) {
        from.level = level - 1;
        to.level = level;
        blit(image, from, image, to, VK_FILTER_LINEAR);
        barrier();
    }
}

} // namespace burnish::vulkan
