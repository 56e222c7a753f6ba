// Tells a CPU device which of the two lookups its driver does faster (cpp/burnish/render/lookup_probe.h).
// Four lookups about the mirror direction of a sphere's normal, at levels as the shade kernels have them:
// few, for what is written out takes long to compile.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/frame.glsl"
#include "lookup/map_lookup.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(std430, binding = BINDING_RADIANCE) buffer Radiance { vec4 radiance_out[]; };

void main() {
    uvec2 size = gl_NumWorkGroups.xy * TILE_SIZE;
    vec2 p = (2.0 * vec2(gl_GlobalInvocationID.xy) + 1.0 - vec2(size)) / float(size.y) * 0.45;
    vec3 normal = vec3(p, sqrt(max(1.0 - dot(p, p), 0.0)));
    vec3 mirror = 2.0 * normal.z * normal - vec3(0.0, 0.0, 1.0);
    mat3 frame = longitude_frame(mirror);
    vec3 a = abs(mirror);
    float largest = max(max(a.x, a.y), a.z);
    float level = 1.0 + 0.5 * log2(normal.z / (largest * largest * largest));
    vec3 x = 0.1 * frame[0], y = 0.1 * frame[1];
    MapAim a0 = aim_at_map(mirror + x + y, 0.0, level);
    MapAim a1 = aim_at_map(mirror - x + y, 0.0, level + 0.3);
    MapAim a2 = aim_at_map(mirror + x - y, 0.0, level + 0.6);
    MapAim a3 = aim_at_map(mirror - x - y, 0.0, level + 0.9);
    vec3 sum = 0.25 * load_map(a0) + 0.25 * load_map(a1) + 0.25 * load_map(a2) + 0.25 * load_map(a3);
    radiance_out[gl_GlobalInvocationID.y * size.x + gl_GlobalInvocationID.x] = vec4(sum, 1.0);
}
