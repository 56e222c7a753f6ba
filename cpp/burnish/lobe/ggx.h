// Trowbridge and Reitz' lobe (GGX): plain data, and what the engine asks of it.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"

namespace burnish {

/// One GGX lobe: f = weight F(u) D V, with V of Smith's height-correlated shadowing and F(u) = r0 + (f90 -
/// r0)(1 - u)^5.
struct GgxLobe {
    glm::vec2 roughness{0.2f}; ///< alpha along tangent and bitangent, in [MIN_LOBE_ROUGHNESS, 1]
    glm::vec3 r0{1.0f};        ///< reflectance at normal incidence, in [0, 1]
    glm::vec3 f90{1.0f};       ///< reflectance along the surface, in [0, 1]
    glm::vec3 weight{1.0f};    ///< colour, >= 0
    float rotation = 0.0f;     ///< radians, turns the tangent counter-clockwise about the normal
    /// Puts back what light loses between facets: times 1 + r0/f90 (1/E1 - 1).
    bool compensates = false;

    bool is_anisotropic() const { return roughness.x != roughness.y; }
    bool has_fresnel() const { return r0 != f90; }
};

/// Throws std::invalid_argument, naming field, range and value; `prefix` goes before the field's name.
void validate(const GgxLobe& lobe, const std::string& prefix = "");
LobeFacts facts(const GgxLobe& lobe);
shared::LobeRecord record(const GgxLobe& lobe);

} // namespace burnish
