// One lookup in a map that was filtered for the roughness.
#pragma once

#include "burnish/sampler/facts.h"

namespace burnish {

/// One lookup a lobe in a map prefiltered for its roughness, times the exact albedo: what engines ship.
struct Prefiltered {
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Prefiltered& sampler);
SamplerFacts facts(const Prefiltered& sampler);

} // namespace burnish
