// Kernels ask this of a lobe, whichever model it is of: each is one file, and a line in every function.
// `model` is a constant of the pipeline, so that others cost nothing.
#ifndef BURNISH_LOBE_LOBE
#define BURNISH_LOBE_LOBE

#include "lobe/ggx.glsl"
#include "lobe/interface.glsl"
#include "lobe/kurt.glsl"
#include "shared/constants.h"

// All of a lobe that decides where it reflects light to.
struct LobeShape {
    uint model;  // MODEL_...
    vec2 width;  // along x and y
    float alpha; // of Kurt's
};

float lobe_d(LobeShape l, vec3 h) {
    if (l.model == MODEL_GGX) return ggx_d(h, l.width);
    return kurt_d(h, l.width);
}

// f cos_i/D without weight and Fresnel, for directions above the horizon. `grazing`: Kurt's powers of
// cosines.
float lobe_rest(LobeShape l, vec3 omega_i, vec3 omega_o, float cos_d, float grazing) {
    if (l.model == MODEL_GGX) return ggx_rest(omega_i, omega_o, l.width);
    return grazing / (4.0 * cos_d);
}

// A half-vector in proportion to the lobe, from x in the unit square; the mirrored direction has the density
// below.
vec3 lobe_sample(LobeShape l, vec3 omega_o, vec2 x) {
    if (l.model == MODEL_GGX) return sample_ggx(omega_o, x, l.width);
    return sample_kurt(x, l.width);
}

float lobe_pdf(LobeShape l, vec3 omega_o, vec3 h) {
    if (l.model == MODEL_GGX) return ggx_pdf(h, omega_o, l.width);
    return kurt_pdf(h, dot(omega_o, h), l.width);
}

// Half-vectors are the same for every view: patterns are slopes.
bool has_fixed_half_vectors(uint model) { return model == MODEL_KURT; }

// A place of the plane of the other models.
LobePoint lobe_at(LobeShape l, vec3 omega_o, vec2 p) { return ggx_at(omega_o, p, l.width); }

// Derivative of the direction at the middle of that plane, for steps along its axes.
mat2x3 lobe_linear_map(LobeShape l, vec3 omega_o) { return ggx_linear_map(omega_o, l.width); }

// D cos_h^4 under a light of some extent.
float lobe_widened_d(LobeShape l, Widened w) {
    if (l.model == MODEL_GGX) return ggx_widened_d(w, l.width);
    return kurt_widened_d(w, l.width);
}

// Slope of the lobe that a prefiltered map should show it by.
float lobe_filter_slope(LobeShape l) {
    float slope = sqrt(l.width.x * l.width.y);
    return l.model == MODEL_GGX ? GGX_FILTER_SLOPE * slope : slope;
}

#endif
