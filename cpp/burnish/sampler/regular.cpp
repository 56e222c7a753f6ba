#include "burnish/sampler/regular.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "burnish/error.h"
#include "burnish/sampler/regular_pattern.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;

/// Texel factor of a pattern of `count` samples before the view terms (maths: section 4); see SampleTable for
/// hz.
double regular_texel_factor(const Regular& sampler, glm::dvec2 roughness, uint32_t face_size, double count) {
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    if (sampler.footprint == Footprint::exact)
        return texels * lobe_solid_angle(roughness, sampler.threshold) / count;
    const double reach = std::sqrt(-std::log(double(sampler.threshold)));
    const double sin_u = std::sin(std::atan(reach * roughness.x));
    const double sin_v = std::sin(std::atan(reach * roughness.y));
    return texels * PI * sin_u * sin_v / count;
}

uint32_t normalization_of(Normalization normalization) {
    switch (normalization) {
    case Normalization::published:
        return shared::NORMALIZATION_PUBLISHED;
    case Normalization::projected:
        return shared::NORMALIZATION_PROJECTED;
    case Normalization::furnace:
        return shared::NORMALIZATION_FURNACE;
    }
    return shared::NORMALIZATION_FURNACE;
}

} // namespace

void validate(const Regular& sampler) {
    require_samples(sampler.samples);
    if (!(sampler.threshold > 0.0f && sampler.threshold < 1.0f))
        throw std::invalid_argument(
            message("threshold: expected a value in (0, 1), got ", sampler.threshold));
    require_mip_bias(sampler.mip_bias);
}

SamplerFacts facts(const Regular& sampler) {
    const bool is_furnace = sampler.normalization == Normalization::furnace;
    const bool is_published = sampler.footprint == Footprint::published;
    return {.text = message("regular:", sampler.samples, diffuse_text(sampler.diffuse)),
            .diffuse = sampler.diffuse,
            .placing = Placing::pattern,
            .samples = sampler.samples,
            .needs_albedo = is_furnace,
            .footprint = is_published ? shared::FOOTPRINT_PUBLISHED : shared::FOOTPRINT_EXACT,
            // Tables of one roughness hold the other two.
            .normalization = is_furnace ? shared::NORMALIZATION_FURNACE : shared::NORMALIZATION_CONSTANT,
            .scaled_normalization = normalization_of(sampler.normalization),
            .scaled_table = shared::TABLE_SCALED_REGULAR,
            .threshold_log = -std::log(sampler.threshold)};
}

SampleTable build_sample_table(const Regular& sampler, glm::vec2 roughness, uint32_t face_size) {
    const glm::dvec2 m = roughness;
    const std::vector<glm::dvec3> pattern = choose_regular_pattern(m, sampler.samples, sampler.threshold);
    const double texel_factor = regular_texel_factor(sampler, m, face_size, double(pattern.size()));

    // D without the constants that the quotient cancels; cos_h is the projection that makes D integrate to
    // one.
    std::vector<double> density(pattern.size());
    double sum = 0.0;
    for (size_t k = 0; k < pattern.size(); ++k) {
        const double cos_h = pattern[k].z;
        density[k] = lobe_q(pattern[k], m) / (cos_h * cos_h * cos_h * cos_h);
        sum += sampler.normalization == Normalization::published ? density[k] : density[k] * cos_h;
    }
    SampleTable table;
    for (size_t k = 0; k < pattern.size(); ++k) {
        const glm::dvec3 h = pattern[k];
        const double hz = sampler.footprint == Footprint::exact ? h.z : 1.0 / h.z;
        table.entries.emplace_back(h.x / h.z, h.y / h.z, density[k] / sum, texel_factor * hz);
    }
    return table;
}

PlanePoints plane_points(const Regular& sampler, const LobeShape& shape) {
    if (sampler.normalization == Normalization::published || sampler.footprint == Footprint::published)
        throw std::invalid_argument(
            message("normalization, footprint: expected others than \"published\" for a ", shape.model->name,
                    " lobe, whose half-vectors depend on the view"));
    const glm::dvec2 m = shape.width();
    // The one at which a Gaussian has the radius that the density falls to the threshold at.
    constexpr double LEAST = 1e-300;
    const double threshold =
        shape.model->density == Density::gaussian
            ? double(sampler.threshold)
            : std::max(std::exp(1.0 - 1.0 / std::sqrt(double(sampler.threshold))), LEAST);
    const std::vector<glm::dvec3> pattern = choose_regular_pattern(m, sampler.samples, threshold);
    const double solid_angle = lobe_solid_angle(m, threshold) / double(pattern.size());
    PlanePoints points;
    points.is_normalized = true;
    for (const glm::dvec3& h : pattern) {
        points.places.push_back(glm::dvec2(h) / h.z / m);
        points.areas.push_back(solid_angle / (m.x * m.y * h.z * h.z * h.z));
    }
    return points;
}

SampleTable build_scaled_table(const Regular& sampler, uint32_t face_size) {
    const glm::dvec2 m(SCALED_ROUGHNESS);
    const std::vector<glm::dvec3> pattern = choose_regular_pattern(m, sampler.samples, sampler.threshold);
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    // The kernel multiplies by mx my (and, exact, by the narrowing of wide lobes).
    const double texel_factor = texels * PI * -std::log(double(sampler.threshold)) / double(pattern.size());
    SampleTable table;
    for (const glm::dvec3& h : pattern)
        table.entries.emplace_back(h.x / h.z / m.x, h.y / h.z / m.y, lobe_q(h, m), texel_factor);
    return table;
}

} // namespace burnish
