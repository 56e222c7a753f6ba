// Filtered importance sampling (GPU Gems 3, ch. 20).
#pragma once

#include "burnish/sampler/facts.h"
#include "burnish/sampler/sample_table.h"

namespace burnish {

/// Filtered importance sampling (GPU Gems 3, ch. 20) of the lobe's half-vectors.
struct Importance {
    uint32_t samples = 14;
    PointSet points = PointSet::hammersley;
    float mip_bias = 0.0f;
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Importance& sampler);
SamplerFacts facts(const Importance& sampler);

SampleTable build_sample_table(const Importance& sampler, glm::vec2 roughness, uint32_t face_size);
SampleTable build_scaled_table(const Importance& sampler, uint32_t face_size);
/// Points in proportion to the density of the lobe's plane.
PlanePoints plane_points(const Importance& sampler, const LobeShape& shape);

} // namespace burnish
