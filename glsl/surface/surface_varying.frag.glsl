// Textured materials, with all targets.
#version 460
#extension GL_GOOGLE_include_directive : require

#define HAS_ALL_TARGETS 1
#include "surface/surface_varying.glsl"
