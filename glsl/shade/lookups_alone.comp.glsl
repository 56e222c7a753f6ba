// For benchmarks: the lookups of one lobe without its shading. As many as the table has, spread about the mirror direction of a
// sphere's normal and at levels as the shade kernel has them, for two multiplications and additions each.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/frame.glsl"
#include "shared/constants.h"
#include "shared/records.h"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(constant_id = SPEC_SAMPLE_COUNT) const uint SAMPLE_COUNT = 1u;
#include "shade/sample_constants.glsl"

layout(push_constant) uniform Push { ShadeRecord push; }; // point_count: width
layout(binding = BINDING_MAPS) uniform samplerCubeArray maps;
layout(std430, binding = BINDING_RADIANCE) buffer Radiance { vec4 radiance_out[]; };

#define LOOK_UP(k)                                                                                                     \
    if (SAMPLE_COUNT > uint(k)) {                                                                                      \
        vec4 entry = SAMPLE_ENTRY(k);                                                                                  \
        vec3 direction = mirror + (2.0 * entry.x) * frame[0] + (2.0 * entry.y) * frame[1];                             \
        sum += entry.z * textureLod(maps, vec4(direction, 0.0), level + 0.5 * log2(entry.w)).rgb;                      \
    }
#define LOOK_UP_8(a, b, c, d, e, f, g, h) LOOK_UP(a) LOOK_UP(b) LOOK_UP(c) LOOK_UP(d) LOOK_UP(e) LOOK_UP(f) LOOK_UP(g) LOOK_UP(h)

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
    LOOK_UP_8(0, 1, 2, 3, 4, 5, 6, 7)
    LOOK_UP_8(8, 9, 10, 11, 12, 13, 14, 15)
    LOOK_UP_8(16, 17, 18, 19, 20, 21, 22, 23)
    LOOK_UP_8(24, 25, 26, 27, 28, 29, 30, 31)
    LOOK_UP_8(32, 33, 34, 35, 36, 37, 38, 39)
    LOOK_UP_8(40, 41, 42, 43, 44, 45, 46, 47)
    LOOK_UP_8(48, 49, 50, 51, 52, 53, 54, 55)
    LOOK_UP_8(56, 57, 58, 59, 60, 61, 62, 63)
    radiance_out[gl_GlobalInvocationID.y * push.point_count + gl_GlobalInvocationID.x] = vec4(sum, 1.0);
}
