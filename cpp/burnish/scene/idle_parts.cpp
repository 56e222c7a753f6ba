#include "burnish/scene/idle_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "burnish/error.h"
#include "burnish/scene/texture_kinds.h"

namespace burnish {
namespace {

float linear_of_srgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/// The texel that all of a picture has.
std::optional<glm::vec4> only_texel(const TextureImage& image, bool is_srgb) {
    const uint8_t* const first = image.rgba.data();
    for (size_t k = 4; k < image.rgba.size(); k += 4)
        if (std::memcmp(first, first + k, 4) != 0) return std::nullopt;
    if (image.rgba.size() < 4) return std::nullopt;
    glm::vec4 texel = glm::vec4(first[0], first[1], first[2], first[3]) / 255.0f;
    if (is_srgb)
        for (int channel = 0; channel < 3; ++channel)
            texel[channel] = linear_of_srgb(texel[channel]);
    return texel;
}

/// Eight bits have no middle: 127 and 128 both stand for it.
bool is_flat(glm::vec4 texel) {
    constexpr float STEP = 1.0f / 255.0f;
    return std::abs(texel.x - 0.5f) < STEP && std::abs(texel.y - 0.5f) < STEP && texel.z > 1.0f - 1.5f * STEP;
}

/// Multiplies the value into the material; false where no factor can stand for it.
bool fold(Material& material, uint32_t kind, glm::vec4 texel) {
    MetallicRoughness& source = *material.source;
    switch (kind) {
    case shared::TEXTURE_BASE_COLOR:
        source.base_color *= texel;
        return true;
    case shared::TEXTURE_METALLIC_ROUGHNESS:
        source.metallic *= texel.z;
        source.roughness *= texel.y;
        return true;
    case shared::TEXTURE_EMISSIVE:
        material.emissive *= glm::vec3(texel);
        return true;
    case shared::TEXTURE_SPECULAR:
        source.specular *= texel.w;
        return true;
    case shared::TEXTURE_SPECULAR_COLOR:
        source.specular_color *= glm::vec3(texel);
        return true;
    case shared::TEXTURE_ANISOTROPY: {
        const glm::vec2 direction = 2.0f * glm::vec2(texel) - 1.0f;
        if (glm::dot(direction, direction) > 1e-4f)
            source.anisotropy_rotation += std::atan2(direction.y, direction.x);
        source.anisotropy *= texel.z;
        return true;
    }
    case shared::TEXTURE_CLEARCOAT:
        source.clearcoat *= texel.x;
        return true;
    case shared::TEXTURE_CLEARCOAT_ROUGHNESS:
        source.clearcoat_roughness *= texel.y;
        return true;
    case shared::TEXTURE_OCCLUSION:
        return texel.x == 1.0f || source.occlusion_strength == 0.0f;
    case shared::TEXTURE_NORMAL:
    case shared::TEXTURE_CLEARCOAT_NORMAL:
        return is_flat(texel);
    default:
        return false;
    }
}

} // namespace

void leave_out_idle_lobes(Material& material) {
    for (size_t which = material.lobes.size(); which-- > 0;) {
        const shared::LobeRecord reflected = record(material.lobes[which]);
        if (glm::vec3(reflected.specular) != glm::vec3(0.0f) ||
            glm::vec3(reflected.grazing) != glm::vec3(0.0f))
            continue;
        material.lobes.erase(material.lobes.begin() + which);
        if (!material.covers.empty()) material.covers.erase(material.covers.begin() + which);
        material.left_out.push_back(message("lobe ", which + 1, " reflects nothing"));
    }
}

void leave_out_idle_textures(Scene& scene) {
    std::vector<bool> is_coloured;
    for (const Mesh& mesh : scene.meshes)
        is_coloured.push_back(
            std::ranges::any_of(mesh.colors, [](glm::vec4 color) { return color != glm::vec4(1.0f); }));
    std::vector<bool> has_colors(scene.materials.size(), false);
    for (const Object& object : scene.objects)
        if (is_coloured[object.mesh]) has_colors[object.material] = true;
    for (size_t index = 0; index < scene.materials.size(); ++index) {
        Material& material = scene.materials[index];
        if (!material.source) continue;
        MetallicRoughness& source = *material.source;
        const size_t before = material.left_out.size();
        if (source.has_vertex_color && !has_colors[index]) {
            source.has_vertex_color = false;
            material.left_out.emplace_back("vertex colours are white");
        }
        for (const TextureKind& kind : TEXTURE_KINDS) {
            TextureUse& use = source.*kind.use;
            if (!use.is_used()) continue;
            const auto texel = only_texel(scene.images[use.image], kind.is_srgb);
            if (!texel || !fold(material, kind.kind, *texel)) continue;
            use = {};
            material.left_out.push_back(message(kind.name, " is of one value"));
        }
        if (material.left_out.size() > before) map_metallic_roughness(material);
    }
}

} // namespace burnish
