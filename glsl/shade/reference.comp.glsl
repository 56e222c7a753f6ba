// The truth a frame is judged by, one batch per dispatch. Two methods:
//   quadrature:  L = sum over level-0 texels of L_t f(i_t) cos_i solid angle_t;
//   progressive: multiple importance sampling (balance heuristic) of lobe and map, level-0 lookups, a new random shift each
//                batch, so that batches are independent and their spread gives the standard error.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lib/cube_map.glsl"
#include "lib/kurt_lobe.glsl"
#include "lib/random.glsl"
#include "lib/spherical_harmonics.glsl"
#include "shade/albedo.glsl"
#include "lookup/map_lookup.glsl"
#include "shade/surface_point.glsl"

layout(constant_id = SPEC_IS_QUADRATURE) const bool IS_QUADRATURE = false;

layout(std430, binding = BINDING_TEXEL_ALIAS) readonly buffer Alias { TexelAlias texel_alias[]; };
// Per point: rgb: sum of the batches' means; a: sum of the squares of their luminances.
layout(std430, binding = BINDING_STATISTICS) buffer Statistics { vec4 statistics[]; };

struct LobeView {
    mat3 frame; // environment space
    vec3 local_o;
    SurfaceLobe lobe;
    float alpha;
    float layer;
};

// f cos_i, with Fresnel and weight, for a local direction and the half-vector between.
vec3 lobe_value(LobeView v, vec3 local_i, vec3 h) {
    if (local_i.z <= 0.0 || h.z <= 0.0) return vec3(0.0);
    float cos_d = max(dot(v.local_o, h), 1e-20);
    float value = kurt_d(h, v.lobe.roughness) * grazing_term(local_i.z, v.local_o.z, v.alpha) / (4.0 * cos_d);
    return value * (v.lobe.specular + v.lobe.grazing * schlick_weight(cos_d));
}

vec3 half_vector(vec3 a, vec3 b) {
    vec3 h = a + b;
    return h * inversesqrt(max(dot(h, h), 1e-20));
}

vec3 quadrature(LobeView v, uint face_size) {
    vec3 sum = vec3(0.0);
    uint face_texels = face_size * face_size;
    for (uint texel = push.texel_begin; texel < min(push.texel_end, 6u * face_texels); ++texel) {
        uint in_face = texel % face_texels;
        vec2 uv = (2.0 * vec2(in_face % face_size, in_face / face_size) + 1.0) / float(face_size) - 1.0;
        vec3 w = cube_direction(texel / face_texels, uv.x, uv.y);
        vec3 local_i = normalize(w) * v.frame;
        vec3 value = lobe_value(v, local_i, half_vector(local_i, v.local_o));
        sum += value * texel_solid_angle(float(face_texels), w) * look_up_finest(w, v.layer);
    }
    return sum;
}

// Density of `draw_texel` per solid angle in direction w.
float texel_pdf(vec3 w, MapRecord map) {
    uint face_size = map.face_size;
    vec2 uv;
    uint face = cube_face_uv(w, uv);
    uvec2 texel = min(uvec2(max((uv * 0.5 + 0.5) * float(face_size), vec2(0.0))), uvec2(face_size - 1u));
    float face_texels = float(face_size * face_size);
    return texel_alias[map.alias_begin + (face * face_size + texel.y) * face_size + texel.x].probability / texel_solid_angle(face_texels, w);
}

// A direction in proportion to the map's light: a texel by its alias table, a place in it at random. The texel comes from 32
// bits: a large map has six million, which 24 bits would draw unevenly.
vec3 draw_texel(uint index, uint seed, MapRecord map) {
    uint face_size = map.face_size;
    uint texel, fraction;
    umulExtended(recurrence_3d_x(index, seed), 6u * face_size * face_size, texel, fraction);
    TexelAlias drawn = texel_alias[map.alias_begin + texel];
    if (unit_from_uint(hash_uint(fraction)) >= drawn.threshold) texel = drawn.alias;
    vec2 place = recurrence_3d(index, seed).yz;
    uint in_face = texel % (face_size * face_size);
    vec2 uv = 2.0 * (vec2(in_face % face_size, in_face / face_size) + place) / float(face_size) - 1.0;
    return normalize(cube_direction(texel / (face_size * face_size), uv.x, uv.y));
}

vec3 weigh(LobeView v, vec3 direction, vec3 local_i, vec3 h, MapRecord map) {
    vec3 value = lobe_value(v, local_i, h);
    float pdf = kurt_pdf(h, dot(v.local_o, h), v.lobe.roughness) + texel_pdf(direction, map);
    return value * look_up_finest(direction, v.layer) / max(pdf, 1e-20);
}

vec3 progressive(LobeView v, MapRecord map, uint seed) {
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < push.batch_size; ++k) {
        vec3 h = sample_kurt(recurrence_2d(k, seed), v.lobe.roughness);
        vec3 local_i = 2.0 * dot(v.local_o, h) * h - v.local_o;
        vec3 term = vec3(0.0);
        if (dot(v.local_o, h) > 0.0 && local_i.z > 0.0) term = weigh(v, v.frame * local_i, local_i, h, map);
        vec3 direction = draw_texel(k, seed, map);
        local_i = direction * v.frame;
        if (local_i.z > 0.0) term += weigh(v, direction, local_i, half_vector(local_i, v.local_o), map);
        sum += term;
    }
    return sum / float(push.batch_size);
}

void main() {
    PointToShade point = load_point();
    MaterialRecord material = load_material(point.material);
    MapRecord map = load_map_record(material.map);

    vec3 batch = vec3(0.0);
    for (uint which = 0u; which < LOBE_COUNT; ++which) {
        LobeRecord record = load_lobe(material.lobe_begin + which);
        LobeView v;
        v.lobe = point_lobe(point, material.lobe_begin + which, which);
        mat3 frame = lobe_frame(point_frame(point, which), record);
        v.local_o = point.omega_o * frame;
        v.frame = environment_from_world(map, frame);
        v.alpha = record.alpha;
        v.layer = float(map.layer);
        uint seed = hash_uint(point.index * 4u + which) ^ hash_uint(push.batch + 0x51633e2du);
        vec3 light = IS_QUADRATURE ? quadrature(v, map.face_size) : progressive(v, map, seed);
        if (CONSERVES_ENERGY) {
            vec2 albedo = lobe_albedo(record, v.lobe.roughness, v.local_o);
            light *= conserving_scale(record, albedo, pow(max(v.local_o.z, MIN_COS), -v.alpha));
        }
        batch += light;
    }
    if (!point.is_mine) return;
    batch = stop_non_finite(batch, point.index, GUARD_REFERENCE);
    vec4 sum = push.batch == 0u ? vec4(0.0) : statistics[point.index];
    float luminance = dot(batch, vec3(0.2126, 0.7152, 0.0722));
    sum += vec4(batch, luminance * luminance);
    statistics[point.index] = sum;

    // Quadrature batches are parts of one sum, progressive ones are estimates of it.
    vec3 radiance = IS_QUADRATURE ? sum.rgb : sum.rgb / float(push.batch + 1u);
    if (HAS_DIFFUSE)
        radiance += point_diffuse(point) * irradiance_over_pi(map.irradiance, environment_from_world(map, point.frame[2]));
    radiance *= map.radiance_scale;
    if (HAS_EMISSIVE) radiance += point_emissive(point);
    store_radiance(point, stop_non_finite(radiance, point.index, GUARD_REFERENCE), 1.0);
}
