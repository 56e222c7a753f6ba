// PNG pictures of 16 bits a channel, whole.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace burnish {

/// height * width * channels samples, top row first; 1 channel is grey, 2 grey and alpha, 3 RGB, 4 RGBA.
struct Png16Image {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 0;
    std::vector<uint16_t> samples;
};

/// Decodes a PNG of 16 bits a channel; a transparent colour (chunk tRNS) becomes alpha. Checksums are not
/// looked at, nor whether so few bytes can hold so large a picture. Throws FileError (name, what was
/// expected, what came).
Png16Image decode_png16(const std::string& name, std::span<const uint8_t> bytes);

} // namespace burnish
