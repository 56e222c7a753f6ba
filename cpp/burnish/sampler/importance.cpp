#include "burnish/sampler/importance.h"

#include <cmath>
#include <numbers>

#include "burnish/error.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;

} // namespace

void validate(const Importance& sampler) {
    require_samples(sampler.samples);
    require_mip_bias(sampler.mip_bias);
}

SamplerFacts facts(const Importance& sampler) {
    return {.text = message("importance:", sampler.samples, diffuse_text(sampler.diffuse)),
            .diffuse = sampler.diffuse,
            .placing = Placing::pattern,
            .samples = sampler.samples,
            .scaled_table = shared::TABLE_SCALED_IMPORTANCE};
}

SampleTable build_sample_table(const Importance& sampler, glm::vec2 roughness, uint32_t face_size) {
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    SampleTable table;
    for (const glm::dvec2& x : unit_points(sampler.points, sampler.samples)) {
        const double radius = std::sqrt(-std::log(x.x));
        const glm::dvec2 slope =
            glm::dvec2(roughness) * radius * glm::dvec2(std::cos(2 * PI * x.y), std::sin(2 * PI * x.y));
        const double cos_h = 1.0 / std::sqrt(1.0 + glm::dot(slope, slope));
        // p_h = D cos_h = q / (pi mx my cos_h^3), and q = x1 by construction.
        const double density = x.x / (PI * roughness.x * roughness.y * cos_h * cos_h * cos_h);
        table.entries.emplace_back(slope.x, slope.y, 1.0 / (sampler.samples * cos_h),
                                   texels / (sampler.samples * density) * cos_h);
    }
    return table;
}

PlanePoints plane_points(const Importance& sampler, const LobeShape& shape) {
    PlanePoints points;
    for (const glm::dvec2& x : unit_points(sampler.points, sampler.samples)) {
        // A Gaussian's share lies outside of its radius, Student's inside: neither has to be infinite.
        const bool is_gaussian = shape.model->density == Density::gaussian;
        const double r2 = is_gaussian ? -std::log(x.x) : x.x / (1.0 - x.x);
        points.places.push_back(std::sqrt(r2) * glm::dvec2(std::cos(2 * PI * x.y), std::sin(2 * PI * x.y)));
        points.areas.push_back(1.0 / (sampler.samples * plane_density(shape.model->density, r2)));
    }
    return points;
}

SampleTable build_scaled_table(const Importance& sampler, uint32_t face_size) {
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    SampleTable table;
    for (const glm::dvec2& x : unit_points(sampler.points, sampler.samples)) {
        const double radius = std::sqrt(-std::log(x.x));
        table.entries.emplace_back(radius * std::cos(2 * PI * x.y), radius * std::sin(2 * PI * x.y),
                                   1.0 / sampler.samples, texels * PI / (sampler.samples * x.x));
    }
    return table;
}

} // namespace burnish
