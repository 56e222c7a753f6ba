#include "burnish/vulkan/image.h"

#include "burnish/vulkan/device.h"
#include "burnish/vulkan/result.h"

#include <bit>

namespace burnish::vulkan {

namespace {

void require_valid(const ImageSettings& settings) {
    texel_bytes(settings.format); // throws for formats that are not listed
    if (settings.width == 0 || settings.height == 0 || settings.layers == 0) {
        throw std::invalid_argument(message("image: expected width, height and layers of at least 1, got ",
                                            settings.width, " x ", settings.height, ", ", settings.layers,
                                            " layers"));
    }
    const uint32_t most = full_levels(settings.width, settings.height);
    if (settings.levels == 0 || settings.levels > most) {
        throw std::invalid_argument(message("levels: expected 1..", most, " for ", settings.width, " x ",
                                            settings.height, ", got ", settings.levels));
    }
    if (settings.is_cube && (settings.width != settings.height || settings.layers % 6 != 0)) {
        throw std::invalid_argument(message("cube: expected square faces and a multiple of 6 layers, got ",
                                            settings.width, " x ", settings.height, ", ", settings.layers,
                                            " layers"));
    }
}

void require_supported(const Device& device, const VkImageCreateInfo& info) {
    VkImageFormatProperties limits{};
    const VkResult result = vkGetPhysicalDeviceImageFormatProperties(
        device.physical(), info.format, info.imageType, info.tiling, info.usage, info.flags, &limits);
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) {
        throw VulkanError(message("format: expected one that ", device.info().name, " supports with usage ",
                                  info.usage, ", got ", format_name(info.format)));
    }
    vk_check(result, "vkGetPhysicalDeviceImageFormatProperties");
    const VkExtent3D most = limits.maxExtent;
    if (info.extent.width > most.width || info.extent.height > most.height ||
        info.arrayLayers > limits.maxArrayLayers || !(limits.sampleCounts & info.samples)) {
        throw VulkanError(message("image: expected at most ", most.width, " x ", most.height, ", ",
                                  limits.maxArrayLayers, " layers, sample counts in mask ",
                                  limits.sampleCounts, ", got ", info.extent.width, " x ", info.extent.height,
                                  ", ", info.arrayLayers, " layers, ", static_cast<int>(info.samples),
                                  " samples"));
    }
}

} // namespace

uint32_t full_levels(uint32_t width, uint32_t height) {
    return static_cast<uint32_t>(std::bit_width(std::max(width, height)));
}

Image::Image(const DevicePointer& device, const ImageSettings& settings)
    : settings_(settings), layout_(std::make_shared<VkImageLayout>(VK_IMAGE_LAYOUT_UNDEFINED)) {
    require_valid(settings);
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    if (settings.is_cube) info.flags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = settings.format;
    info.extent = {settings.width, settings.height, 1};
    info.mipLevels = settings.levels;
    info.arrayLayers = settings.layers;
    info.samples = settings.samples;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = settings.usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    require_supported(*device, info);

    VkImage image = VK_NULL_HANDLE;
    vk_check(vkCreateImage(device->handle(), &info, nullptr, &image), "vkCreateImage");
    image_ = {device, image};
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device->handle(), image, &needs);
    allocation_ = device->memory().allocate(device, needs, MemoryUse::device, true);
    vk_check(vkBindImageMemory(device->handle(), image, allocation_.memory(), allocation_.offset()),
             "vkBindImageMemory");
}

VkImageAspectFlags Image::aspect() const {
    return is_depth_format(settings_.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkDeviceSize Image::level_bytes(uint32_t level) const {
    return VkDeviceSize{level_width(level)} * level_height(level) * texel_bytes(settings_.format);
}

VkImageView Image::view() const {
    if (settings_.is_cube) {
        return view_as(settings_.layers > 6 ? VK_IMAGE_VIEW_TYPE_CUBE_ARRAY : VK_IMAGE_VIEW_TYPE_CUBE);
    }
    return view_as(settings_.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D);
}

VkImageView Image::view_as(VkImageViewType type) const {
    return view(ViewRange{type, 0, settings_.levels, 0, settings_.layers});
}

VkImageView Image::level_view(uint32_t level) const {
    return view(ViewRange{VK_IMAGE_VIEW_TYPE_2D_ARRAY, level, 1, 0, settings_.layers});
}

VkImageView Image::layer_view(uint32_t level, uint32_t layer) const {
    return view(ViewRange{VK_IMAGE_VIEW_TYPE_2D, level, 1, layer, 1});
}

VkImageView Image::view(const ViewRange& range) const {
    if (range.levels == 0 || range.base_level + range.levels > settings_.levels || range.layers == 0 ||
        range.base_layer + range.layers > settings_.layers) {
        throw std::invalid_argument(message("view: expected levels within 0..", settings_.levels,
                                            " and layers within 0..", settings_.layers, ", got levels ",
                                            range.base_level, " + ", range.levels, ", layers ",
                                            range.base_layer, " + ", range.layers));
    }
    Handle<VkImageView, vkDestroyImageView>& slot = views_[range];
    if (slot.get() == VK_NULL_HANDLE) {
        VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = image_.get();
        info.viewType = range.type;
        info.format = settings_.format;
        info.subresourceRange = {aspect(), range.base_level, range.levels, range.base_layer, range.layers};
        VkImageView view = VK_NULL_HANDLE;
        vk_check(vkCreateImageView(device()->handle(), &info, nullptr, &view), "vkCreateImageView");
        slot = {device(), view};
    }
    return slot.get();
}

Sampler::Sampler(const DevicePointer& device, const SamplerSettings& settings) {
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = settings.magnification;
    info.minFilter = settings.minification;
    info.mipmapMode = settings.mip_mode;
    info.addressModeU = settings.wrap_u;
    info.addressModeV = settings.wrap_v;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = settings.max_lod;
    const float most = device->features().sampler_anisotropy ? device->limits().maxSamplerAnisotropy : 1.0f;
    info.maxAnisotropy = std::min(settings.max_anisotropy, most);
    info.anisotropyEnable = info.maxAnisotropy > 1;
    VkSampler sampler = VK_NULL_HANDLE;
    vk_check(vkCreateSampler(device->handle(), &info, nullptr, &sampler), "vkCreateSampler");
    sampler_ = {device, sampler};
}

} // namespace burnish::vulkan
