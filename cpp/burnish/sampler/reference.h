// The truth.
#pragma once

#include "burnish/sampler/facts.h"

namespace burnish {

enum class ReferenceMethod { automatic, quadrature, progressive };

/// The truth, for the diffuse part and every lobe: every level-0 texel, or progressive multiple importance
/// sampling until the standard error is reached.
struct Reference {
    float standard_error = 0.002f; ///< relative to the mean radiance that is reflected, > 0
    ReferenceMethod method = ReferenceMethod::automatic;
    uint32_t max_samples = 1u << 16; ///< per pixel; a warning says so when it stops a progressive run
};

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Reference& sampler);
SamplerFacts facts(const Reference& sampler);

} // namespace burnish
