// For benchmarks: the lookups of one lobe without its shading. As many as the table has, spread about the
// mirror direction of a sphere's normal and at levels as the shade kernel has them, for two multiplications
// and additions each.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/frame.glsl"
#include "lookup/map_lookup.glsl"
#include "shared/records.h"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(constant_id = SPEC_SAMPLE_COUNT) const uint SAMPLE_COUNT = 1u;
#include "shade/lookups_alone_samples.glsl"

layout(push_constant) uniform Push { ShadeRecord push; }; // point_count: width
layout(std430, binding = BINDING_RADIANCE) buffer Radiance { vec4 radiance_out[]; };

#define AIM(k, aim)                                                                                          \
    if (SAMPLE_COUNT > uint(k)) {                                                                            \
        vec4 entry = SAMPLE_ENTRY(k);                                                                        \
        aim = aim_at_map(mirror + (2.0 * entry.x) * frame[0] + (2.0 * entry.y) * frame[1], 0.0,              \
                         level + 0.5 * log2(entry.w));                                                       \
    }
// clang-format off
#define LOAD(k, aim) if (SAMPLE_COUNT > uint(k)) sum += SAMPLE_ENTRY(k).z * load_map(aim);
#define LOOK_UP(a, b, c, d)                                                                                  \
    AIM(a, a0) AIM(b, a1) AIM(c, a2) AIM(d, a3) LOAD(a, a0) LOAD(b, a1) LOAD(c, a2) LOAD(d, a3)
// clang-format on

void main() {
    uvec2 size = gl_NumWorkGroups.xy * TILE_SIZE;
    vec2 p = (2.0 * vec2(gl_GlobalInvocationID.xy) + 1.0 - vec2(size)) / float(size.y) * 0.45;
    vec3 normal = vec3(p, sqrt(max(1.0 - dot(p, p), 0.0)));
    vec3 mirror = 2.0 * normal.z * normal - vec3(0.0, 0.0, 1.0);
    mat3 frame = longitude_frame(mirror);
    vec3 a = abs(mirror);
    float largest = max(max(a.x, a.y), a.z);
    float level = max(0.5 * log2(normal.z / (largest * largest * largest)), -8.0);
    vec3 sum = vec3(0.0);
    MapAim a0, a1, a2, a3;
    // clang-format off
    LOOK_UP(0, 1, 2, 3) LOOK_UP(4, 5, 6, 7)
    LOOK_UP(8, 9, 10, 11) LOOK_UP(12, 13, 14, 15)
    LOOK_UP(16, 17, 18, 19) LOOK_UP(20, 21, 22, 23)
    LOOK_UP(24, 25, 26, 27) LOOK_UP(28, 29, 30, 31)
    LOOK_UP(32, 33, 34, 35) LOOK_UP(36, 37, 38, 39)
    LOOK_UP(40, 41, 42, 43) LOOK_UP(44, 45, 46, 47)
    LOOK_UP(48, 49, 50, 51) LOOK_UP(52, 53, 54, 55)
    LOOK_UP(56, 57, 58, 59) LOOK_UP(60, 61, 62, 63)
    radiance_out[gl_GlobalInvocationID.y * push.point_count + gl_GlobalInvocationID.x] = vec4(sum, 1.0);
    // clang-format on
}
