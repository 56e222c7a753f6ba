// What materials call for, and the lines that say so.
#pragma once

#include <string>

#include "burnish/plan/plan.h"

namespace burnish {

bool has_diffuse(const Material& material);
/// How the sampler sees the light on diffuse surfaces.
const char* describe_diffuse(const Sampler& sampler);
bool has_emissive(const Material& material);
bool has_coat(const Material& material);
/// Textures or vertex colours make its attributes vary over the surface.
bool is_varying(const Material& material);
bool has_texture(const Material& material, TextureUse MetallicRoughness::*which);

/// "2 of 5 materials, regular:14 from constants, ...": why this pipeline exists.
std::string describe(const ShadeClass& one, const Scene& scene, const Plan& plan, size_t constant_count);
void add_effect_lines(const Scene& scene, Plan& plan);
void add_pass_lines(Plan& plan);

} // namespace burnish
