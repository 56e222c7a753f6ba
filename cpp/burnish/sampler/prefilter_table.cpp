#include "burnish/sampler/prefilter_table.h"

#include <algorithm>
#include <cmath>

#include "burnish/sampler/importance.h"
#include "burnish/sampler/matched_table.h"
#include "shared/prefilter.h"

namespace burnish {
namespace {

constexpr uint32_t LEAST_SAMPLES = 64, MOST_SAMPLES = 1024;
constexpr float MIP_BIAS = -0.5f;
constexpr uint32_t SPHERICAL_SAMPLES = 24;
constexpr double SPHERICAL_BIAS = -0.05; ///< levels; what measures best for a mixture this fine

} // namespace

float prefiltered_roughness(uint32_t size) {
    return shared::PREFILTER_SLOPE / static_cast<float>(size);
}

SampleTable build_prefilter_table(uint32_t level, uint32_t face_size) {
    const uint32_t samples = std::min(LEAST_SAMPLES << std::min(level - 1, 8u), MOST_SAMPLES);
    const Importance sampler{samples, PointSet::fibonacci, MIP_BIAS};
    SampleTable table =
        build_sample_table(sampler, glm::vec2(prefiltered_roughness(face_size >> level)), face_size);
    // cos_i = 2 cos_h^2 - 1, which a slope of one and more makes negative.
    std::erase_if(table.entries,
                  [](const glm::vec4& entry) { return entry.x * entry.x + entry.y * entry.y >= 1.0f; });
    while (table.entries.size() % shared::PREFILTER_PHASE)
        table.entries.emplace_back(0.0f);
    return table;
}

SampleTable build_spherical_table(uint32_t size, uint32_t face_size, PyramidFilter filter) {
    const std::vector<glm::vec4> mixtures = matched_mixtures(SPHERICAL_SAMPLES);
    const double texel = 2.0 / size, scale = std::sqrt(2.0 * shared::SPHERICAL_LEVEL_VARIANCE) * texel;
    const double texels = double(face_size) * face_size / (4.0 * row_of(filter).lookup_variance) *
                          std::exp2(2.0 * SPHERICAL_BIAS);
    SampleTable table;
    for (uint32_t k = 0; k < SPHERICAL_SAMPLES / 2; ++k) {
        const glm::dvec4 mixture = mixtures[k]; // of the first row: an aspect of 1
        const glm::dvec2 y(mixture);
        const double angle = scale * glm::length(y), deviation = scale * mixture.z;
        const glm::dvec2 slope = y / glm::length(y) * std::tan(0.5 * angle);
        table.entries.emplace_back(slope.x, slope.y, mixture.w, texels * deviation * deviation);
    }
    return table;
}

float spherical_share(double variance, uint32_t face_size) {
    return float(variance * face_size * face_size / (16.0 * shared::SPHERICAL_VARIANCE));
}

float spherical_level(double variance, uint32_t face_size) {
    const float share = spherical_share(variance, face_size);
    return share > 1.0f ? 1.0f + 0.5f * std::log2(share) : share;
}

} // namespace burnish
