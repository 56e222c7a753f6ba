// A second copy of stb_image, for PNG only: the textures' copy bounds its blocks of memory for their sizes.
#include "burnish/scene/png16.h"

#include <climits>

#include "burnish/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#include <stb_image.h>

namespace burnish {

Png16Image decode_png16(const std::string& name, std::span<const uint8_t> bytes) {
    if (bytes.size() > INT_MAX) {
        throw FileError(name, message("PNG: expected at most ", INT_MAX, " bytes, got ", bytes.size()));
    }
    const auto size = static_cast<int>(bytes.size());
    if (!stbi_is_16_bit_from_memory(bytes.data(), size)) {
        throw FileError(name, "PNG: expected 16 bits a channel, got others or a damaged header");
    }
    int width = 0, height = 0, channels = 0;
    stbi_us* samples = stbi_load_16_from_memory(bytes.data(), size, &width, &height, &channels, 0);
    if (!samples) {
        const char* reason = stbi_failure_reason();
        throw FileError(name, message("PNG cannot be decoded, it is damaged or too large (",
                                      reason ? reason : "unknown reason", ")"));
    }
    Png16Image image;
    image.width = static_cast<uint32_t>(width);
    image.height = static_cast<uint32_t>(height);
    image.channels = static_cast<uint32_t>(channels);
    try {
        image.samples.assign(samples, samples + size_t{image.width} * image.height * image.channels);
    } catch (...) {
        stbi_image_free(samples);
        throw;
    }
    stbi_image_free(samples);
    return image;
}

} // namespace burnish
