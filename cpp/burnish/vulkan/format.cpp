// What the project knows about the texel formats it uses.
#include "burnish/error.h"
#include "burnish/vulkan/image.h"

namespace burnish::vulkan {

namespace {

struct FormatFacts {
    VkFormat format;
    const char* name;
    uint32_t bytes;
};

constexpr FormatFacts known_formats[] = {
    {VK_FORMAT_R8_UNORM, "R8_UNORM", 1},
    {VK_FORMAT_R8_UINT, "R8_UINT", 1},
    {VK_FORMAT_R8_SRGB, "R8_SRGB", 1},
    {VK_FORMAT_R8G8_UNORM, "R8G8_UNORM", 2},
    {VK_FORMAT_R8G8_UINT, "R8G8_UINT", 2},
    {VK_FORMAT_R8G8B8A8_UNORM, "R8G8B8A8_UNORM", 4},
    {VK_FORMAT_R8G8B8A8_SNORM, "R8G8B8A8_SNORM", 4},
    {VK_FORMAT_R8G8B8A8_UINT, "R8G8B8A8_UINT", 4},
    {VK_FORMAT_R8G8B8A8_SRGB, "R8G8B8A8_SRGB", 4},
    {VK_FORMAT_R16_UNORM, "R16_UNORM", 2},
    {VK_FORMAT_R16_UINT, "R16_UINT", 2},
    {VK_FORMAT_R16_SFLOAT, "R16_SFLOAT", 2},
    {VK_FORMAT_R16G16_UNORM, "R16G16_UNORM", 4},
    {VK_FORMAT_R16G16_SNORM, "R16G16_SNORM", 4},
    {VK_FORMAT_R16G16_UINT, "R16G16_UINT", 4},
    {VK_FORMAT_R16G16_SFLOAT, "R16G16_SFLOAT", 4},
    {VK_FORMAT_R16G16B16A16_UNORM, "R16G16B16A16_UNORM", 8},
    {VK_FORMAT_R16G16B16A16_SNORM, "R16G16B16A16_SNORM", 8},
    {VK_FORMAT_R16G16B16A16_UINT, "R16G16B16A16_UINT", 8},
    {VK_FORMAT_R16G16B16A16_SFLOAT, "R16G16B16A16_SFLOAT", 8},
    {VK_FORMAT_R32_UINT, "R32_UINT", 4},
    {VK_FORMAT_R32_SINT, "R32_SINT", 4},
    {VK_FORMAT_R32_SFLOAT, "R32_SFLOAT", 4},
    {VK_FORMAT_R32G32_UINT, "R32G32_UINT", 8},
    {VK_FORMAT_R32G32_SFLOAT, "R32G32_SFLOAT", 8},
    {VK_FORMAT_R32G32B32A32_UINT, "R32G32B32A32_UINT", 16},
    {VK_FORMAT_R32G32B32A32_SINT, "R32G32B32A32_SINT", 16},
    {VK_FORMAT_R32G32B32A32_SFLOAT, "R32G32B32A32_SFLOAT", 16},
    {VK_FORMAT_A2B10G10R10_UNORM_PACK32, "A2B10G10R10_UNORM", 4},
    {VK_FORMAT_B10G11R11_UFLOAT_PACK32, "B10G11R11_UFLOAT", 4},
    {VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, "E5B9G9R9_UFLOAT", 4},
    {VK_FORMAT_D16_UNORM, "D16_UNORM", 2},
    {VK_FORMAT_D32_SFLOAT, "D32_SFLOAT", 4},
};

const FormatFacts* find(VkFormat format) {
    for (const FormatFacts& facts : known_formats) {
        if (facts.format == format) return &facts;
    }
    return nullptr;
}

} // namespace

uint32_t texel_bytes(VkFormat format) {
    const FormatFacts* facts = find(format);
    if (!facts) {
        throw std::invalid_argument(
            message("format: expected one listed in format.cpp, got VkFormat ", static_cast<int>(format)));
    }
    return facts->bytes;
}

const char* format_name(VkFormat format) {
    const FormatFacts* facts = find(format);
    return facts ? facts->name : "an unlisted format";
}

bool is_depth_format(VkFormat format) {
    return format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_D32_SFLOAT;
}

} // namespace burnish::vulkan
