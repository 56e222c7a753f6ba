// The textures that a material may have: one list for all that goes through them.
#pragma once

#include <algorithm>
#include <iterator>

#include "burnish/scene/material.h"
#include "shared/constants.h"

namespace burnish {

struct TextureKind {
    uint32_t kind; ///< shared::TEXTURE_*, its place in the list
    const char* name;
    TextureUse MetallicRoughness::*use;
    bool is_srgb;
};

inline constexpr TextureKind TEXTURE_KINDS[] = {
    {shared::TEXTURE_BASE_COLOR, "base colour texture", &MetallicRoughness::base_color_texture, true},
    {shared::TEXTURE_METALLIC_ROUGHNESS, "metallic-roughness texture",
     &MetallicRoughness::metallic_roughness_texture, false},
    {shared::TEXTURE_NORMAL, "normal mapping", &MetallicRoughness::normal_texture, false},
    {shared::TEXTURE_OCCLUSION, "occlusion texture", &MetallicRoughness::occlusion_texture, false},
    {shared::TEXTURE_EMISSIVE, "emissive texture", &MetallicRoughness::emissive_texture, true},
    {shared::TEXTURE_SPECULAR, "specular texture", &MetallicRoughness::specular_texture, false},
    {shared::TEXTURE_SPECULAR_COLOR, "specular colour texture", &MetallicRoughness::specular_color_texture,
     true},
    {shared::TEXTURE_ANISOTROPY, "anisotropy texture", &MetallicRoughness::anisotropy_texture, false},
    {shared::TEXTURE_CLEARCOAT, "clear coat texture", &MetallicRoughness::clearcoat_texture, false},
    {shared::TEXTURE_CLEARCOAT_ROUGHNESS, "clear coat roughness texture",
     &MetallicRoughness::clearcoat_roughness_texture, false},
    {shared::TEXTURE_CLEARCOAT_NORMAL, "clear coat normal mapping",
     &MetallicRoughness::clearcoat_normal_texture, false},
};
static_assert(std::size(TEXTURE_KINDS) == shared::TEXTURE_KINDS);
static_assert(std::ranges::all_of(TEXTURE_KINDS,
                                  [](const TextureKind& one) { return &TEXTURE_KINDS[one.kind] == &one; }));

} // namespace burnish
