// Access to the bordered levels described in shared/pyramid.h.
#ifndef BURNISH_PYRAMID_TEXELS
#define BURNISH_PYRAMID_TEXELS

#include "shared/pyramid.h"

layout(binding = BINDING_PYRAMID_TEXELS, rgba32ui) uniform uimageBuffer texels;
layout(push_constant) uniform Push { PyramidRecord record; };

// Pairs in a row of a face with `size` texels along its edge.
int row_pairs(int size) { return (size + 2 * int(PYRAMID_BORDER) + 1) / 2; }

// The pair that holds texel (x, y) of a layer; x and y may lie in the border.
int pair_index(int begin, int size, int layer, int x, int y) {
    int border = int(PYRAMID_BORDER);
    return begin + (layer * (size + 2 * border) + y + border) * row_pairs(size) + ((x + border) >> 1);
}

uvec2 load_texel(int begin, int size, int layer, int x, int y) {
    uvec4 pair = imageLoad(texels, pair_index(begin, size, layer, x, y));
    return (x & 1) == 0 ? pair.xy : pair.zw;
}

vec4 unpack_texel(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }
uvec2 pack_texel(vec4 texel) { return uvec2(packHalf2x16(texel.xy), packHalf2x16(texel.zw)); }

#endif
