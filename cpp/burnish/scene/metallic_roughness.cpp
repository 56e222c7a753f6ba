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

MetallicRoughnessPoint point_of(const MetallicRoughness& source) {
    return {.base = glm::vec3(source.base_color),
            .metallic = source.metallic,
            .roughness = source.roughness,
            .ior = source.ior,
            .specular = source.specular,
            .specular_color = source.specular_color,
            .anisotropy = source.anisotropy};
}

} // namespace

float slope_of_roughness(float roughness) {
    return std::max(roughness * roughness, MIN_ROUGHNESS);
}

// A lobe's Fresnel term times its weight is weight (r0 + (1 - r0)(1 - u)^5): weight r0 at normal
// incidence and weight at grazing. glTF asks for
//   f0  = mix(specular d, base, metallic)   at normal incidence, d = min(((ior - 1)/(ior + 1))^2
//   specular_color, 1), f90 = mix(specular, 1, metallic)        at grazing, white;
// so weight = f90 and r0 = f0 / f90 (f0 <= f90 in every channel, since d <= 1 and base <= 1).
// Widths, slopes of Kurt and alphas of GGX: m = max(roughness^2, MIN_ROUGHNESS); with anisotropy of strength
// s (KHR_materials_anisotropy) m_x = mix(m, 1, s^2) along the tangent, m_y = m.
MappedSurface map_metallic_roughness(const MetallicRoughnessPoint& point) {
    float ratio = (point.ior - 1.0f) / (point.ior + 1.0f);
    glm::vec3 dielectric = point.specular * glm::min(ratio * ratio * point.specular_color, glm::vec3(1.0f));
    glm::vec3 f0 = glm::mix(dielectric, point.base, point.metallic);
    float f90 = glm::mix(point.specular, 1.0f, point.metallic);

    MappedSurface mapped;
    mapped.diffuse = point.base * (1.0f - point.metallic);
    mapped.dielectric = std::max({dielectric.x, dielectric.y, dielectric.z});
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
    const MappedSurface base = map_metallic_roughness(point_of(source));
    const bool is_kurt = source.model == MaterialModel::kurt;
    material.diffuse = is_kurt ? base.diffuse * (1.0f - base.dielectric) : base.diffuse;
    material.lobes.clear();
    const auto add = [&](glm::vec2 roughness, glm::vec3 r0, float weight, float rotation) {
        if (is_kurt)
            material.lobes.push_back(KurtLobe{.roughness = roughness,
                                              .r0 = r0,
                                              .alpha = MAPPED_ALPHA,
                                              .weight = glm::vec3(weight),
                                              .rotation = rotation,
                                              .conserve_energy = true});
        else
            material.lobes.push_back(
                GgxLobe{.roughness = roughness, .r0 = r0, .weight = glm::vec3(weight), .rotation = rotation});
    };
    if (base.weight > 0.0f) add(base.roughness, base.r0, base.weight, source.anisotropy_rotation);
    if (!is_kurt && source.sheen_color != glm::vec3(0.0f))
        material.lobes.push_back(SheenLobe{source.sheen_roughness, source.sheen_color});
    if (source.clearcoat > 0.0f)
        add(glm::vec2(slope_of_roughness(source.clearcoat_roughness)), glm::vec3(CLEARCOAT_R0),
            source.clearcoat, 0.0f);
    material.covers.clear();
    if (is_kurt) return;
    make_layers(material);
    if (base.weight <= 0.0f) {
        for (Cover& coat : material.covers)
            coat.is_over_emission = true;
    } else if (!source.specular_texture.is_used() && !source.specular_color_texture.is_used()) {
        // Beside metal only the dielectric's part lies over the diffuse one. Where a texture varies that, all
        // of the lobe stands for it: exact without metal, and nothing is diffuse where all is.
        material.covers[0].albedo = glm::vec2(base.dielectric, source.specular - base.dielectric);
    }
}

} // namespace burnish
