// Lafortune's lobe: plain data, and what the engine asks of it.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"

namespace burnish {

/// Wider than any picture of a map can tell from a mirror.
constexpr float MOST_LAFORTUNE_EXPONENT = 1e6f;

/// f = weight max(o^T diag(c) i, 0)^exponent (Lafortune et al. 1997). c = (-1, -1, 1): Phong's, around the
/// mirrored view; (1, 1, 1): back toward the eye.
struct LafortuneLobe {
    glm::vec3 c{-1.0f, -1.0f, 1.0f}; ///< along tangent, bitangent and normal; finite
    float exponent = 10.0f;          ///< in [0, MOST_LAFORTUNE_EXPONENT]
    glm::vec3 weight{1.0f};          ///< colour, >= 0
    float rotation = 0.0f;           ///< radians, turns the tangent counter-clockwise about the normal

    bool is_anisotropic() const { return c.x != c.y; }
};

/// Throws std::invalid_argument, naming field, range and value; `prefix` goes before the field's name.
void validate(const LafortuneLobe& lobe, const std::string& prefix = "");
LobeFacts facts(const LafortuneLobe& lobe);
shared::LobeRecord record(const LafortuneLobe& lobe);

} // namespace burnish
