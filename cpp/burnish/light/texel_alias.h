// Draws texels of an environment in proportion to their light, in constant time (Walker's alias method,
// Vose's set-up).
#pragma once

#include "burnish/light/cube_texels.h"
#include "shared/records.h"

#include <vector>

namespace burnish {

/// One entry a level-0 texel, in the order (face, row, column). Drawn are: an entry, evenly; then its texel
/// if an even fraction is below `threshold`, else `alias`. `probability` is what a texel gets that way,
/// thresholds rounded to float included; the probabilities sum to 1.
///
/// Probability aimed at: 95 % in proportion to solid angle times luminance (Rec. 709), the mean of the 3x3
/// texels around, within the face and with its edges repeated; 5 % to solid angle alone, so that a texel that
/// bilinear lookups or the lobe make brighter is never missed. A black environment has the second part only.
std::vector<shared::TexelAlias> build_texel_alias(const CubeTexels& cube);

} // namespace burnish
