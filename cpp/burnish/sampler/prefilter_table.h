// Samples that make the levels of a prefiltered map (glsl/shared/prefilter.h).
#pragma once

#include <cstdint>

#include "burnish/light/pyramid_filter.h"
#include "burnish/sampler/sample_table.h"

namespace burnish {

/// Slope of the lobe that a level of `size` texels along an edge is filtered by. Level 0 is not filtered.
float prefiltered_roughness(uint32_t size);

/// Filtered importance sampling of that lobe, seen along its normal, in the pyramid of a map: Fibonacci
/// points, those below the horizon left out, whole phases of PREFILTER_PHASE (of weight zero in the end).
/// `level` is counted from 1.
///
/// Level 1, with most of the texels, takes 64 samples, each level twice as many as the one above it, up to
/// 1024: half the lookups are level 1's. A bias of -1/2 suits these counts: lookups as wide as the samples
/// lie apart would blur the lobe (by 5 % of the radiance at 64), narrower ones leave gaps. Against the sum
/// over every texel of a map of bright spots the levels are 2 to 4 % off.
SampleTable build_prefilter_table(uint32_t level, uint32_t face_size);

/// The Gaussian of a level of `size` texels, SPHERICAL_LEVEL_VARIANCE (2/size)^2 per axis, as a mixture of
/// the matched sampler: entries (slope along x and y, weight, face_texels v/(4 c_f)), whole phases. An entry
/// stands for two lookups, at that slope and at the opposite one; a lookup goes to where the slope as a
/// half-vector's mirrors the normal; v is the variance of its directions.
SampleTable build_spherical_table(uint32_t size, uint32_t face_size, PyramidFilter filter);

/// A variance of directions per axis as a share of what a lookup at level 1 of such a map has.
float spherical_share(double variance, uint32_t face_size);
/// Level at which a lookup has that variance: 1 + log2(share)/2, and below level 1 the share itself, as level
/// 0 is not filtered.
float spherical_level(double variance, uint32_t face_size);

} // namespace burnish
