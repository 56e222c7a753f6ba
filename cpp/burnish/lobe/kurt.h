// Kurt's lobe: plain data, and what the engine asks of it.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"

namespace burnish {

/// Below this slope a lobe is a mirror to any map the engine can hold: descriptions map to nothing narrower.
constexpr float MIN_ROUGHNESS = 1e-3f;

/// One Kurt lobe (maths: section 1). f = weight F(u) D / (4 (o.h) ((i.n)(o.n))^alpha), F(u) = r0 + (1 - r0)(1
/// - u)^5.
struct KurtLobe {
    glm::vec2 roughness{0.2f}; ///< Beckmann slopes along tangent and bitangent, in [MIN_LOBE_ROUGHNESS, 1]
    glm::vec3 r0{1.0f};        ///< reflectance at normal incidence, in [0, 1]; 1 switches Fresnel off
    float alpha = 0.0f;        ///< grazing exponent, in [0, 1]
    glm::vec3 weight{1.0f};    ///< colour, >= 0
    float rotation = 0.0f;     ///< radians, turns the tangent counter-clockwise about the normal
    /// Divide by the albedo for r0 = 1 where that exceeds 1: the published model gains energy toward grazing
    /// views for alpha > 0 (2.9 times at 89 degrees, slope .6, alpha .5).
    bool conserve_energy = false;

    bool is_anisotropic() const { return roughness.x != roughness.y; }
    bool has_fresnel() const { return r0 != glm::vec3(1.0f); }
};

/// Throws std::invalid_argument, naming field, range and value; `prefix` goes before the field's name.
void validate(const KurtLobe& lobe, const std::string& prefix = "");
LobeFacts facts(const KurtLobe& lobe);
shared::LobeRecord record(const KurtLobe& lobe);

} // namespace burnish
