// Adds one jittered picture to the mean: sum += weight * radiance, weight = 1 / spp. Of display output the
// last one leaves the mean in eight bits and not in the sum.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/display.glsl"
#include "shared/constants.h"
#include "shared/records.h"

layout(local_size_x = 64) in;
layout(constant_id = SPEC_IS_DISPLAY) const bool IS_DISPLAY = false;
layout(push_constant) uniform Push { AccumulateRecord push; };
layout(std430, binding = BINDING_ACCUMULATE_SAMPLE) readonly buffer Sample { vec4 radiance[]; };
layout(std430, binding = BINDING_ACCUMULATE_SUM) buffer Sum { vec4 sum[]; };
layout(std430, binding = BINDING_ACCUMULATE_DISPLAY) writeonly buffer Display { uint display_out[]; };

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
    if (index >= push.count) return;
    vec4 mean = (push.is_first != 0u ? vec4(0.0) : sum[index]) + push.weight * radiance[index];
    if (IS_DISPLAY)
        display_out[index] = display_pixel(mean, push.display_scale);
    else
        sum[index] = mean;
}
