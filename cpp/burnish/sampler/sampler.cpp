#include "burnish/sampler/sampler.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "burnish/error.h"

namespace burnish {
namespace {

void require_count(const char* name, uint32_t value) {
    if (value < 1 || value > MAX_SAMPLES)
        throw std::invalid_argument(message(name, ": expected 1..", MAX_SAMPLES, ", got ", value));
}

void require_bias(float value) {
    if (!(std::abs(value) <= 16.0f))
        throw std::invalid_argument(message("mip_bias: expected -16..16, got ", value));
}

struct Check {
    void operator()(const Regular& sampler) const {
        require_count("samples", sampler.samples);
        if (!(sampler.threshold > 0.0f && sampler.threshold < 1.0f))
            throw std::invalid_argument(
                message("threshold: expected a value in (0, 1), got ", sampler.threshold));
        require_bias(sampler.mip_bias);
    }
    void operator()(const Importance& sampler) const {
        require_count("samples", sampler.samples);
        require_bias(sampler.mip_bias);
    }
    void operator()(const Matched& sampler) const {
        if (std::find(MATCHED_COUNTS.begin(), MATCHED_COUNTS.end(), sampler.samples) != MATCHED_COUNTS.end())
            return;
        std::string counts;
        for (const uint32_t count : MATCHED_COUNTS)
            counts += message(counts.empty() ? "" : ", ", count);
        throw std::invalid_argument(message("samples: expected one of ", counts, ", got ", sampler.samples));
    }
    void operator()(const Prefiltered&) const {}
    void operator()(const Reference& sampler) const {
        if (!(sampler.standard_error > 0.0f && sampler.standard_error <= 1.0f))
            throw std::invalid_argument(
                message("standard_error: expected a value in (0, 1], got ", sampler.standard_error));
        if (sampler.max_samples < 64)
            throw std::invalid_argument(message("max_samples: expected >= 64, got ", sampler.max_samples));
    }
};

const char* form_text(DiffuseForm form) {
    return form == DiffuseForm::harmonics ? ":diffuse=harmonics" : "";
}

struct Describe {
    std::string operator()(const Regular& sampler) const {
        return message("regular:", sampler.samples, form_text(sampler.diffuse));
    }
    std::string operator()(const Importance& sampler) const {
        return message("importance:", sampler.samples, form_text(sampler.diffuse));
    }
    std::string operator()(const Matched& sampler) const {
        return message("matched:", sampler.samples, form_text(sampler.diffuse));
    }
    std::string operator()(const Prefiltered& sampler) const {
        return message("prefiltered", form_text(sampler.diffuse));
    }
    std::string operator()(const Reference&) const { return "reference"; }
};

struct FindDiffuseForm {
    std::optional<DiffuseForm> operator()(const Reference&) const { return std::nullopt; }
    template <typename Kind>
    std::optional<DiffuseForm> operator()(const Kind& sampler) const {
        return sampler.diffuse;
    }
};

} // namespace

void validate(const Sampler& sampler) {
    std::visit(Check{}, sampler);
}

std::string describe(const Sampler& sampler) {
    return std::visit(Describe{}, sampler);
}

std::optional<DiffuseForm> diffuse_form(const Sampler& sampler) {
    return std::visit(FindDiffuseForm{}, sampler);
}

} // namespace burnish
