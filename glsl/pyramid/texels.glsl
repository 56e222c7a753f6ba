// Access to the bordered levels described in shared/pyramid.h.
#ifndef BURNISH_PYRAMID_TEXELS
#define BURNISH_PYRAMID_TEXELS

#include "shared/pyramid.h"

layout(binding = BINDING_PYRAMID_TEXELS, rgba32ui) uniform uimageBuffer texels;
layout(push_constant) uniform Push { PyramidRecord record; };

struct Level {
    int begin; // in pairs, as the pitch
    int pitch;
    int size; // texels along an edge
};

Level source_level() { return Level(int(record.source_begin), int(record.source_pitch), int(record.source_size)); }
Level target_level() { return Level(int(record.target_begin), int(record.target_pitch), int(record.source_size) / 2); }

// The pair that holds texel (x, y) of a layer; x and y may lie in the border.
int pair_index(Level level, int layer, int x, int y) {
    int border = int(PYRAMID_BORDER);
    return level.begin + (layer * (level.size + 2 * border) + y + border) * level.pitch + ((x + border) >> 1);
}

uvec2 load_texel(Level level, int layer, int x, int y) {
    uvec4 pair = imageLoad(texels, pair_index(level, layer, x, y));
    return (x & 1) == 0 ? pair.xy : pair.zw;
}

vec4 unpack_texel(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }
uvec2 pack_texel(vec4 texel) { return uvec2(packHalf2x16(texel.xy), packHalf2x16(texel.zw)); }

#endif
