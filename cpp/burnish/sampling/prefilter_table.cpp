#include "burnish/sampling/prefilter_table.h"

#include <algorithm>

#include "shared/prefilter.h"

namespace burnish {
namespace {

constexpr uint32_t LEAST_SAMPLES = 64, MOST_SAMPLES = 1024;
constexpr float MIP_BIAS = -0.5f;

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

} // namespace burnish
