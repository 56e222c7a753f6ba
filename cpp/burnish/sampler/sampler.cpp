#include "burnish/sampler/sampler.h"

namespace burnish {
namespace {

/// Those that place points over a lobe, of which a bias moves the levels.
template <typename Kind>
concept Pattern = requires(const Kind& sampler) {
    sampler.mip_bias;
};

} // namespace

void validate(const Sampler& sampler) {
    std::visit([](const auto& one) { validate(one); }, sampler);
}

SamplerFacts facts(const Sampler& sampler) {
    return std::visit([](const auto& one) { return facts(one); }, sampler);
}

SampleTable build_sample_table(const Sampler& sampler, const LobeShape& shape, uint32_t face_size) {
    return std::visit(
        [&]<typename Kind>(const Kind& one) {
            if constexpr (Pattern<Kind>)
                return shape.model->has_fixed_half_vectors
                           ? build_sample_table(one, shape.width(), face_size)
                           : make_plane_table(plane_points(one, shape), shape.model->density, face_size,
                                              one.mip_bias);
            else
                return SampleTable{};
        },
        sampler);
}

SampleTable build_scaled_table(const Sampler& sampler, LobeShape shape, uint32_t face_size) {
    // Places of a plane are in units of its widths already.
    if (!shape.model->has_fixed_half_vectors) {
        shape.width_x = shape.width_y = SCALED_ROUGHNESS;
        return build_sample_table(sampler, shape, face_size);
    }
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
