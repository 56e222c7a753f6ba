// Metallic-roughness to diffuse + lobe on plain values. glsl/lib/metallic_roughness.glsl holds the same
// function.
#pragma once

#include <glm/glm.hpp>

namespace burnish {

/// The base layer at one point, textures and vertex colours multiplied in.
struct MetallicRoughnessPoint {
    glm::vec3 base{1.0f};
    float metallic = 1.0f;
    float roughness = 1.0f; ///< perceptual, in [0, 1]
    float ior = 1.5f;       ///< 0 stands for infinity, as in KHR_materials_ior
    float specular = 1.0f;
    glm::vec3 specular_color{1.0f};
    float anisotropy = 0.0f; ///< strength, in [0, 1]
};

/// What the shading kernel needs of it.
struct MappedSurface {
    glm::vec3 diffuse{0.0f};
    glm::vec3 r0{0.0f};
    float weight = 0.0f; ///< 0: no lobe
    /// The most of a channel that a dielectric reflects along the normal.
    float dielectric = 0.0f;
    glm::vec2 roughness{1.0f};
};

MappedSurface map_metallic_roughness(const MetallicRoughnessPoint& point);

/// Beckmann slope of a perceptual roughness: max(roughness^2, MIN_ROUGHNESS).
float slope_of_roughness(float roughness);

} // namespace burnish
