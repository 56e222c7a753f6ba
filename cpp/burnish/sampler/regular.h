// Regular sampling (CGI 2014): half-vectors on equally spaced circles of the lobe.
#pragma once

#include "burnish/sampler/facts.h"
#include "burnish/sampler/sample_table.h"

namespace burnish {

enum class Footprint { published, exact };
enum class Normalization { published, projected, furnace };

/// Half-vectors on equally spaced circles (RS section 5). A budget: the pattern whose count comes closest is
/// used.
struct Regular {
    uint32_t samples = 14;
    float threshold = 0.2f; ///< xi0: half-vectors of q below it are dropped, in (0, 1)
    Footprint footprint = Footprint::exact;
    Normalization normalization = Normalization::furnace;
    float mip_bias = 0.0f; ///< added to the mip level
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Regular& sampler);
SamplerFacts facts(const Regular& sampler);

SampleTable build_sample_table(const Regular& sampler, glm::vec2 roughness, uint32_t face_size);
SampleTable build_scaled_table(const Regular& sampler, uint32_t face_size);
/// The pattern down to where the density of the lobe's plane has fallen to the threshold. Throws
/// std::invalid_argument for forms that are printed for other lobes.
PlanePoints plane_points(const Regular& sampler, const LobeShape& shape);

} // namespace burnish
