// These functions say what one material calls for.
#pragma once

#include <functional>

#include "burnish/scene/material.h"

namespace burnish {

bool has_texture(const Material& material, TextureUse MetallicRoughness::*which);
/// Textures or vertex colours make its attributes vary over the surface.
bool is_varying(const Material& material);
bool any_lobe(const Material& material, const std::function<bool(const LobeFacts&)>& asks);
bool has_diffuse(const Material& material);
bool has_emissive(const Material& material);
bool has_coat(const Material& material);
/// The coat's normal is not the base's: that has a normal map, or the coat has one.
bool has_coat_normal(const Material& material);
/// A lobe of a textured material is the same all over the surface: the last but the coat.
bool has_fixed_lobe(const Material& material);
/// A textured material emits, or its base does not reflect all along the surface: both go into one target.
bool has_varying_emissive(const Material& material);
/// A lobe takes light from something that lies below it.
bool has_layers(const Material& material);
/// A lobe reflects differently along tangent and bitangent.
bool is_brushed(const Material& material);
/// Tells whether the material looks otherwise under other tangents of its mesh.
bool needs_tangent(const Material& material);

} // namespace burnish
