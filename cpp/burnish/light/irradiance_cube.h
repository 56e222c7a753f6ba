// The diffuse light of an environment as a small cube map that is read by one bilinear lookup.
#pragma once

#include <array>
#include <vector>

#include "burnish/light/cosine_sums.h"

namespace burnish {

/// Irradiance / pi at IRRADIANCE_FACE^2 normals a face, in the frame of the environment; neither rotation nor
/// exposure is applied. Linear in the light.
///
/// A bilinear lookup of a smooth function is on the average 1/12 of its second difference too large, along
/// each axis. That is taken off the texels, which makes lookups twice as good. Beside light that sets, a
/// texel may fall below 0 by that; the lookup clamps.
struct IrradianceCube {
    /// Six faces of IRRADIANCE_PITCH^2 texels, row by row, with a border of one texel: the neighbouring
    /// face's, and where three faces meet the mean of the three. Faces stand in Vulkan's order, but no axis
    /// is mirrored, as in burnish/render/texel_pairs.h. Alpha is 0.
    std::vector<glm::vec4> texels;
    /// Relative RMSE of lookups, measured in the middle of four texels.
    double error = 0.0;
};

IrradianceCube make_irradiance_cube(const CosineSums& light);

/// Relative RMSE of nine harmonics (spherical_harmonics.h) of the same map over the texels of its cube.
double harmonics_error(const std::array<glm::dvec3, 9>& coefficients, const IrradianceCube& cube);

} // namespace burnish
