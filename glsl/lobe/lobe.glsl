// Kernels ask this of a lobe, whichever model it is of: each is one file, and a line in every function.
// `model` is a constant of the pipeline, so that others cost nothing.
#ifndef BURNISH_LOBE_LOBE
#define BURNISH_LOBE_LOBE

#include "lobe/ggx.glsl"
#include "lobe/interface.glsl"
#include "lobe/kurt.glsl"
#include "lobe/lafortune.glsl"
#include "lobe/sheen.glsl"
#include "shared/constants.h"

// All of a lobe that decides where it reflects light to.
struct LobeShape {
    uint model;  // MODEL_...
    vec2 width;  // along x and y, as slopes of half-vectors
    float alpha; // of Kurt's
    vec4 own;    // of models that have more: see their files
};

// Half-vectors say all of it: those of a lobe have a density D.
bool has_half_vectors(uint model) { return model == MODEL_KURT || model == MODEL_GGX; }

// They are the same for every view: patterns are slopes.
bool has_fixed_half_vectors(uint model) { return model == MODEL_KURT; }

// The density of its plane is Student's.
bool has_tail(uint model) { return model == MODEL_GGX; }

// D, of models with half-vectors.
float lobe_d(LobeShape l, vec3 h) {
    if (l.model == MODEL_GGX) return ggx_d(h, l.width);
    return kurt_d(h, l.width);
}

// f cos_i/D without weight and Fresnel, for directions above the horizon, of such models. `grazing`: Kurt's
// powers of cosines.
float lobe_rest(LobeShape l, vec3 omega_i, vec3 omega_o, float cos_d, float grazing) {
    if (l.model == MODEL_GGX) return ggx_rest(omega_i, omega_o, l.width);
    return grazing / (4.0 * cos_d);
}

// f cos_i without weight and Fresnel, for directions above the horizon, `h` half-way.
float lobe_value(LobeShape l, vec3 omega_i, vec3 omega_o, vec3 h) {
    if (l.model == MODEL_LAFORTUNE) return lafortune_value(omega_i, omega_o, l.own);
    if (l.model == MODEL_SHEEN) return omega_i.z * sheen_brdf(omega_i, omega_o, h, l.own.x);
    if (h.z <= 0.0) return 0.0;
    float grazing = grazing_term(omega_i.z, omega_o.z, l.alpha);
    return lobe_d(l, h) * lobe_rest(l, omega_i, omega_o, max(dot(omega_o, h), 1e-20), grazing);
}

// A place of the plane of models without fixed half-vectors.
LobePoint lobe_at(LobeShape l, vec3 omega_o, vec2 p) {
    if (l.model == MODEL_LAFORTUNE) return lafortune_at(omega_o, p, l.own);
    if (l.model == MODEL_SHEEN) return sheen_at(omega_o, p, l.own.x);
    return ggx_at(omega_o, p, l.width);
}

// Derivative of the direction at the middle of that plane, for steps along its axes.
mat2x3 lobe_linear_map(LobeShape l, vec3 omega_o) {
    if (l.model == MODEL_LAFORTUNE) return lafortune_linear_map(omega_o, l.own);
    if (l.model == MODEL_SHEEN) return mat2x3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    return ggx_linear_map(omega_o, l.width);
}

struct LobeDraw {
    vec3 omega_i; // unit; may lie below the horizon
    vec3 h;       // half-way between view and direction, as good as it was drawn
};

// A direction in proportion to the lobe, from x in the unit square; it has the density below.
LobeDraw lobe_draw(LobeShape l, vec3 omega_o, vec2 x) {
    LobeDraw drawn;
    if (has_half_vectors(l.model)) {
        drawn.h = l.model == MODEL_GGX ? sample_ggx(omega_o, x, l.width) : sample_kurt(x, l.width);
        drawn.omega_i = 2.0 * dot(omega_o, drawn.h) * drawn.h - omega_o;
        return drawn;
    }
    // The plane has the density exp(-r^2)/pi.
    float azimuth = 2.0 * PI * (x.y - 0.5);
    float radius = sqrt(max(-log(clamp(x.x, 5.9604645e-8, 1.0)), 0.0));
    drawn.omega_i = lobe_at(l, omega_o, radius * vec2(cos(azimuth), sin(azimuth))).omega_i;
    vec3 h = drawn.omega_i + omega_o;
    drawn.h = h * inversesqrt(max(dot(h, h), 1e-20));
    return drawn;
}

// Density per solid angle of a direction that is drawn, `h` half-way.
float lobe_pdf(LobeShape l, vec3 omega_i, vec3 omega_o, vec3 h) {
    if (l.model == MODEL_LAFORTUNE) return lafortune_pdf(omega_i, omega_o, l.own);
    if (l.model == MODEL_SHEEN) return max(omega_i.z, 0.0) / PI;
    if (l.model == MODEL_GGX) return ggx_pdf(h, omega_o, l.width);
    return kurt_pdf(h, dot(omega_o, h), l.width);
}

// D cos_h^4 under a light of some extent, of models with half-vectors.
float lobe_widened_d(LobeShape l, Widened w) {
    if (l.model == MODEL_GGX) return ggx_widened_d(w, l.width);
    return kurt_widened_d(w, l.width);
}

// f cos_i under a light whose directions have a variance per axis, of the other models. Sheen is wider than
// any.
float lobe_under_light(LobeShape l, vec3 omega_i, vec3 omega_o, float variance) {
    if (l.model == MODEL_LAFORTUNE) return lafortune_under_light(omega_i, omega_o, l.own, variance);
    return omega_i.z * sheen_brdf(omega_i, omega_o, sheen_half_vector(omega_i, omega_o), l.own.x);
}

// The direction that a prefiltered map is read in.
vec3 lobe_axis(LobeShape l, vec3 omega_o) {
    if (l.model == MODEL_LAFORTUNE) return power_lobe(omega_o, l.own).axis;
    if (l.model == MODEL_SHEEN) return vec3(0.0, 0.0, 1.0);
    return vec3(-omega_o.xy, omega_o.z);
}

// Slope of the lobe that a prefiltered map should show it by.
float lobe_filter_slope(LobeShape l) {
    float slope = sqrt(l.width.x * l.width.y);
    return l.model == MODEL_GGX ? GGX_FILTER_SLOPE * slope : slope;
}

// Widths that albedo tables of a fixed lobe go by: the albedo depends on the azimuth as a width does.
vec2 lobe_albedo_width(LobeShape l) { return l.model == MODEL_LAFORTUNE ? abs(l.own.xy) : l.width; }

// Such a table leaves this out, as it changes too fast from node to node.
float lobe_albedo_gain(LobeShape l, vec3 omega_o) {
    return l.model == MODEL_LAFORTUNE ? power_lobe(omega_o, l.own).gain : 1.0;
}

#endif
