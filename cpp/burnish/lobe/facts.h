// Plan and renderer ask this of a lobe; each model answers for itself in its own file.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "shared/constants.h"
#include "shared/records.h"

namespace burnish {

struct LobeFacts {
    glm::vec2 width{0.0f}; ///< slopes along tangent and bitangent
    bool is_brushed = false;
    bool has_fresnel = false;
    bool gains_energy = false; ///< and is to be divided by its albedo where that exceeds 1
    float alpha = 0.0f;        ///< exponent of the cosines
    uint32_t alpha_form = shared::ALPHA_ZERO;
    /// F = specular + grazing (1 - o.h)^5 over all channels, of which the sum is 1: weighs directions.
    float specular = 1.0f;
    float grazing = 0.0f;
};

} // namespace burnish
