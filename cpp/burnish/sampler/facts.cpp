#include "burnish/sampler/facts.h"

#include <cmath>
#include <stdexcept>

#include "burnish/error.h"

namespace burnish {

void require_samples(uint32_t samples) {
    if (samples < 1 || samples > MAX_SAMPLES)
        throw std::invalid_argument(message("samples: expected 1..", MAX_SAMPLES, ", got ", samples));
}

void require_mip_bias(float bias) {
    if (!(std::abs(bias) <= 16.0f))
        throw std::invalid_argument(message("mip_bias: expected -16..16, got ", bias));
}

std::string diffuse_text(DiffuseForm form) {
    return form == DiffuseForm::harmonics ? ":diffuse=harmonics" : "";
}

} // namespace burnish
