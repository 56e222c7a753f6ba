#include "burnish/scene/metallic_roughness.h"

#include <algorithm>
#include <stdexcept>

#include "burnish/scene/material.h"

namespace burnish {
namespace {

// Reflectance of a clear coat of ior 1.5 at normal incidence (KHR_materials_clearcoat).
constexpr float CLEARCOAT_R0 = 0.04f;
// Half way between the published grazing behaviours: the lobe's albedo is then close to its Fresnel term.
constexpr float MAPPED_ALPHA = 0.5f;

} // namespace

float slope_of_roughness(float roughness) {
    return std::max(roughness * roughness, MIN_ROUGHNESS);
}

// The Kurt lobe's Fresnel term times its weight is weight (r0 + (1 - r0)(1 - u)^5): weight r0 at normal
// incidence and weight at grazing. glTF asks for
//   f0  = mix(specular d, base, metallic)   at normal incidence, d = min(((ior - 1)/(ior + 1))^2
//   specular_color, 1), f90 = mix(specular, 1, metallic)        at grazing, white;
// so weight = f90 and r0 = f0 / f90 (f0 <= f90 in every channel, since d <= 1 and base <= 1).
// What a dielectric does not reflect at normal incidence reaches its diffuse base:
//   diffuse = base (1 - metallic) (1 - max over channels of specular d).
// Beckmann slopes: m = max(roughness^2, MIN_ROUGHNESS); with anisotropy of strength s
// (KHR_materials_anisotropy) m_x = mix(m, 1, s^2) along the tangent, m_y = m.
MappedSurface map_metallic_roughness(const MetallicRoughnessPoint& point) {
    float ratio = (point.ior - 1.0f) / (point.ior + 1.0f);
    glm::vec3 dielectric = point.specular * glm::min(ratio * ratio * point.specular_color, glm::vec3(1.0f));
    glm::vec3 f0 = glm::mix(dielectric, point.base, point.metallic);
    float f90 = glm::mix(point.specular, 1.0f, point.metallic);

    MappedSurface mapped;
    mapped.diffuse =
        point.base * (1.0f - point.metallic) * (1.0f - std::max({dielectric.x, dielectric.y, dielectric.z}));
    mapped.r0 = f90 > 0.0f ? glm::clamp(f0 / f90, 0.0f, 1.0f) : glm::vec3(0.0f);
    mapped.weight = f90;
    float m = slope_of_roughness(point.roughness);
    mapped.roughness = {glm::mix(m, 1.0f, point.anisotropy * point.anisotropy), m};
    return mapped;
}

void map_metallic_roughness(Material& material) {
    if (!material.source)
        throw std::invalid_argument("material.source: expected a metallic-roughness description, got none");
    const MetallicRoughness& source = *material.source;
    MappedSurface base = map_metallic_roughness({.base = glm::vec3(source.base_color),
                                                 .metallic = source.metallic,
                                                 .roughness = source.roughness,
                                                 .ior = source.ior,
                                                 .specular = source.specular,
                                                 .specular_color = source.specular_color,
                                                 .anisotropy = source.anisotropy});
    material.diffuse = base.diffuse;
    material.lobes.clear();
    if (base.weight > 0.0f)
        material.lobes.push_back(KurtLobe{.roughness = base.roughness,
                                          .r0 = base.r0,
                                          .alpha = MAPPED_ALPHA,
                                          .weight = glm::vec3(base.weight),
                                          .rotation = source.anisotropy_rotation,
                                          .conserve_energy = true});
    if (source.clearcoat > 0.0f)
        material.lobes.push_back(
            KurtLobe{.roughness = glm::vec2(slope_of_roughness(source.clearcoat_roughness)),
                     .r0 = glm::vec3(CLEARCOAT_R0),
                     .alpha = MAPPED_ALPHA,
                     .weight = glm::vec3(source.clearcoat),
                     .conserve_energy = true});
}

} // namespace burnish
