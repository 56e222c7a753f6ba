// Vertices of materials that vary over a surface. What textures need is fetched here alone: on a CPU device
// it costs as much again as the rest of a vertex.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "surface/vertex.glsl"

layout(location = 2) in vec4 uv; // two sets
layout(location = 3) in vec4 color;

layout(location = 2) out vec4 uv_out;
layout(location = 3) out vec4 color_out;

void main() {
    place_vertex();
    uv_out = uv;
    color_out = color;
}
