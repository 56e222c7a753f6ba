// Maps as our own lookup (glsl/lookup/map_lookup.glsl) reads them: pairs of texels in a buffer.
//
// On a CPU device the driver's sampler takes most of a frame. Our own lookup reads a buffer whose elements
// are two texels side by side, channel by channel: red as the halves of x, green of y, blue of z. A level
// holds its six faces one after the other, each with a border of one texel, row by row: n + 1 pairs in each
// of n + 2 rows, the pair p holding the bordered texels p and p + 1, so that a bilinear lookup is two loads.
// Texels beyond one edge are the neighbouring face's; beyond two, the mean of the three that meet there.
//
// Faces stand in Vulkan's order, but not in its orientation: no axis is mirrored. A face across z is seen
// along (x, y), one across y along (x, z), one across x along (z, y), so that the lookup has no sign to
// change.
#pragma once

#include "burnish/render/level_texels.h"
#include "burnish/vulkan/element_buffer.h"
#include "burnish/vulkan/image.h"

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

namespace burnish {

/// Packs levels of `cube_count` cubes, from `first_cube` of those in `pairs` on, which have faces of
/// `face_size`: `levels` are the last ones, down to one texel, or level 0 alone. Values stay what they are,
/// but the mean of three texels at a cube's corner is rounded to the nearest half.
///
/// The host does it: our lookup is for devices that are CPUs, where the loads and stores of a kernel are
/// loops over lanes, and took ten times as long.
void pack_pairs(std::span<const LevelTexels> levels, uint32_t face_size, uint32_t first_cube,
                uint32_t cube_count, const vulkan::ElementBuffer& pairs);
/// The same of what `cubes` holds from `first_level` on: a cube array of RGBA16F in SHADER_READ_ONLY_OPTIMAL,
/// which it is afterwards, too. Submits and waits.
void pack_pairs(vulkan::Image& cubes, uint32_t first_level, uint32_t first_cube, uint32_t cube_count,
                const vulkan::ElementBuffer& pairs);

} // namespace burnish
