// Materials as plain data: diffuse plus one to four lobes, and the metallic-roughness source they came
// from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/lobe/lobe.h"
#include "burnish/scene/texture.h"

namespace burnish {

constexpr uint32_t MAX_LOBES = 4;

enum class AlphaMode { opaque, mask, blend };

/// Which lobes a metallic-roughness description becomes.
enum class MaterialModel {
    ggx, ///< GGX lobes in layers, as glTF means it
    kurt ///< Kurt's lobes that add up
};

/// The glTF description a material came from, kept for what varies over the surface.
struct MetallicRoughness {
    MaterialModel model = MaterialModel::ggx;
    glm::vec4 base_color{1.0f}; ///< linear RGB and coverage
    float metallic = 1.0f;
    float roughness = 1.0f; ///< perceptual, in [0, 1]; slope m = max(roughness^2, MIN_ROUGHNESS)
    float ior = 1.5f;
    float specular = 1.0f;            ///< KHR_materials_specular
    glm::vec3 specular_color{1.0f};   ///< KHR_materials_specular
    float anisotropy = 0.0f;          ///< KHR_materials_anisotropy strength, in [0, 1]
    float anisotropy_rotation = 0.0f; ///< radians
    float clearcoat = 0.0f;           ///< KHR_materials_clearcoat
    float clearcoat_roughness = 0.0f; ///< perceptual
    glm::vec3 sheen_color{0.0f};      ///< KHR_materials_sheen, in [0, 1]
    float sheen_roughness = 0.0f;     ///< perceptual
    float normal_scale = 1.0f;
    float clearcoat_normal_scale = 1.0f;
    float occlusion_strength = 1.0f;
    bool has_vertex_color = false;
    bool is_unlit = false; ///< KHR_materials_unlit: `emissive` is the base colour, nothing reflects

    TextureUse base_color_texture;          ///< sRGB
    TextureUse metallic_roughness_texture;  ///< linear, g = roughness, b = metallic
    TextureUse normal_texture;              ///< linear
    TextureUse occlusion_texture;           ///< linear, r
    TextureUse emissive_texture;            ///< sRGB
    TextureUse specular_texture;            ///< linear, a
    TextureUse specular_color_texture;      ///< sRGB
    TextureUse anisotropy_texture;          ///< linear, rg = direction, b = strength
    TextureUse clearcoat_texture;           ///< linear, r
    TextureUse clearcoat_roughness_texture; ///< linear, g
    TextureUse clearcoat_normal_texture;    ///< linear; without it the coat has the mesh's normal
};

/// What a lobe takes of the light on its way to what lies below it.
struct Cover {
    /// So much of its albedo's E1 and Es (albedo_table.h); none: the most of a channel that it reflects.
    std::optional<glm::vec2> albedo;
    bool is_over_emission = true;
};

struct Material {
    std::string name;
    glm::vec3 diffuse{0.0f}; ///< diffuse reflectance kd, in [0, 1]
    std::vector<Lobe> lobes;
    /// Of every lobe where they are layers, each over those before it and over the diffuse part: what it
    /// reflects does not reach what lies below. Empty where lobes add up.
    std::vector<Cover> covers;
    glm::vec3 emissive{0.0f}; ///< radiance, >= 0, KHR_materials_emissive_strength multiplied in
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f; ///< >= 0; above 1 nothing shows
    bool double_sided = false;
    /// Set for materials from glTF. `diffuse` and `lobes` hold its factors mapped by
    /// `map_metallic_roughness`; where a texture or vertex colour is in use the surface pass maps again at
    /// every pixel.
    std::optional<MetallicRoughness> source;
    std::vector<std::string> left_out; ///< parts that change no pixel, and why; see idle_parts.h
};

/// Coverage below which a fragment is dropped; blended materials are drawn as masks at one half.
float coverage_cutoff(const Material& material);
/// Whether some texel or vertex colour may bring it to its cutoff: else nothing of it shows.
bool has_coverage(const Material& material);

/// Throws std::invalid_argument, naming field, range and value, unless every number is in its documented
/// range.
void validate(const Material& material);

/// Makes layers of the lobes: the emission is the lowest one's surface's.
void make_layers(Material& material);

/// The stated mapping from metallic-roughness factors to diffuse + lobes; fills both from `material.source`.
///   m = max(roughness^2, MIN_ROUGHNESS), f0 = min(((ior-1)/(ior+1))^2 specular_color, 1); base lobe:
///   mix(specular f0, base, metallic) along the normal, white at grazing scaled by mix(specular, 1,
///   metallic); anisotropy: m_x = mix(m, 1, strength^2), m_y = m; clearcoat: a lobe of r0 .04 and weight =
///   factor on top. Sheen, of ggx alone, between the two.
///   ggx: alpha = m; layered, diffuse = base (1 - metallic), below the dielectric's part of the base lobe.
///   kurt: slopes m, alpha = 0.5, conserve_energy; diffuse = base (1 - metallic) (1 - max(specular f0)).
void map_metallic_roughness(Material& material);

} // namespace burnish
