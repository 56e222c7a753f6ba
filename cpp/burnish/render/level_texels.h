// Levels of cubes where the host reads them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace burnish {

/// Texels along an edge from which the host works on a level on all cores.
constexpr uint32_t LEAST_THREADED_SIZE = 128;

/// One level of some cubes: half RGBA in Vulkan's order and orientation, 8 bytes a texel, face after face.
struct LevelTexels {
    const uint64_t* first = nullptr; ///< the upper left texel of the first face
    size_t row_pitch = 0, face_pitch = 0;
    uint32_t size = 0; ///< texels along an edge
};

} // namespace burnish
