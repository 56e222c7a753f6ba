#include "burnish/plan/material_traits.h"

#include <algorithm>

#include "burnish/scene/metallic_roughness.h"
#include "burnish/scene/texture_kinds.h"

namespace burnish {

bool any_lobe(const Material& material, const std::function<bool(const LobeFacts&)>& asks) {
    return std::ranges::any_of(material.lobes, [&](const Lobe& lobe) { return asks(facts(lobe)); });
}

bool has_texture(const Material& material, TextureUse MetallicRoughness::*which) {
    return material.source && (*material.source.*which).is_used();
}

bool is_varying(const Material& material) {
    return material.source &&
           (material.source->has_vertex_color ||
            std::any_of(std::begin(TEXTURE_KINDS), std::end(TEXTURE_KINDS),
                        [&](const TextureKind& kind) { return has_texture(material, kind.use); }));
}

bool has_diffuse(const Material& material) {
    if (material.diffuse != glm::vec3(0.0f)) return true;
    if (!is_varying(material)) return false;
    // Somewhere textures may make it less metallic, or less reflecting, than its factors.
    const MetallicRoughness& source = *material.source;
    const bool has_specular_color = has_texture(material, &MetallicRoughness::specular_color_texture);
    const MetallicRoughnessPoint least = {
        .base = glm::vec3(source.base_color),
        .metallic =
            has_texture(material, &MetallicRoughness::metallic_roughness_texture) ? 0.0f : source.metallic,
        .ior = source.ior,
        .specular = has_texture(material, &MetallicRoughness::specular_texture) ? 0.0f : source.specular,
        .specular_color = has_specular_color ? glm::vec3(0.0f) : source.specular_color};
    return map_metallic_roughness(least).diffuse != glm::vec3(0.0f);
}

bool has_emissive(const Material& material) {
    return material.emissive != glm::vec3(0.0f);
}

bool has_coat(const Material& material) {
    return material.source && material.source->clearcoat > 0.0f;
}

bool has_coat_normal(const Material& material) {
    return has_coat(material) && (has_texture(material, &MetallicRoughness::normal_texture) ||
                                  has_texture(material, &MetallicRoughness::clearcoat_normal_texture));
}

bool has_fixed_lobe(const Material& material) {
    return is_varying(material) && material.source->model == MaterialModel::ggx &&
           material.source->sheen_color != glm::vec3(0.0f);
}

bool has_varying_emissive(const Material& material) {
    return is_varying(material) && (has_emissive(material) || material.source->specular != 1.0f ||
                                    has_texture(material, &MetallicRoughness::specular_texture));
}

bool has_layers(const Material& material) {
    if (material.covers.empty()) return false;
    return material.lobes.size() > 1 || has_diffuse(material) ||
           (has_emissive(material) && material.covers[0].is_over_emission);
}

bool is_brushed(const Material& material) {
    // A texture may make a lobe narrower than its factors, of which the widest is round however brushed.
    if (is_varying(material)) return material.source->anisotropy > 0.0f && !material.lobes.empty();
    return any_lobe(material, [](const LobeFacts& lobe) { return lobe.is_brushed; });
}

bool needs_tangent(const Material& material) {
    return is_brushed(material) || has_texture(material, &MetallicRoughness::normal_texture) ||
           has_texture(material, &MetallicRoughness::clearcoat_normal_texture);
}

} // namespace burnish
