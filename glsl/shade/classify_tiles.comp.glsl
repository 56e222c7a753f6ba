// Lists, for every shade class, the 8x8 tiles that hold one of its pixels; those that no direct light reaches
// in lists of their own, behind the others. One invocation is one tile: barriers and shared memory would cost
// a CPU device more than the loads.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lib/frame.glsl"
#include "shade/records.glsl"

layout(local_size_x = 64) in;
layout(constant_id = SPEC_CLASS_COUNT) const uint CLASS_COUNT = 1u;
layout(constant_id = SPEC_SHADE_CLASS) const uint BACKGROUND_CLASS =
    MAX_SHADE_CLASSES; // not below CLASS_COUNT: no background
layout(constant_id = SPEC_LISTS_LIGHTS) const bool LISTS_LIGHTS = false;
layout(constant_id = SPEC_TILE_LIST) const uint FIRST_DARK_LIST = 0u;

layout(push_constant) uniform Push { ShadeRecord push; };
layout(binding = BINDING_SURFACE, rg32ui) uniform readonly uimage2D surface_image;
layout(std430, binding = BINDING_TILES) writeonly buffer Tiles { uint tiles[]; };
layout(std430, binding = BINDING_LIGHT_LISTS) readonly buffer LightLists { uint light_lists[]; };
layout(std430, binding = BINDING_TILE_COUNTS) buffer TileCounts { uvec4 tile_counts[]; };

uint class_of(uvec2 surface) {
    if (!has_surface(surface)) return BACKGROUND_CLASS;
    return BACKGROUND_CLASS == 1u
               ? 0u
               : load_material(unpack_material(surface)).shade_class; // one class needs no look-up
}

void main() {
    ViewRecord view = load_view();
    uvec2 size = uvec2(view.width_px, view.height_px);
    uint tiles_per_row = (size.x + TILE_SIZE - 1u) / TILE_SIZE;
    uint index = gl_GlobalInvocationID.x;
    if (index >= push.tile_capacity) return;
    uvec2 tile = uvec2(index % tiles_per_row, index / tiles_per_row);
    uint classes_here = 0u;
    for (uint row = 0u; row < TILE_SIZE; ++row) {
        [[unroll]] for (uint column = 0u; column < TILE_SIZE; ++column) {
            uvec2 pixel = min(tile * TILE_SIZE + uvec2(column, row), size - 1u);
            uint shade_class = class_of(imageLoad(surface_image, ivec2(pixel)).xy);
            classes_here |= shade_class < CLASS_COUNT ? 1u << shade_class : 0u;
        }
    }
    bool is_dark = LISTS_LIGHTS && light_lists[LIGHT_LIST_WORDS * index] == 0u;
    for (uint shade_class = 0u; shade_class < CLASS_COUNT; ++shade_class) {
        if ((classes_here & (1u << shade_class)) == 0u) continue;
        uint list = shade_class + (is_dark && shade_class != BACKGROUND_CLASS ? FIRST_DARK_LIST : 0u);
        uint slot = atomicAdd(tile_counts[list].w, 1u);
        tiles[list * push.tile_capacity + slot] = tile.x | (tile.y << 16);
    }
}
