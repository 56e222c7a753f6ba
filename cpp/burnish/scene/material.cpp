#include "burnish/scene/material.h"

#include "burnish/check.h"

namespace burnish {
namespace {

void validate(const MetallicRoughness& source) {
    require_unit("source.base_color", glm::vec3(source.base_color));
    require_range("source.base_color", source.base_color.w, 0.0f, 1.0f);
    require_range("source.metallic", source.metallic, 0.0f, 1.0f);
    require_range("source.roughness", source.roughness, 0.0f, 1.0f);
    if (!(source.ior == 0.0f || source.ior >= 1.0f) || !std::isfinite(source.ior))
        throw std::invalid_argument(
            message("source.ior: expected 0 or a finite number >= 1, got ", source.ior));
    require_range("source.specular", source.specular, 0.0f, 1.0f);
    require_non_negative("source.specular_color", source.specular_color);
    require_range("source.anisotropy", source.anisotropy, 0.0f, 1.0f);
    require_range("source.clearcoat", source.clearcoat, 0.0f, 1.0f);
    require_range("source.clearcoat_roughness", source.clearcoat_roughness, 0.0f, 1.0f);
    require_unit("source.sheen_color", source.sheen_color);
    require_range("source.sheen_roughness", source.sheen_roughness, 0.0f, 1.0f);
    require_range("source.occlusion_strength", source.occlusion_strength, 0.0f, 1.0f);
    if (!std::isfinite(source.anisotropy_rotation) || !std::isfinite(source.normal_scale) ||
        !std::isfinite(source.clearcoat_normal_scale))
        throw std::invalid_argument("source: expected finite anisotropy_rotation, normal_scale and "
                                    "clearcoat_normal_scale, got a non-finite number");
}

} // namespace

float coverage_cutoff(const Material& material) {
    return material.alpha_mode == AlphaMode::blend ? 0.5f : material.alpha_cutoff;
}

bool has_coverage(const Material& material) {
    const float most = material.source ? material.source->base_color.w : 1.0f;
    return material.alpha_mode == AlphaMode::opaque || most >= coverage_cutoff(material);
}

void make_layers(Material& material) {
    material.covers.assign(material.lobes.size(), Cover{});
    if (!material.covers.empty()) material.covers[0].is_over_emission = false;
}

void validate(const Material& material) {
    require_unit("diffuse", material.diffuse);
    require_non_negative("emissive", material.emissive);
    if (!(material.alpha_cutoff >= 0.0f) || !std::isfinite(material.alpha_cutoff))
        throw std::invalid_argument(
            message("alpha_cutoff: expected a finite number >= 0, got ", material.alpha_cutoff));
    if (material.lobes.size() > MAX_LOBES)
        throw std::invalid_argument(
            message("lobes: expected at most ", MAX_LOBES, ", got ", material.lobes.size()));
    if (!material.covers.empty() && material.covers.size() != material.lobes.size())
        throw std::invalid_argument(message("covers: expected one a lobe, ", material.lobes.size(), ", got ",
                                            material.covers.size()));
    for (size_t i = 0; i < material.lobes.size(); ++i)
        validate(material.lobes[i], message("lobes[", i, "]."));
    if (material.source) validate(*material.source);
}

} // namespace burnish
