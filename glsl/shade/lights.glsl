// Direct lights at a point: lobes are as wide as the light makes them, as under suns.
#ifndef BURNISH_SHADE_LIGHTS
#define BURNISH_SHADE_LIGHTS

#include "light/direct_light.glsl"
#include "shade/surface_point.glsl"

layout(constant_id = SPEC_LISTS_LIGHTS) const bool LISTS_LIGHTS = false;
layout(std430, binding = BINDING_LIGHT_LISTS) readonly buffer LightLists { uint light_lists[]; };

// Indices of lights that may reach a point: those of a list, or all. Loops over them end with their
// condition: a CPU driver runs the body once more, masked, where it comes first (measured: as dear as a
// light).
struct LightRange {
    uint begin; // of the list; it has an entry that says how many follow
    uint count;
    bool is_listed;
};

LightRange lights_of(PointToShade point) {
    LightRange range = LightRange(LIGHT_LIST_WORDS * point.group, push.light_count, false);
    if (!LISTS_LIGHTS) return range;
    uint count = light_lists[range.begin];
    range.is_listed = count < LIGHT_LIST_WORDS;
    if (range.is_listed) range.count = count;
    return range;
}

// The one of that number; what arrives is nothing where there is none.
ArrivingLight light_of(LightRange range, uint k, vec3 position) {
    uint index = LISTS_LIGHTS && range.is_listed ? light_lists[range.begin + 1u + k] : k;
    bool is_there = k < range.count;
    ArrivingLight light = arriving_light(load_light(is_there ? index : 0u), position);
    if (!is_there) light.irradiance = vec3(0.0);
    return light;
}

// What a diffuse reflectance is multiplied by.
vec3 diffuse_lights(PointToShade point) {
    vec3 sum = vec3(0.0);
    LightRange range = lights_of(point);
    uint k = 0u;
    do {
        ArrivingLight light = light_of(range, k, point.position);
        sum += light.irradiance * lit_cosine(dot(light.omega_i, point.frame[2]), light.sine2);
    } while (++k < range.count);
    return sum / PI;
}

#endif
