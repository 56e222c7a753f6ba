// Lists, for every shade class, the 8x8 tiles that hold one of its pixels. One group is one tile.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/frame.glsl"
#include "shared/constants.h"
#include "shared/records.h"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(constant_id = SPEC_CLASS_COUNT) const uint CLASS_COUNT = 1u;
layout(constant_id = SPEC_SHADE_CLASS) const uint BACKGROUND_CLASS = MAX_SHADE_CLASSES; // not below CLASS_COUNT: no background

layout(push_constant) uniform Push { ShadeRecord push; };
layout(std430, binding = BINDING_VIEW) readonly buffer Views { ViewRecord view; };
layout(std430, binding = BINDING_MATERIALS) readonly buffer Materials { MaterialRecord materials[]; };
layout(binding = BINDING_SURFACE, rg32ui) uniform readonly uimage2D surface_image;
layout(std430, binding = BINDING_TILES) writeonly buffer Tiles { uint tiles[]; };
layout(std430, binding = BINDING_TILE_COUNTS) buffer TileCounts { uvec4 tile_counts[]; };

shared uint classes_here;

void main() {
    if (gl_LocalInvocationIndex == 0u) classes_here = 0u;
    barrier();
    uvec2 pixel = gl_WorkGroupID.xy * TILE_SIZE + gl_LocalInvocationID.xy;
    if (pixel.x < view.width_px && pixel.y < view.height_px) {
        uvec2 surface = imageLoad(surface_image, ivec2(pixel)).xy;
        uint shade_class = has_surface(surface) ? materials[unpack_material(surface)].shade_class : BACKGROUND_CLASS;
        if (shade_class < CLASS_COUNT) atomicOr(classes_here, 1u << shade_class);
    }
    barrier();
    uint shade_class = gl_LocalInvocationIndex;
    if (shade_class < CLASS_COUNT && (classes_here & (1u << shade_class)) != 0u) {
        uint slot = atomicAdd(tile_counts[shade_class].w, 1u);
        tiles[shade_class * push.tile_capacity + slot] = gl_WorkGroupID.x | (gl_WorkGroupID.y << 16);
    }
}
