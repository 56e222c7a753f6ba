// Packs one level of a cube array into pairs of texels (shared/texel_pairs.h). One invocation makes one pair; z counts layers.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/cube_map.glsl"
#include "shared/texel_pairs.h"

layout(local_size_x = 64) in;

layout(push_constant) uniform Push { PackRecord record; };
layout(binding = BINDING_PACK_FACES) uniform sampler2DArray faces;
layout(binding = BINDING_PACK_PAIRS, rgba32ui) uniform writeonly uimageBuffer pairs;

// Point of the cube at (u, v) of a face in this buffer's orientation.
vec3 own_direction(int face, vec2 uv) {
    float side = (face & 1) == 0 ? 1.0 : -1.0;
    if (face < 2) return vec3(side, uv.y, uv.x);
    if (face < 4) return vec3(uv.x, side, uv.y);
    return vec3(uv, side);
}

vec3 load_at(vec3 point, int cube) {
    vec2 uv;
    int face = int(cube_face_uv(point, uv));
    ivec2 place = ivec2((uv + 1.0) * (0.5 * float(record.size)));
    return texelFetch(faces, ivec3(place, 6 * cube + face), int(record.level)).rgb;
}

// Texel (x, y) of a bordered face, counted from the border's corner. Coordinates of texel centres are multiples of 1/size, a
// power of two: exact in floats.
vec3 bordered_texel(int cube, int face, int x, int y) {
    vec2 at = vec2(2 * x - 1, 2 * y - 1) / float(record.size) - 1.0;
    float texel = 1.0 / float(record.size);
    vec2 inside = clamp(at, -1.0, 1.0);
    vec3 axis = own_direction(face, vec2(0.0));
    vec2 beyond = abs(at) - abs(inside);
    vec3 folded = own_direction(face, inside) - max(beyond.x, beyond.y) * axis;
    // Beyond two edges, three faces meet: each gives the texel in its corner. A loop of no rounds elsewhere: a CPU device skips it.
    int corner_rounds = beyond.x > 0.0 && beyond.y > 0.0 ? 1 : 0;
    vec3 result = load_at(folded, cube);
    for (int k = 0; k < corner_rounds; ++k) {
        vec3 corner = own_direction(face, inside);
        vec3 along_x = own_direction(face, vec2(inside.x, 0.0)) - axis;
        vec3 along_y = corner - axis - along_x;
        vec3 sum = load_at(corner - texel * (along_x + along_y), cube) + load_at(corner - texel * (axis + along_x), cube) +
                   load_at(corner - texel * (axis + along_y), cube);
        result = sum / 3.0;
    }
    return result;
}

void main() {
    int pitch = int(record.size) + 1;
    int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y), layer = int(gl_GlobalInvocationID.z);
    if (x >= pitch) return;
    int cube = layer / 6, face = layer - 6 * cube;
    vec3 left = bordered_texel(cube, face, x, y), right = bordered_texel(cube, face, x + 1, y);
    int begin = int(record.begin) + cube * int(record.cube_stride) + face * pitch * (pitch + 1);
    imageStore(pairs, begin + y * pitch + x,
               uvec4(packHalf2x16(vec2(left.r, right.r)), packHalf2x16(vec2(left.g, right.g)), packHalf2x16(vec2(left.b, right.b)), 0u));
}
