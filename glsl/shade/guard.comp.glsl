// Blackens and counts what is not finite in a picture or among points. Dispatched by the sign that other kernels leave: not at all
// where all is finite.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "shade/guard.glsl"

void main() {
    uint group = gl_WorkGroupID.z * gl_NumWorkGroups.y + gl_WorkGroupID.y;
    uint index = group * (TILE_SIZE * TILE_SIZE) + gl_LocalInvocationIndex;
    if (index >= push.point_count) return;
    vec4 radiance = radiance_out[index];
    radiance_out[index] = vec4(stop_non_finite(radiance.rgb, index, shaded_by(radiance.a)), radiance.a);
}
