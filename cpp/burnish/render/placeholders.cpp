#include "burnish/render/placeholders.h"

#include "burnish/vulkan/commands.h"

namespace burnish::render {
namespace {

vulkan::Image one_texel(const vulkan::DevicePointer& device, VkFormat format) {
    vulkan::ImageSettings settings;
    settings.format = format;
    settings.usage = VK_IMAGE_USAGE_STORAGE_BIT;
    vulkan::Image image(device, settings);
    vulkan::Commands commands(device);
    commands.transition(image, VK_IMAGE_LAYOUT_GENERAL);
    commands.submit();
    return image;
}

} // namespace

Placeholders::Placeholders(const vulkan::DevicePointer& device)
    : buffer(device, 256, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT),
      rows(vulkan::texel_view(buffer, VK_FORMAT_R32G32B32A32_UINT)),
      surface(one_texel(device, VK_FORMAT_R32G32_UINT)),
      varying(one_texel(device, VK_FORMAT_R16G16B16A16_SFLOAT)) {}

} // namespace burnish::render
