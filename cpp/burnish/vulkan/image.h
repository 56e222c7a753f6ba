// Two-dimensional images, arrays and cubes, their views, and samplers.
#pragma once

#include "burnish/vulkan/memory.h"

#include <algorithm>
#include <compare>
#include <map>
#include <memory>

namespace burnish::vulkan {

struct ImageSettings {
    VkFormat format = VK_FORMAT_UNDEFINED;
    uint32_t width = 1, height = 1;
    uint32_t levels = 1;
    uint32_t layers = 1; // a cube array of k cubes has 6 k layers
    bool is_cube = false;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT; // transfer in both directions is always allowed
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;

    bool operator==(const ImageSettings&) const = default;
};

/// Levels of a full pyramid down to one texel.
uint32_t full_levels(uint32_t width, uint32_t height);
/// Bytes of one texel. Throws std::invalid_argument for formats this project does not use (compressed,
/// planar).
uint32_t texel_bytes(VkFormat format);
const char* format_name(VkFormat format);
bool is_depth_format(VkFormat format);

/// Part of an image to be viewed.
struct ViewRange {
    VkImageViewType type = VK_IMAGE_VIEW_TYPE_2D;
    uint32_t base_level = 0, levels = 1;
    uint32_t base_layer = 0, layers = 1;
    auto operator<=>(const ViewRange&) const = default;
};

class Image {
public:
    Image() = default;
    /// Throws VulkanError if the device does not support the format with that usage and size.
    Image(const DevicePointer& device, const ImageSettings& settings);

    VkImage handle() const { return image_.get(); }
    const ImageSettings& settings() const { return settings_; }
    const DevicePointer& device() const { return image_.device(); }
    VkImageAspectFlags aspect() const;
    uint32_t level_width(uint32_t level) const { return std::max(1u, settings_.width >> level); }
    uint32_t level_height(uint32_t level) const { return std::max(1u, settings_.height >> level); }
    /// Bytes of one level of one layer, tightly packed.
    VkDeviceSize level_bytes(uint32_t level) const;

    /// All levels and layers: 2D, 2D array (layers > 1), cube (is_cube, 6 layers) or cube array.
    VkImageView view() const;
    /// All levels and layers as this type; e.g. a cube of six layers for a samplerCubeArray.
    VkImageView view_as(VkImageViewType type) const;
    /// One level, all layers, as a 2D array (imageStore, copies between levels).
    VkImageView level_view(uint32_t level) const;
    /// One level of one layer as 2D (render target).
    VkImageView layer_view(uint32_t level, uint32_t layer) const;
    /// Views are made when first asked for and live as long as the image. Not for several threads at once.
    VkImageView view(const ViewRange& range) const;

    /// The layout after all commands recorded so far; Commands keeps it up to date.
    VkImageLayout layout() const { return *layout_; }

private:
    friend class Commands;

    Allocation allocation_; // before image_, so that it is given back after the image is gone
    Handle<VkImage, vkDestroyImage> image_;
    ImageSettings settings_;
    std::shared_ptr<VkImageLayout>
        layout_; // shared with Commands, which puts it back when it is not submitted
    mutable std::map<ViewRange, Handle<VkImageView, vkDestroyImageView>> views_;
};

struct SamplerSettings {
    VkFilter magnification = VK_FILTER_LINEAR, minification = VK_FILTER_LINEAR;
    VkSamplerMipmapMode mip_mode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    VkSamplerAddressMode wrap_u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerAddressMode wrap_v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    float max_lod = VK_LOD_CLAMP_NONE;
    float max_anisotropy = 1; // above 1: used as far as the device can
};

class Sampler {
public:
    Sampler() = default;
    Sampler(const DevicePointer& device, const SamplerSettings& settings);
    VkSampler handle() const { return sampler_.get(); }

private:
    Handle<VkSampler, vkDestroySampler> sampler_;
};

} // namespace burnish::vulkan
