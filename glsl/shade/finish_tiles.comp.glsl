// Turns the tile counts of all lists into indirect dispatches: rows as few as they can be, of equal length,
// so that next to no group lies past the end of its list.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/constants.h"

layout(local_size_x = 2u * MAX_SHADE_CLASSES) in;
layout(constant_id = SPEC_TILE_LIST) const uint LIST_COUNT = 1u;
layout(std430, binding = BINDING_TILE_COUNTS) buffer TileCounts { uvec4 tile_counts[]; };

void main() {
    uint list = gl_LocalInvocationIndex;
    if (list >= LIST_COUNT) return;
    uint count = tile_counts[list].w;
    uint rows = max((count + GROUPS_PER_ROW - 1u) / GROUPS_PER_ROW, 1u);
    tile_counts[list].xyz = uvec3((count + rows - 1u) / rows, rows, 1u);
}
