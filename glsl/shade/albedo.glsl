// Directional albedo of a lobe from its table, without cos_o^-alpha: see AlbedoTable in
// cpp/burnish/lobe/albedo_table.h.
#ifndef BURNISH_SHADE_ALBEDO
#define BURNISH_SHADE_ALBEDO

#include "shade/bindings.glsl"

layout(constant_id = SPEC_CONSERVES_ENERGY) const bool CONSERVES_ENERGY = false;
layout(binding = BINDING_ALBEDO_TABLE, rgba32f) uniform readonly imageBuffer albedo_table;

// (E1, Es) at the lobe's view: see AlbedoTable.
vec2 albedo_row(uint begin, float cos_o) {
    float x = sqrt(clamp(cos_o, 0.0, 1.0)) * float(ALBEDO_COS_NODES - 1u);
    float i = min(floor(x), float(ALBEDO_COS_NODES - 2u));
    float share = x - i;
    // Of a narrow lobe E1 is cos_o^(1-alpha): linear in cos_o, x squared, for alpha 0, and in x for alpha .5.
    if (ALPHA == ALPHA_ZERO) share *= (x + i) / (2.0 * i + 1.0);
    vec4 nodes = imageLoad(albedo_table, int(begin) + int(i)); // this and the next
    return mix(nodes.xy, nodes.zw, share);
}

vec2 fixed_albedo(uint begin, uint width_nodes, vec3 local_o, vec2 roughness) {
    if (!HAS_TANGENT || width_nodes == 1u) return albedo_row(begin, local_o.z);
    vec2 along = local_o.xy * roughness;
    float width = sqrt(dot(along, along) / max(dot(local_o.xy, local_o.xy), 1e-30));
    float least = min(roughness.x, roughness.y);
    float share = (width - least) / max(max(roughness.x, roughness.y) - least, 1e-20);
    float x = sqrt(clamp(share, 0.0, 1.0)) * float(width_nodes - 1u);
    float j = min(floor(x), float(width_nodes - 2u));
    uint row = begin + uint(j) * ALBEDO_COS_NODES;
    return mix(albedo_row(row, local_o.z), albedo_row(row + ALBEDO_COS_NODES, local_o.z), x - j);
}

// What lies at `x`, in 0..1, of `nodes` nodes: y, the node below it, and z, the share of the next.
vec3 between_nodes(float x, uint nodes) {
    float at = clamp(x, 0.0, 1.0) * float(nodes - 1u);
    float node = min(floor(at), float(nodes - 2u));
    return vec3(at, node, at - node);
}

// VaryingAlbedoTable of a round lobe.
vec2 varying_albedo(uint begin, float roughness, float cos_o) {
    vec3 m = between_nodes(sqrt(roughness), ALBEDO_ROUGHNESS_NODES);
    uint row = begin + uint(m.y) * ALBEDO_COS_NODES;
    return mix(albedo_row(row, cos_o), albedo_row(row + ALBEDO_COS_NODES, cos_o), m.z);
}

// Of a brushed one: with slopes of covariance C/2 in the plane of view and across it, by sqrt(C_xx),
// sqrt(C_yy) and C_xy^2/(C_xx C_yy).
vec2 brushed_albedo(uint begin, vec2 roughness, vec3 local_o) {
    float sine2 = dot(local_o.xy, local_o.xy);
    vec2 e = sine2 > 1e-12 ? local_o.xy * inversesqrt(sine2) : vec2(1.0, 0.0);
    vec2 m2 = roughness * roughness;
    float along2 = dot(e * e, m2), across2 = dot(e * e, m2.yx);
    vec3 along = between_nodes(sqrt(sqrt(along2)), ALBEDO_ALONG_NODES);
    vec3 across = between_nodes(sqrt(sqrt(across2)), ALBEDO_ACROSS_NODES);
    vec3 correlation = between_nodes(1.0 - m2.x * m2.y / (along2 * across2), ALBEDO_CORRELATION_NODES);
    vec3 cosine = between_nodes(sqrt(max(local_o.z, 0.0)), ALBEDO_BRUSHED_COS_NODES);
    const int step_across = int(ALBEDO_BRUSHED_COS_NODES * ALBEDO_CORRELATION_NODES);
    const int step_along = step_across * int(ALBEDO_ACROSS_NODES);
    int node = int(begin) + int(along.y) * step_along + int(across.y) * step_across +
               int(correlation.y) * int(ALBEDO_BRUSHED_COS_NODES) + int(cosine.y);
    vec4 sum = vec4(0.0);
    [[unroll]] for (int k = 0; k < 8; ++k) {
        float share = ((k & 1) != 0 ? along.z : 1.0 - along.z) * ((k & 2) != 0 ? across.z : 1.0 - across.z) *
                      ((k & 4) != 0 ? correlation.z : 1.0 - correlation.z);
        sum += share * imageLoad(albedo_table, node + (k & 1) * step_along + (k >> 1 & 1) * step_across +
                                                   (k >> 2) * int(ALBEDO_BRUSHED_COS_NODES));
    }
    return mix(sum.xy, sum.zw, cosine.z);
}

// (E1, Es) at the view `local_o` of the lobe of `record`.
vec2 lobe_albedo(LobeRecord record, vec2 roughness, vec3 local_o) {
    if (HAS_VARYING && HAS_FIXED_LOBE && record.albedo_width_nodes == 0u)
        return albedo_row(record.albedo_begin, local_o.z);
    if (HAS_VARYING && HAS_TANGENT && record.albedo_width_nodes > 1u)
        return brushed_albedo(record.albedo_begin, roughness, local_o);
    if (HAS_VARYING) return varying_albedo(record.albedo_begin, roughness.x, local_o.z);
    return fixed_albedo(record.albedo_begin, record.albedo_width_nodes, local_o, roughness);
}

#endif
