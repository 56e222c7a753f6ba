// Kernels ask this of a lobe, whichever model it is of: each is one file, and a line in every function. `model` is a constant
// of the pipeline, so that others cost nothing.
#ifndef BURNISH_LOBE_LOBE
#define BURNISH_LOBE_LOBE

#include "lobe/interface.glsl"
#include "lobe/kurt.glsl"
#include "shared/constants.h"

// All of a lobe that decides where it reflects light to.
struct LobeShape {
    uint model; // MODEL_...
    vec2 width; // along x and y
    float alpha; // of Kurt's
};

float lobe_d(LobeShape l, vec3 h) {
    return kurt_d(h, l.width);
}

// f cos_i/D without weight and Fresnel, for directions above the horizon. `grazing`: Kurt's powers of cosines.
float lobe_rest(LobeShape l, vec3 omega_i, vec3 omega_o, float cos_d, float grazing) {
    return grazing / (4.0 * cos_d);
}

// A half-vector in proportion to the lobe, from x in the unit square; the mirrored direction has the density below.
vec3 lobe_sample(LobeShape l, vec3 omega_o, vec2 x) {
    return sample_kurt(x, l.width);
}

float lobe_pdf(LobeShape l, vec3 omega_o, vec3 h) {
    return kurt_pdf(h, dot(omega_o, h), l.width);
}

// D cos_h^4 under a light of some extent.
float lobe_widened_d(LobeShape l, Widened w) {
    return kurt_widened_d(w, l.width);
}

// Slope of the lobe that a prefiltered map should show it by.
float lobe_filter_slope(LobeShape l) {
    return sqrt(l.width.x * l.width.y);
}

#endif
