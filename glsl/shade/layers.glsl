// Layers: what a lobe reflects does not reach what lies below it.
#ifndef BURNISH_SHADE_LAYERS
#define BURNISH_SHADE_LAYERS

#include "shade/surface_point.glsl"

layout(constant_id = SPEC_HAS_LAYERS) const bool HAS_LAYERS = false;

// What a lobe lets through, from its albedo (E1, Es) at the view.
float lobe_through(LobeRecord record, SurfaceLobe lobe, vec2 albedo) {
    vec3 own = lobe.specular * albedo.x + lobe.grazing * albedo.y;
    float taken = record.cover.x < 0.0 ? max(max(own.r, own.g), own.b) : dot(record.cover.xy, albedo);
    return 1.0 - clamp(taken, 0.0, 1.0);
}

// Light of a point, from the lowest layer up.
struct Layers {
    vec3 light;
    float emission; // what of the surface's own comes out
};

void add_lobe(inout Layers layers, LobeRecord record, vec3 light, float through) {
    if (HAS_LAYERS) {
        layers.light *= through;
        layers.emission *= 1.0 - record.cover.z * (1.0 - through);
    }
    layers.light += light;
}

#endif
