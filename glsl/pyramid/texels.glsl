// Access to the bordered levels described in shared/pyramid.h.
#ifndef BURNISH_PYRAMID_TEXELS
#define BURNISH_PYRAMID_TEXELS

#include "shared/pyramid.h"

layout(constant_id = SPEC_PYRAMID_IS_STORED) const bool IS_STORED = false;

layout(binding = BINDING_PYRAMID_TEXELS, rgba32ui) uniform uimageBuffer texels;
layout(std430, binding = BINDING_PYRAMID_STORED_TEXELS) buffer StoredTexels { uvec4 stored_texels[]; };
layout(push_constant) uniform Push { PyramidRecord record; };

struct Level {
    int begin; // in pairs, as the pitch
    int pitch;
    int size; // texels along an edge
};

Level source_level() {
    return Level(int(record.source_begin), int(record.source_pitch), int(record.source_size));
}
Level target_level() {
    return Level(int(record.target_begin), int(record.target_pitch), int(record.source_size) / 2);
}

// The pair that holds texel (x, y) of a layer; x and y may lie in the border.
int pair_index(Level level, int layer, int x, int y) {
    int border = int(PYRAMID_BORDER);
    return level.begin + (layer * (level.size + 2 * border) + y + border) * level.pitch + ((x + border) >> 1);
}

uvec4 load_pair(int index) {
    if (IS_STORED) return stored_texels[index];
    return imageLoad(texels, index);
}

void store_pair(int index, uvec4 pair) {
    if (IS_STORED)
        stored_texels[index] = pair;
    else
        imageStore(texels, index, pair);
}

uvec2 load_texel(Level level, int layer, int x, int y) {
    uvec4 pair = load_pair(pair_index(level, layer, x, y));
    return (x & 1) == 0 ? pair.xy : pair.zw;
}

vec4 unpack_texel(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }
uvec2 pack_texel(vec4 texel) { return uvec2(packHalf2x16(texel.xy), packHalf2x16(texel.zw)); }

#endif
