// Adds one jittered picture to the mean: sum += weight * radiance, weight = 1 / spp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/constants.h"
#include "shared/records.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { AccumulateRecord push; };
layout(std430, binding = BINDING_ACCUMULATE_SAMPLE) readonly buffer Sample { vec4 radiance[]; };
layout(std430, binding = BINDING_ACCUMULATE_SUM) buffer Sum { vec4 sum[]; };

void main() {
    uint index = gl_GlobalInvocationID.y * GROUPS_PER_ROW * 64u + gl_GlobalInvocationID.x;
    if (index >= push.count) return;
    vec4 before = push.is_first != 0u ? vec4(0.0) : sum[index];
    sum[index] = before + push.weight * radiance[index];
}
