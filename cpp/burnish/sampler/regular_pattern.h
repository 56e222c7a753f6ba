// The regular pattern of half-vectors (RS section 5; the reading of eq. 12 that gives the published counts).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

/// s1: a sample at the pole, circles at i s1, i = 1..n-1, s1 = theta_max / (n - 1/2).
/// s2: no pole, circles at (i + 2/3) s2, i = 0..n-1, s2 = theta_max / (n + 1/6).
enum class Spacing { s1, s2 };

/// Half-vectors (unit, z = normal) of the pattern; `circle_count` counts the pole of s1.
/// theta_max = arctan(sqrt(-ln threshold) max(roughness)) (eq. 11). Anisotropic lobes drop samples of q <
/// threshold and turn each circle by half a step where that keeps the larger sum of q. Throws
/// std::invalid_argument: roughness in (0, 10], threshold in (0, 1), circle_count >= 1.
std::vector<glm::dvec3> regular_pattern(glm::dvec2 roughness, Spacing spacing, uint32_t circle_count,
                                        double threshold);

/// The pattern, over both spacings and all circle counts, whose size is closest to `samples`; the larger of
/// two as close (the published 270 at roughness .15, threshold .01 is 271), then s1, then fewer circles.
std::vector<glm::dvec3> choose_regular_pattern(glm::dvec2 roughness, uint32_t samples, double threshold);

/// q(h) = exp(-((hx/mx)^2 + (hy/my)^2)/hz^2), 0 at and below the horizon.
double lobe_q(glm::dvec3 half_vector, glm::dvec2 roughness);

/// Solid angle of {h : q(h) >= threshold}.
double lobe_solid_angle(glm::dvec2 roughness, double threshold);

} // namespace burnish
