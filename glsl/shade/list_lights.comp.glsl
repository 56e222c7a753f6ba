// Lists, for every tile of the picture or group of points, the lights that may reach it: those whose reach
// meets the sphere around what is drawn there; how many, then which. Of more than fit only the number is
// right. One invocation is one of them, as in classify_tiles.comp.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "light/direct_light.glsl"
#include "shared/constants.h"
#include "shade/position.glsl"

const float FLOAT_MAX = 3.4028235e38;

layout(local_size_x = 64) in;
layout(constant_id = SPEC_SOURCE) const uint SOURCE = SOURCE_PIXELS;

layout(push_constant) uniform Push { ShadeRecord push; };
layout(std430, binding = BINDING_POINTS) readonly buffer Points { SurfacePoint points[]; };
layout(std430, binding = BINDING_LIGHT_LISTS) writeonly buffer LightLists { uint light_lists[]; };

struct Sphere {
    vec3 center;
    float radius; // < 0: nothing is there
};

Sphere sphere_around(vec3 low, vec3 high) {
    if (low.x > high.x) return Sphere(vec3(0.0), -1.0);
    return Sphere(0.5 * (low + high), 0.5 * length(high - low));
}

Sphere group_sphere(uint index) {
    vec3 low = vec3(FLOAT_MAX), high = vec3(-FLOAT_MAX);
    uint begin = index * TILE_SIZE * TILE_SIZE, end = min(begin + TILE_SIZE * TILE_SIZE, push.point_count);
    for (uint k = begin; k < end; ++k) {
        low = min(low, points[k].position.xyz);
        high = max(high, points[k].position.xyz);
    }
    return sphere_around(low, high);
}

Sphere tile_sphere(uint index) {
    ViewRecord view = load_view();
    mat4 world_from_picture = load_world_from_picture();
    uvec2 size = uvec2(view.width_px, view.height_px);
    uint tiles_per_row = (size.x + TILE_SIZE - 1u) / TILE_SIZE;
    uvec2 tile = uvec2(index % tiles_per_row, index / tiles_per_row);
    vec3 low = vec3(FLOAT_MAX), high = vec3(-FLOAT_MAX);
    for (uint row = 0u; row < TILE_SIZE; ++row) {
        [[unroll]] for (uint column = 0u; column < TILE_SIZE; ++column) {
            uvec2 pixel = min(tile * TILE_SIZE + uvec2(column, row), size - 1u);
            float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
            if (depth > 0.0) {
                vec3 place = pixel_position(world_from_picture, ivec2(pixel), depth);
                low = min(low, place);
                high = max(high, place);
            }
        }
    }
    return sphere_around(low, high);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= push.tile_capacity) return;
    Sphere sphere = SOURCE == SOURCE_POINTS ? group_sphere(index) : tile_sphere(index);
    uint begin = LIGHT_LIST_WORDS * index, count = 0u;
    for (uint k = 0u; k < push.light_count; ++k) {
        if (sphere.radius < 0.0 || !may_arrive(load_light(k), sphere.center, sphere.radius)) continue;
        ++count;
        if (count < LIGHT_LIST_WORDS) light_lists[begin + count] = k;
    }
    light_lists[begin] = count;
}
