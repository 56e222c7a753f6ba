// Light on a diffuse surface: irradiance / pi at its normal, in environment space, without the map's
// exposure.
#ifndef BURNISH_SHADE_DIFFUSE
#define BURNISH_SHADE_DIFFUSE

#include "lib/spherical_harmonics.glsl"
#include "lookup/map_lookup.glsl"
#include "shade/bindings.glsl"

layout(constant_id = SPEC_HAS_HARMONICS) const bool HAS_HARMONICS = false;
layout(constant_id = SPEC_IRRADIANCE_IS_STORED) const bool IRRADIANCE_IS_STORED = false;
layout(binding = BINDING_IRRADIANCE, rgba32f) uniform readonly imageBuffer irradiance_cubes;
layout(std430, binding = BINDING_STORED_IRRADIANCE) readonly buffer StoredIrradiance {
    vec4 stored_irradiance[];
};

vec3 irradiance_texel(int index) {
    if (IRRADIANCE_IS_STORED) return stored_irradiance[index].rgb;
    return imageLoad(irradiance_cubes, index).rgb;
}

// One seamless bilinear lookup in the cube of a map, whose faces have a border
// (cpp/burnish/light/irradiance_cube.h). It is in float32 on every device, so no light is too dim or too
// bright for it, and takes fewer rows than nine harmonics.
vec3 look_up_irradiance(vec3 n, uint map_index) {
    const int pitch = int(IRRADIANCE_PITCH);
    const float half_size = 0.5 * float(IRRADIANCE_FACE);
    CubePlace cube = place_on_cube(n);
    vec2 place = cube.uv * half_size + (half_size + 0.5); // texel k lies at k + 1, behind the border
    ivec2 texel = ivec2(place);
    vec2 fraction = place - vec2(texel);
    int at = int(map_index) * int(IRRADIANCE_TEXELS) + (int(cube.face) * pitch + texel.y) * pitch + texel.x;
    vec3 above = mix(irradiance_texel(at), irradiance_texel(at + 1), fraction.x);
    vec3 below = mix(irradiance_texel(at + pitch), irradiance_texel(at + pitch + 1), fraction.x);
    return max(mix(above, below, fraction.y), vec3(0.0));
}

vec3 diffuse_light(MapRecord map, uint map_index, vec3 n) {
    if (HAS_HARMONICS) return irradiance_over_pi(map.irradiance, n);
    return look_up_irradiance(n, map_index) * map.env_from_world_y.w; // in the unit of the map's halves
}

#endif
