// The pictures that a frame is made in.
#pragma once

#include <cstdint>

#include "burnish/vulkan/buffer.h"
#include "burnish/vulkan/image.h"

namespace burnish::render {

constexpr VkFormat SURFACE_FORMAT = VK_FORMAT_R32G32_UINT;
constexpr VkFormat VARYING_FORMAT = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat COAT_FORMAT = VK_FORMAT_R32G32_UINT;
constexpr VkFormat DEPTH_FORMAT = VK_FORMAT_D32_SFLOAT;

struct TargetSettings {
    uint32_t width = 0, height = 0; ///< pixels
    bool has_varying = false;
    bool has_all_targets = false; ///< of has_varying: emission and coats, too
    bool has_sum = false;
    bool has_display = false;
    uint32_t list_count = 0; ///< of tiles, that there is room for

    bool operator==(const TargetSettings&) const = default;
};

/// Kept while the size stays.
struct FrameTargets {
    TargetSettings settings;
    vulkan::Image surface; ///< RG32UI: see pack_surface in glsl/lib/frame.glsl
    vulkan::Image depth;   ///< D32, reverse z
    vulkan::Image varying_diffuse, varying_specular,
        varying_emissive;       ///< one texel where the settings have none
    vulkan::Image varying_coat; ///< RG32UI, the same: see coat_out in glsl/surface/surface_varying.glsl
    vulkan::Buffer radiance;    ///< vec4 a pixel and one more; one where display output needs no sum
    vulkan::Buffer sum;         ///< vec4 a pixel, with accumulation; else one
    vulkan::Buffer display;     ///< a byte a channel, a pixel and one more, with display output; else one
    vulkan::Buffer tiles;       ///< per list, room for all tiles
    vulkan::Buffer tile_counts; ///< uvec4 a list
    vulkan::Buffer counters;
    vulkan::Buffer view;
    vulkan::TexelView view_rows;
    uint32_t tile_capacity = 0;

    FrameTargets(const vulkan::DevicePointer& device, const TargetSettings& wanted);
};

} // namespace burnish::render
