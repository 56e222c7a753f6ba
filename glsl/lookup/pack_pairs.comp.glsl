// Packs one level of a cube array into pairs of texels (shared/texel_pairs.h), bits as they are. One invocation makes one pair; z
// counts layers. Pairs that hold a texel of the border are made anew by a second dispatch: to find the neighbouring face costs more
// than all else, and a CPU device would do it for every pair.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/cube_map.glsl"
#include "shared/texel_pairs.h"

layout(local_size_x = 64) in;

layout(constant_id = SPEC_PACK_BORDER) const bool IS_BORDER = false;
layout(constant_id = SPEC_PACK_IS_STORED) const bool IS_STORED = false;

layout(push_constant) uniform Push { PackRecord record; };
// Half RGBA, in Vulkan's order and orientation.
layout(binding = BINDING_PACK_TEXELS, rg32ui) uniform readonly uimageBuffer texels;
layout(binding = BINDING_PACK_PAIRS, rgba32ui) uniform writeonly uimageBuffer pairs;
layout(std430, binding = BINDING_PACK_STORED_TEXELS) readonly buffer StoredTexels { uvec2 stored_texels[]; };
layout(std430, binding = BINDING_PACK_STORED_PAIRS) writeonly buffer StoredPairs { uvec4 stored_pairs[]; };

uvec2 load_texel(int index) {
    if (IS_STORED) return stored_texels[index];
    return imageLoad(texels, index).xy;
}

void store_pair(int index, uvec4 pair) {
    if (IS_STORED)
        stored_pairs[index] = pair;
    else
        imageStore(pairs, index, pair);
}

int texel_index(int layer, ivec2 place) {
    int size = int(record.size);
    return int(record.texel_begin) + (layer * size + place.y) * size + place.x;
}

// Place in Vulkan's orientation of a place in the orientation of the pairs.
ivec2 vulkan_place(int face, ivec2 place) {
    ivec2 turned = int(record.size) - 1 - place;
    return ivec2(face == 0 || face == 5 ? turned.x : place.x, face == 2 ? place.y : turned.y);
}

// Point of the cube at (u, v) of a face in the orientation of the pairs.
vec3 own_direction(int face, vec2 uv) {
    float side = (face & 1) == 0 ? 1.0 : -1.0;
    if (face < 2) return vec3(side, uv.y, uv.x);
    if (face < 4) return vec3(uv.x, side, uv.y);
    return vec3(uv, side);
}

int index_at(vec3 point, int cube) {
    vec2 uv;
    int face = int(cube_face_uv(point, uv));
    return texel_index(6 * cube + face, ivec2((uv + 1.0) * (0.5 * float(record.size))));
}

vec3 radiance_at(vec3 point, int cube) {
    uvec2 texel = load_texel(index_at(point, cube));
    return vec3(unpackHalf2x16(texel.x), unpackHalf2x16(texel.y).x);
}

// Texel (x, y) of a bordered face, counted from the border's corner, as halves: red and green, blue.
uvec2 bordered_texel(int cube, int face, int x, int y) {
    int size = int(record.size);
    ivec2 inside = clamp(ivec2(x, y) - 1, ivec2(0), ivec2(size - 1));
    int index = texel_index(6 * cube + face, vulkan_place(face, inside));
    bvec2 is_beyond = notEqual(inside, ivec2(x, y) - 1);
    if (!IS_BORDER || !any(is_beyond)) return load_texel(index);

    // Coordinates of texel centres are multiples of 1/size, a power of two: exact in floats.
    float texel = 1.0 / float(size);
    vec2 edge = clamp(vec2(2 * x - 1, 2 * y - 1) * texel - 1.0, -1.0, 1.0);
    vec3 axis = own_direction(face, vec2(0.0));
    if (!all(is_beyond)) return load_texel(index_at(own_direction(face, edge) - texel * axis, cube));
    vec3 along_x = own_direction(face, vec2(edge.x, 0.0)) - axis;
    vec3 along_y = own_direction(face, edge) - axis - along_x;
    vec3 corner = axis + along_x + along_y;
    vec3 mean = (radiance_at(corner - texel * (along_x + along_y), cube) + radiance_at(corner - texel * (axis + along_x), cube) +
                 radiance_at(corner - texel * (axis + along_y), cube)) / 3.0;
    return uvec2(packHalf2x16(mean.rg), packHalf2x16(vec2(mean.b, 0.0)));
}

// Pairs of the border: the row above, the row below, then left and right by turns.
ivec2 border_place(int index, int size) {
    int pitch = size + 1;
    if (index < 2 * pitch) return ivec2(index % pitch, index < pitch ? 0 : size + 1);
    index -= 2 * pitch;
    return ivec2((index & 1) == 0 ? 0 : size, 1 + (index >> 1));
}

void main() {
    int size = int(record.size), pitch = size + 1;
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (id.x >= (IS_BORDER ? 2 * pitch + 2 * size : pitch)) return;
    ivec2 place = IS_BORDER ? border_place(id.x, size) : id.xy;
    int x = place.x, y = place.y, layer = id.z;
    int cube = layer / 6, face = layer - 6 * cube;
    uvec2 left = bordered_texel(cube, face, x, y), right = bordered_texel(cube, face, x + 1, y);
    int begin = int(record.begin) + cube * int(record.cube_stride) + face * pitch * (pitch + 1);
    store_pair(begin + y * pitch + x,
               uvec4(left.x & 0xffffu | right.x << 16, left.x >> 16 | right.x & 0xffff0000u, left.y & 0xffffu | right.y << 16, 0u));
}
