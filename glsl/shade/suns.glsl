// Suns that were taken out of the map (cpp/burnish/light/sun_split.h), shaded directly.
#ifndef BURNISH_SHADE_SUNS
#define BURNISH_SHADE_SUNS

#include "lobe/lobe.glsl"
#include "shade/lobe.glsl"

layout(constant_id = SPEC_SUN_COUNT) const uint SUN_COUNT = 0u;
const float SUN_MOST_STEP = 0.1414214; // of sqrt(2) deviations

// A step of the half-vector changes its slope by this. No more of its change of h.z than a tenth counts: more
// would give a half-vector along the surface the slopes of all others.
vec2 slope_step(vec3 step, vec2 slope) {
    return step.xy - slope * clamp(step.z, -SUN_MOST_STEP, SUN_MOST_STEP);
}

// Flux times f cos_i of a lobe that is wider by a light of small extent, in the lobe's axes. A variance v of
// directions is v/4 of half-vectors in the plane of view and light, v/(4 (o.h)^2) across it: at grazing views
// much more.
vec3 shade_small_light(LobeView v, vec3 omega_i, float variance, vec3 flux, vec3 specular, vec3 grazing) {
    if (!has_half_vectors(v.model)) {
        float value = omega_i.z > 0.0 ? lobe_under_light(shape_of(v), omega_i, v.local_o, variance) : 0.0;
        return value * specular * flux;
    }
    vec3 h = omega_i + v.local_o;
    float length2 = dot(h, h);
    bool is_seen = omega_i.z > 0.0 && h.z > 1e-3 * sqrt(length2) && length2 > 1e-12;
    h = is_seen ? h * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
    float cos_d = max(dot(v.local_o, h), 1e-4);
    vec3 across = cross(v.local_o, h);
    // Toward the light any two directions will do.
    across = normalize(dot(across, across) > 1e-8 ? across : vec3(0.0, h.z, -h.y));
    vec3 along = cross(across, h);
    float scale = sqrt(0.5 * variance) / h.z;
    Widened w;
    w.slope = h.xy / h.z;
    vec2 s1 = slope_step(scale * along, w.slope), s2 = slope_step((scale / cos_d) * across, w.slope);
    w.wider = s1 * s1 + s2 * s2;
    w.off = s1.x * s1.y + s2.x * s2.y;
    w.turn = s1.x * s2.y - s1.y * s2.x;
    LobeShape shape = shape_of(v);
    float hz2 = h.z * h.z;
    float powers = cos_i_power(omega_i.z, v.alpha) * v.cos_o_power;
    float value =
        lobe_widened_d(shape, w) / (hz2 * hz2) * lobe_rest(shape, omega_i, v.local_o, cos_d, powers);
    vec3 fresnel = HAS_FRESNEL ? specular + grazing * schlick_weight(cos_d) : specular;
    return is_seen ? value * fresnel * flux : vec3(0.0);
}

vec3 shade_suns(LobeView v, MapRecord map, vec3 specular, vec3 grazing) {
    vec3 sum = vec3(0.0);
    [[unroll]] for (uint k = 0u; k < MAX_SUNS; ++k) {
        if (k < SUN_COUNT) {
            vec4 sun = map.suns[2u * k];
            vec3 flux = map.suns[2u * k + 1u].rgb;
            sum += shade_small_light(v, sun.xyz * v.frame, sun.w, flux, specular, grazing);
        }
    }
    return sum;
}

#endif
