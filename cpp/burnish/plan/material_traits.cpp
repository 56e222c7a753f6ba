#include "burnish/plan/material_traits.h"

#include <algorithm>

#include "burnish/scene/texture_kinds.h"

namespace burnish {

bool any_lobe(const Material& material, const std::function<bool(const KurtLobe&)>& asks) {
    return std::any_of(material.lobes.begin(), material.lobes.end(), asks);
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
    return material.diffuse != glm::vec3(0.0f) ||
           has_texture(
               material,
               &MetallicRoughness::metallic_roughness_texture); // may be less metallic than its factor
}

bool has_emissive(const Material& material) {
    return material.emissive != glm::vec3(0.0f);
}

bool has_coat(const Material& material) {
    return material.source && material.source->clearcoat > 0.0f;
}

bool is_brushed(const Material& material) {
    // A texture may make a lobe narrower than its factors, of which the widest is round however brushed.
    if (is_varying(material)) return material.source->anisotropy > 0.0f && !material.lobes.empty();
    return any_lobe(material, [](const KurtLobe& lobe) { return lobe.is_anisotropic(); });
}

} // namespace burnish
