#include "burnish/render/placeholders.h"

#include "burnish/render/frame_targets.h"
#include "burnish/vulkan/commands.h"

namespace burnish::render {
namespace {

vulkan::Image one_texel(const vulkan::DevicePointer& device, VkFormat format,
                        VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT,
                        VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL) {
    vulkan::ImageSettings settings;
    settings.format = format;
    settings.usage = usage;
    vulkan::Image image(device, settings);
    vulkan::Commands commands(device);
    commands.transition(image, layout);
    commands.submit();
    return image;
}

} // namespace

Placeholders::Placeholders(const vulkan::DevicePointer& device)
    : buffer(device, 256, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT),
      rows(vulkan::texel_view(buffer, VK_FORMAT_R32G32B32A32_UINT)),
      surface(one_texel(device, VK_FORMAT_R32G32_UINT)),
      varying(one_texel(device, VK_FORMAT_R16G16B16A16_SFLOAT)),
      depth(one_texel(device, DEPTH_FORMAT, VK_IMAGE_USAGE_SAMPLED_BIT,
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL)) {}

} // namespace burnish::render
