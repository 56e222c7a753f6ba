// Where a pixel's surface lies: in the world's axes, from the eye.
#ifndef BURNISH_SHADE_POSITION
#define BURNISH_SHADE_POSITION

#include "shade/records.glsl"

layout(binding = BINDING_DEPTH) uniform sampler2D depth_image;

// `depth`: reverse z, not 0.
vec3 pixel_position(mat4 world_from_picture, ivec2 pixel, float depth) {
    vec4 place = world_from_picture * vec4(vec2(pixel) + 0.5, depth, 1.0);
    return place.xyz / place.w;
}

#endif
