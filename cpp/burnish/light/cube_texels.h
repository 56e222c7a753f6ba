// Geometry of the texels of a cube map, in double precision.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

/// Solid angle of each texel of a face, row by row; all faces are alike. Six times their sum is 4 pi.
std::vector<double> texel_solid_angles(uint32_t face_size);

/// The direction through (u, v) in [-1, 1]^2 of a face is axis + u right + v down, not normalised.
struct FaceAxes {
    glm::dvec3 axis, right, down;
};
FaceAxes face_axes(uint32_t face);

/// The texels of a cube map as they lie in an Environment: 6 face_size^2 of three floats (face, row, column,
/// channel).
struct CubeTexels {
    uint32_t face_size = 0;
    std::span<const float> radiance;
};

/// The face size. Throws std::invalid_argument if there are no texels.
uint32_t require_texels(const CubeTexels& cube);

} // namespace burnish
