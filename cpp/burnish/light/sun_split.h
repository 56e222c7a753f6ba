// Suns taken out of a map: small bright discs that are shaded directly, so that no lookup has to carry them.
#pragma once

#include <vector>

#include "burnish/light/cube_texels.h"

namespace burnish {

struct Sun {
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit, environment space
    glm::dvec3 flux{0.0};                ///< radiance times solid angle
    double variance = 0.0;               ///< of its directions, per axis, radian^2
};

struct SunSplit {
    std::vector<Sun> suns;       ///< at most shared::MAX_SUNS, brightest texel first
    std::vector<float> radiance; ///< the map without them; empty if there are none
};

/// Maths, section 6. The brightest texel above 100 times the mean is the middle of a cap of 1 degree (at
/// least 4 half-texels); the median of the ring around it, as wide again, is the background. It is a sun if
/// nothing in the ring exceeds the background by 2 % of the peak's excess; flux, centroid and variance of the
/// cap's excess make the light, and the background fills the cap. The first texel that is none ends the
/// search.
SunSplit split_suns(const CubeTexels& cube);

} // namespace burnish
