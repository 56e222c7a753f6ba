#include "burnish/sampler/reference.h"

#include <stdexcept>

#include "burnish/error.h"

namespace burnish {

void validate(const Reference& sampler) {
    if (!(sampler.standard_error > 0.0f && sampler.standard_error <= 1.0f))
        throw std::invalid_argument(
            message("standard_error: expected a value in (0, 1], got ", sampler.standard_error));
    if (sampler.max_samples < 64)
        throw std::invalid_argument(message("max_samples: expected >= 64, got ", sampler.max_samples));
}

SamplerFacts facts(const Reference&) {
    return {.text = "reference", .levels = MapLevels::none, .is_truth = true};
}

} // namespace burnish
