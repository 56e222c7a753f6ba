// Diffuse light of an environment as nine spherical-harmonic coefficients (Ramamoorthi and Hanrahan 2001).
#pragma once

#include "burnish/light/cube_texels.h"

#include <array>

#include <glm/glm.hpp>

namespace burnish {

/// RGB coefficients whose sum with the harmonics of glsl/lib/spherical_harmonics.glsl, in its order
/// (00, 1-1 y, 10 z, 11 x, 2-2 xy, 2-1 yz, 20, 21 xz, 22), is irradiance / pi for a normal in the frame of
/// the environment. Radiance as given: neither rotation nor exposure is applied.
std::array<glm::dvec3, 9> irradiance_over_pi_coefficients(const CubeTexels& cube);

/// That sum at a unit normal; what rings below 0 becomes 0.
glm::dvec3 irradiance_over_pi(const std::array<glm::dvec3, 9>& coefficients, glm::dvec3 normal);

} // namespace burnish
