// Suns that were taken out of the map (cpp/burnish/sampling/sun_split.h), shaded directly.
#ifndef BURNISH_SHADE_SUNS
#define BURNISH_SHADE_SUNS

#include "lib/kurt_lobe.glsl"
#include "shade/lobe.glsl"

layout(constant_id = SPEC_SUN_COUNT) const uint SUN_COUNT = 0u;

// Flux times f cos_i of a lobe that is wider by the sun: a variance v of directions is v/(4 o.h) of half-vectors and v/(4 (o.h) hz^3)
// of their slopes, geometric means of two axes each; the lobe's slopes have m^2/2.
vec3 shade_sun(LobeView v, vec4 sun, vec3 flux, vec3 specular, vec3 grazing) {
    vec3 omega_i = sun.xyz * v.frame;
    vec3 h = omega_i + v.local_o;
    float length2 = dot(h, h);
    bool is_seen = omega_i.z > 0.0 && h.z > 1e-3 * sqrt(length2) && length2 > 1e-12;
    h = is_seen ? h * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
    float cos_d = max(dot(v.local_o, h), 1e-4);
    vec2 wider = sqrt(v.roughness * v.roughness + sun.w / (2.0 * cos_d * h.z * h.z * h.z));
    float value = kurt_d(h, wider) / (4.0 * cos_d) * cos_i_power(omega_i.z, v.alpha) * v.cos_o_power;
    vec3 fresnel = HAS_FRESNEL ? specular + grazing * schlick_weight(cos_d) : specular;
    return is_seen ? value * fresnel * flux : vec3(0.0);
}

vec3 shade_suns(LobeView v, MapRecord map, vec3 specular, vec3 grazing) {
    vec3 sum = vec3(0.0);
    [[unroll]] for (uint k = 0u; k < MAX_SUNS; ++k)
        if (k < SUN_COUNT) sum += shade_sun(v, map.suns[2u * k], map.suns[2u * k + 1u].rgb, specular, grazing);
    return sum;
}

#endif
