#include "burnish/sampler/sampler.h"

namespace burnish {
namespace {

template <typename Kind>
concept Pattern = requires(const Kind& sampler) {
    build_scaled_table(sampler, 1u);
};

} // namespace

void validate(const Sampler& sampler) {
    std::visit([](const auto& one) { validate(one); }, sampler);
}

SamplerFacts facts(const Sampler& sampler) {
    return std::visit([](const auto& one) { return facts(one); }, sampler);
}

SampleTable build_sample_table(const Sampler& sampler, glm::vec2 roughness, uint32_t face_size) {
    return std::visit(
        [&]<typename Kind>(const Kind& one) {
            if constexpr (Pattern<Kind>)
                return build_sample_table(one, roughness, face_size);
            else
                return SampleTable{};
        },
        sampler);
}

SampleTable build_scaled_table(const Sampler& sampler, uint32_t face_size) {
    return std::visit(
        [&]<typename Kind>(const Kind& one) {
            if constexpr (Pattern<Kind>)
                return build_scaled_table(one, face_size);
            else
                return SampleTable{};
        },
        sampler);
}

const Reference& reference_of(const Sampler& sampler) {
    return std::get<Reference>(sampler);
}

} // namespace burnish
