// The host's twins of octahedral_encode and octahedral_decode in glsl/lib/frame.glsl.
#pragma once

#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

namespace burnish::render {

inline glm::vec2 sign_not_zero(glm::vec2 v) {
    return {v.x >= 0.0f ? 1.0f : -1.0f, v.y >= 0.0f ? 1.0f : -1.0f};
}

inline glm::vec2 octahedral_encode(glm::vec3 n) {
    const glm::vec2 p = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    return n.z >= 0.0f ? p : (1.0f - glm::abs(glm::vec2(p.y, p.x))) * sign_not_zero(p);
}

inline glm::vec3 octahedral_decode(glm::vec2 p) {
    const glm::vec3 n(p, 1.0f - std::abs(p.x) - std::abs(p.y));
    const glm::vec2 folded = (1.0f - glm::abs(glm::vec2(n.y, n.x))) * sign_not_zero(glm::vec2(n));
    return glm::normalize(n.z < 0.0f ? glm::vec3(folded, n.z) : n);
}

} // namespace burnish::render
