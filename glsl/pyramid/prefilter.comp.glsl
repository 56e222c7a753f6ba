// One level of a prefiltered map (shared/prefilter.h) by lookups of the map's pyramid, L(n) = sum w_k L(i_k)
// / sum w_k: a lobe's by filtered importance sampling, w = cos_i / cos_h, half-vectors of density D cos_h,
// seen along the normal, o = n; a Gaussian's by a mixture of the matched sampler. One invocation makes one
// texel; z counts faces.
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
// See build_prefilter_table and build_spherical_table in cpp/burnish/sampler/prefilter_table.h.
layout(binding = BINDING_PREFILTER_SAMPLES, rgba32f) uniform readonly imageBuffer samples;
// Half RGBA.
layout(std430, binding = BINDING_PREFILTER_TEXELS) writeonly buffer Texels { uvec2 texels[]; };

struct Lookup {
    MapAim aim;
    float weight;
};

Lookup place_lookup(vec3 direction, float cos_i, vec4 entry) {
    CubePlace place = place_on_cube(direction);
    float level;
    Lookup lookup;
    if (IS_SPHERICAL) {
        // A lookup of width sigma in (u, v) is r^-2 sigma by r^-1 sigma wide on the sphere: 2/(r^-4 + r^-2),
        // r the inverse of the direction's largest component.
        float x = 1.0 / (place.inverse_largest * place.inverse_largest);
        level = mip_level(2.0 * entry.w / (x * (x + 1.0)));
        lookup.weight = entry.z;
    } else {
        level = mip_level(texels_exact(entry.w, 1.0, place.inverse_largest));
        lookup.weight = entry.z * max(cos_i, 0.0);
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
    float weight = IS_SPHERICAL ? 1.0 : 0.0; // a mixture's weights sum to one
    uint end = record.sample_begin + record.sample_count;
    const uint lookups_of_entry = IS_SPHERICAL ? 2u : 1u;
    // A loop: written out, all 24 lookups of a Gaussian take 1.5 times as long on lavapipe.
    for (uint k = record.sample_begin; k < end; k += PREFILTER_PHASE / lookups_of_entry) {
        Lookup lookups[PREFILTER_PHASE];
        [[unroll]] for (uint j = 0u; j < PREFILTER_PHASE; j += lookups_of_entry) {
            // In slope form, as in shade/lobe.glsl: with g = n + sx t + sy b and c = 1/|g|^2, i = 2 c g - n
            // and cos_i = 2 c - 1.
            vec4 entry = imageLoad(samples, int(k + j / lookups_of_entry));
            float c = 1.0 / (1.0 + dot(entry.xy, entry.xy));
            float cos_i = 2.0 * c - 1.0;
            vec3 along = cos_i * frame[2], aside = (2.0 * c) * (entry.x * frame[0] + entry.y * frame[1]);
            lookups[j] = place_lookup(along + aside, cos_i, entry);
            if (IS_SPHERICAL) lookups[j + 1u] = place_lookup(along - aside, cos_i, entry);
        }
        [[unroll]] for (uint j = 0u; j < PREFILTER_PHASE; ++j) {
            sum += lookups[j].weight * load_map(lookups[j].aim);
            if (!IS_SPHERICAL) weight += lookups[j].weight;
        }
    }
    sum /= weight;
    texels[record.texel_begin + face * size * size + index] =
        uvec2(packHalf2x16(sum.rg), packHalf2x16(vec2(sum.b, 1.0)));
}
