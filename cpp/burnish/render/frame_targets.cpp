#include "burnish/render/frame_targets.h"

#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/device.h"
#include "shared/constants.h"
#include "shared/records.h"

namespace burnish::render {
namespace {

vulkan::Image target(const vulkan::DevicePointer& device, VkFormat format, uint32_t width, uint32_t height,
                     VkImageUsageFlags usage) {
    vulkan::ImageSettings settings;
    settings.format = format;
    settings.width = width;
    settings.height = height;
    settings.usage = usage;
    return vulkan::Image(device, settings);
}

} // namespace

FrameTargets::FrameTargets(const vulkan::DevicePointer& device, const TargetSettings& wanted)
    : settings(wanted) {
    const uint32_t width = wanted.width, height = wanted.height;
    const VkImageUsageFlags color = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
    surface = target(device, SURFACE_FORMAT, width, height, color);
    depth = target(device, DEPTH_FORMAT, width, height,
                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    const auto varying = [&](bool is_there, VkFormat format) {
        return target(device, format, is_there ? width : 1, is_there ? height : 1, color);
    };
    varying_diffuse = varying(wanted.has_varying, VARYING_FORMAT);
    varying_specular = varying(wanted.has_varying, VARYING_FORMAT);
    varying_emissive = varying(wanted.has_all_targets, VARYING_FORMAT);
    varying_coat = varying(wanted.has_all_targets, COAT_FORMAT);
    const VkDeviceSize pixels = VkDeviceSize(width) * height;
    tile_capacity = ((width + shared::TILE_SIZE - 1) / shared::TILE_SIZE) *
                    ((height + shared::TILE_SIZE - 1) / shared::TILE_SIZE);
    const VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    // A CPU device shades straight into memory that the host reads.
    const vulkan::MemoryUse use =
        device->info().is_software ? vulkan::MemoryUse::read_back : vulkan::MemoryUse::device;
    // One more pixel, for what is not finite (glsl/shade/guard.glsl).
    const bool has_radiance = wanted.has_sum || !wanted.has_display;
    radiance = vulkan::Buffer(device, (has_radiance ? pixels + 1 : 1) * sizeof(glm::vec4), storage, use);
    display = vulkan::Buffer(device, (wanted.has_display ? pixels + 1 : 1) * sizeof(uint32_t), storage, use);
    sum = vulkan::Buffer(device, (wanted.has_sum ? pixels : 1) * sizeof(glm::vec4), storage, use);
    tiles =
        vulkan::Buffer(device, VkDeviceSize(wanted.list_count) * tile_capacity * sizeof(uint32_t), storage);
    tile_counts = vulkan::Buffer(device, wanted.list_count * sizeof(glm::uvec4),
                                 storage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    counters = vulkan::Buffer(device, sizeof(shared::Counters), storage);
    view = vulkan::Buffer(device, sizeof(shared::ViewRecord),
                          storage | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    view_rows = vulkan::texel_view(view, VK_FORMAT_R32G32B32A32_UINT);
}

} // namespace burnish::render
