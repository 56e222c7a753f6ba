// Directional albedo of a lobe from its table (see AlbedoTable in cpp/burnish/sampling/albedo_table.h), without cos_o^-alpha.
#ifndef BURNISH_SHADE_ALBEDO
#define BURNISH_SHADE_ALBEDO

#include "lib/kurt_lobe.glsl"
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

// Tables of lobes whose roughness varies hold one row for each of ALBEDO_ROUGHNESS_NODES roughnesses, evenly in their log.
vec2 varying_albedo(uint begin, vec2 roughness, float cos_o) {
    float m = sqrt(roughness.x * roughness.y);
    float x = clamp(log2(m / ALBEDO_LEAST_ROUGHNESS) / -log2(ALBEDO_LEAST_ROUGHNESS), 0.0, 1.0) * float(ALBEDO_ROUGHNESS_NODES - 1u);
    float j = min(floor(x), float(ALBEDO_ROUGHNESS_NODES - 2u));
    uint row = begin + uint(j) * ALBEDO_COS_NODES;
    return mix(albedo_row(row, cos_o), albedo_row(row + ALBEDO_COS_NODES, cos_o), x - j);
}

// (E1, Es) at the view `local_o` of the lobe of `record`.
vec2 lobe_albedo(LobeRecord record, vec2 roughness, vec3 local_o) {
    if (HAS_VARYING) return varying_albedo(record.albedo_begin, roughness, local_o.z);
    return fixed_albedo(record.albedo_begin, record.albedo_width_nodes, local_o, roughness);
}

// What makes a lobe that would gain energy at this view keep what it gets: 1 / max(1, E1 cos_o^-alpha).
float conserving_scale(LobeRecord record, vec2 albedo, float cos_o_power) {
    return CONSERVES_ENERGY && record.conserves_energy != 0u ? 1.0 / max(1.0, albedo.x * cos_o_power) : 1.0;
}

#endif
