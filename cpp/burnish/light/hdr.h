// Radiance pictures as linear radiance.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

/// A Radiance .hdr picture: width, height and height * width * 3 floats, row 0 at the top whatever the file's
/// orientation; and what its header said.
struct HdrImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> radiance;
    bool is_xyz = false;           ///< stored as CIE XYZ, turned into Rec. 709
    glm::dvec3 divisor{1.0};       ///< product of all EXPOSURE and COLORCORR, divided out
    double gamma = 1.0;            ///< of the last GAMMA, taken out
    double pixel_aspect = 1.0;     ///< product of all PIXASPECT, not used
    std::vector<double> primaries; ///< numbers of the last PRIMARIES, not used; empty: no such line
};

/// Decodes new RLE, old RLE and flat files, headers of Photoshop included. Throws FileError (name, what was
/// expected, what came).
HdrImage decode_hdr(const std::string& name, std::span<const uint8_t> bytes);

/// The same of a file.
HdrImage read_hdr(const std::string& path);

} // namespace burnish
