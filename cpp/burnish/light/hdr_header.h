// The text at the start of a Radiance picture.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

/// One axis of the resolution line: "-Y 512" is y, falling, 512.
struct HdrAxis {
    bool is_x = false;
    bool is_increasing = false; ///< x grows to the right, y upward
    uint32_t size = 0;
};

struct HdrHeader {
    bool is_xyz = false;
    glm::dvec3 divisor{1.0};   ///< product of all EXPOSURE and COLORCORR
    double gamma = 1.0;        ///< stored values are the linear ones to the power of 1 / gamma
    double pixel_aspect = 1.0; ///< product of all PIXASPECT: height by width of a pixel
    std::vector<double>
        primaries;         ///< x, y of red, green, blue and white as they stand; empty: none are given
    HdrAxis slow;          ///< across scanlines
    HdrAxis fast;          ///< along a scanline
    size_t size_bytes = 0; ///< the first scanline starts here
};

/// Throws FileError with `path`; sizes are in 1..1000000.
HdrHeader parse_hdr_header(const std::string& path, std::span<const uint8_t> bytes);

} // namespace burnish
