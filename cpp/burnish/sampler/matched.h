// The variance-matched sampler, our own.
#pragma once

#include <array>

#include "burnish/sampler/facts.h"

namespace burnish {

/// Counts that mixtures were fitted for (see matched_table.h).
constexpr std::array<uint32_t, 19> MATCHED_COUNTS = {2,  3,  4,  5,  6,  7,  8,  9,  10, 12,
                                                     14, 16, 17, 20, 24, 30, 32, 48, 64};

/// Our own: lookups placed so that the covariance of their centres and their own widths together are the
/// lobe's (maths: section 6).
struct Matched {
    uint32_t samples = 14; ///< one of MATCHED_COUNTS
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Matched& sampler);
SamplerFacts facts(const Matched& sampler);

} // namespace burnish
