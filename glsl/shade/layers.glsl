// Layers: what a lobe reflects does not reach what lies below it.
#ifndef BURNISH_SHADE_LAYERS
#define BURNISH_SHADE_LAYERS

#include "shade/albedo.glsl"
#include "shade/surface_point.glsl"

layout(constant_id = SPEC_HAS_LAYERS) const bool HAS_LAYERS = false;

// What a lobe of reflectance r0/f90 is multiplied by, e its albedo for F = 1: one that would gain energy
// keeps what it gets, 1/max(1, e); one whose facets lose some gets it back, 1 + r0/f90 (1/e - 1) (Turquin
// 2019).
vec3 energy_scale(LobeRecord record, vec3 reflectance, float e) {
    if (!CONSERVES_ENERGY || record.energy == ENERGY_AS_IT_IS) return vec3(1.0);
    if (record.energy == ENERGY_CONSERVED) return vec3(1.0 / max(1.0, e));
    return 1.0 + reflectance * (1.0 / clamp(e, 1e-3, 1.0) - 1.0);
}

vec3 reflectance_of(SurfaceLobe lobe) {
    return lobe.specular / max(lobe.specular + lobe.grazing, vec3(1e-20));
}

// What a lobe lets through, from its albedo (E1, Es) at the view and its scale.
float lobe_through(LobeRecord record, SurfaceLobe lobe, vec2 albedo, vec3 scale) {
    vec3 own = (lobe.specular * albedo.x + lobe.grazing * albedo.y) * scale;
    vec2 share = record.cover.xy;
    float fixed_share =
        dot(share, albedo) * energy_scale(record, vec3(share.x / max(share.x + share.y, 1e-20)), albedo.x).x;
    float taken = share.x < 0.0 ? max(max(own.r, own.g), own.b) : fixed_share;
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
