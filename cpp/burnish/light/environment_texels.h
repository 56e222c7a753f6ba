// The parts of environment.cpp that work on bare texels; used only there and in tests.
#pragma once

#include <cstdint>
#include <vector>

#include "burnish/light/environment.h"

namespace burnish {

/// Puts NaN, infinite and negative values right; `radiance` has three channels.
TexelReport clean_texels(std::vector<float>& radiance);

/// The faces of Environment::from_lat_long, from clean texels.
std::vector<float> cube_from_lat_long(uint32_t height, uint32_t width, const std::vector<float>& radiance,
                                      uint32_t face_size, LatLongGrid grid);

} // namespace burnish
