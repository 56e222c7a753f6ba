// Vertices of materials that are the same everywhere.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "surface/vertex.glsl"

void main() { place_vertex(); }
