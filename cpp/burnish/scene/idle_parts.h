// What changes no pixel is found when it is set, and left out: a lobe that reflects nothing, a texture of one
// value, a flat normal map, white vertex colours.
#pragma once

#include "burnish/scene/scene.h"

namespace burnish {

/// Drops lobes without weight; `material.left_out` says which.
void leave_out_idle_lobes(Material& material);

/// Multiplies textures of one value into the factors of materials from glTF and drops them, flat normal maps
/// and white vertex colours; `left_out` of the materials says which.
void leave_out_idle_textures(Scene& scene);

} // namespace burnish
