// Textured materials without emission, coats and reflectances along the surface that are not 1.
#version 460
#extension GL_GOOGLE_include_directive : require

#define HAS_ALL_TARGETS 0
#include "surface/surface_varying.glsl"
