// One level of a prefiltered map (shared/prefilter.h) by lookups of the map's pyramid, L(n) = sum w_k L(i_k) / sum w_k:
// a lobe's by filtered importance sampling, w = cos_i / cos_h, half-vectors of density D cos_h, seen along the normal, o = n;
// a Gaussian's by a mixture of the matched sampler.
// One invocation makes one texel; z counts faces.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lib/cube_map.glsl"
#include "lib/footprint.glsl"
#include "lib/frame.glsl"
#include "lookup/map_lookup.glsl"
#include "shared/prefilter.h"

layout(local_size_x = 64) in;

layout(constant_id = SPEC_PREFILTER_IS_SPHERICAL) const bool IS_SPHERICAL = false;

layout(push_constant) uniform Push { PrefilterRecord record; };
// See build_prefilter_table and build_spherical_table in cpp/burnish/sampling/prefilter_table.h.
layout(std430, binding = BINDING_PREFILTER_SAMPLES) readonly buffer Samples { vec4 samples[]; };
// Half RGBA.
layout(std430, binding = BINDING_PREFILTER_TEXELS) writeonly buffer Texels { uvec2 texels[]; };

struct Lookup {
    MapAim aim;
    float weight;
};

// In slope form, as in shade/lobe.glsl: with g = n + sx t + sy b and c = 1/|g|^2, i = 2 c g - n and cos_i = 2 c - 1.
Lookup place_lookup(mat3 frame, vec4 entry) {
    float c = 1.0 / (1.0 + dot(entry.xy, entry.xy));
    CubePlace place = place_on_cube((2.0 * c - 1.0) * frame[2] + (2.0 * c) * (entry.x * frame[0] + entry.y * frame[1]));
    float level;
    Lookup lookup;
    if (IS_SPHERICAL) {
        // A lookup of width sigma in (u, v) is r^-2 sigma by r^-1 sigma wide on the sphere: 2/(r^-4 + r^-2), r the inverse of
        // the direction's largest component.
        float x = 1.0 / (place.inverse_largest * place.inverse_largest);
        level = mip_level(2.0 * entry.w / (x * (x + 1.0)));
        lookup.weight = entry.z;
    } else {
        level = mip_level(texels_exact(entry.w, 1.0, place.inverse_largest));
        lookup.weight = entry.z * max(2.0 * c - 1.0, 0.0);
    }
    lookup.aim = aim_at_map(place, float(record.cube), level);
    return lookup;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    uint face = gl_GlobalInvocationID.z;
    uint size = record.size;
    if (index >= size * size) return;
    vec2 uv = (2.0 * vec2(index % size, index / size) + 1.0) / float(size) - 1.0;
    mat3 frame = orthonormal_basis(normalize(cube_direction(face, uv.x, uv.y)));

    vec3 sum = vec3(0.0);
    float weight = 0.0;
    uint end = record.sample_begin + record.sample_count;
    for (uint k = record.sample_begin; k < end; k += PREFILTER_PHASE) {
        Lookup lookups[PREFILTER_PHASE];
        [[unroll]] for (uint j = 0u; j < PREFILTER_PHASE; ++j) lookups[j] = place_lookup(frame, samples[k + j]);
        [[unroll]] for (uint j = 0u; j < PREFILTER_PHASE; ++j) {
            sum += lookups[j].weight * load_map(lookups[j].aim);
            weight += lookups[j].weight;
        }
    }
    sum /= weight;
    texels[record.texel_begin + face * size * size + index] = uvec2(packHalf2x16(sum.rg), packHalf2x16(vec2(sum.b, 1.0)));
}
