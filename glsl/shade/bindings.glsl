// What every shade kernel can see. A kernel uses some of it; the driver drops the rest.
#ifndef BURNISH_SHADE_BINDINGS
#define BURNISH_SHADE_BINDINGS

#include "shade/records.glsl"
#include "shared/constants.h"
#include "shared/records.h"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

layout(constant_id = SPEC_SOURCE) const uint SOURCE = SOURCE_PIXELS;
layout(constant_id = SPEC_LOBE_COUNT) const uint LOBE_COUNT = 1u;
layout(constant_id = SPEC_LOBE_MODELS) const uint LOBE_MODELS = 0u;
layout(constant_id = SPEC_HAS_FRESNEL) const bool HAS_FRESNEL = false;
layout(constant_id = SPEC_ALPHA) const uint ALPHA = ALPHA_ZERO;
layout(constant_id = SPEC_HAS_TANGENT) const bool HAS_TANGENT = false;
layout(constant_id = SPEC_HAS_DIFFUSE) const bool HAS_DIFFUSE = false;
layout(constant_id = SPEC_HAS_EMISSIVE) const bool HAS_EMISSIVE = false;
layout(constant_id = SPEC_HAS_VARYING) const bool HAS_VARYING = false;
layout(constant_id = SPEC_HAS_VARYING_EMISSIVE) const bool HAS_VARYING_EMISSIVE = false;
layout(constant_id = SPEC_HAS_COAT) const bool HAS_COAT = false;
layout(constant_id = SPEC_HAS_COAT_NORMAL) const bool HAS_COAT_NORMAL = false;
layout(constant_id = SPEC_HAS_FIXED_LOBE) const bool HAS_FIXED_LOBE = false;
layout(constant_id = SPEC_HAS_MAP_ROTATION) const bool HAS_MAP_ROTATION = false;
layout(constant_id = SPEC_HAS_LIGHTS) const bool HAS_LIGHTS = false;
layout(constant_id = SPEC_SHADE_CLASS) const uint SHADE_CLASS = 0u;
layout(constant_id = SPEC_TILE_LIST) const uint TILE_LIST = 0u;
layout(constant_id = SPEC_IS_DISPLAY) const bool IS_DISPLAY = false;

layout(push_constant) uniform Push { ShadeRecord push; };
layout(binding = BINDING_SURFACE, rg32ui) uniform readonly uimage2D surface_image;
layout(binding = BINDING_VARYING_DIFFUSE, rgba16f) uniform readonly image2D varying_diffuse;
layout(binding = BINDING_VARYING_SPECULAR, rgba16f) uniform readonly image2D varying_specular;
layout(binding = BINDING_VARYING_EMISSIVE, rgba16f) uniform readonly image2D varying_emissive;
layout(binding = BINDING_VARYING_COAT, rg32ui) uniform readonly uimage2D varying_coat;
layout(std430, binding = BINDING_POINTS) readonly buffer Points { SurfacePoint points[]; };
layout(std430, binding = BINDING_TILES) readonly buffer Tiles { uint tiles[]; };
layout(std430, binding = BINDING_TILE_COUNTS) readonly buffer TileCounts { uvec4 tile_counts[]; };
layout(std430, binding = BINDING_RADIANCE) buffer Radiance { vec4 radiance_out[]; };
layout(std430, binding = BINDING_DISPLAY) buffer Display { uint display_out[]; };
layout(std430, binding = BINDING_COUNTERS) buffer CounterBlock { Counters counters; };

#endif
