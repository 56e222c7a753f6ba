// What the mip levels of a masked texture are made from: the share of each texel that shows.
#pragma once

#include <vector>

#include "burnish/scene/texture.h"

namespace burnish::render {

/// The picture's texels with alpha replaced by the share of their area, in 255ths, where alpha read between
/// texels as `sampler` magnifies it reaches `cutoff`, in (0, 1]. Averages of it are coverage; averages of
/// alpha are not, since a cutoff after averaging makes thin things vanish or grow solid.
std::vector<uint8_t> with_coverage(const TextureImage& picture, const TextureSampler& sampler, float cutoff);

} // namespace burnish::render
