// Radiance of one lobe by one lookup in a prefiltered map (shared/prefilter.h), times its exact albedo: the
// split sum.
#ifndef BURNISH_SHADE_PREFILTERED
#define BURNISH_SHADE_PREFILTERED

#include "shade/lobe.glsl"
#include "shade/surface_point.glsl"
#include "shared/prefilter.h"

// Level whose lobe has this slope, between two levels by the log. The map stands at level 0 for the narrowest
// lobe it can show; beyond the last level the lookup clamps.
float prefiltered_level(float roughness, float face_size) {
    float level = log2(roughness * face_size / PREFILTER_SLOPE);
    const float map_level = log2(PREFILTER_MAP_SLOPE / PREFILTER_SLOPE);
    return level >= 1.0 ? level : max((level - map_level) / (1.0 - map_level), 0.0);
}

// The map knows round lobes: a brushed one is taken for the round one of equal area. Points seen from behind
// are black.
vec3 look_up_prefiltered(LobeView v, SurfaceLobe lobe, vec2 albedo, float face_size) {
    LobeShape shape = shape_of(v);
    vec3 axis = v.frame * lobe_axis(shape, v.local_o);
    float level = prefiltered_level(lobe_filter_slope(shape), face_size);
    vec3 light = IS_WITHOUT_LOOKUPS ? axis + level : load_map(aim_at_map(axis, v.layer, level));
    vec3 reflectance = lobe.specular * albedo.x;
    if (HAS_FRESNEL) reflectance += lobe.grazing * albedo.y;
    return v.local_o.z > 0.0 ? light * reflectance * v.cos_o_power : vec3(0.0);
}

#endif
