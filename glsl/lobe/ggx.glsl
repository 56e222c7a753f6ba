// Trowbridge and Reitz' lobe (GGX) with height-correlated shadowing of Smith, in forms that stay exact in
// float32. Half-vectors and directions are in the local frame, z = normal. a = alpha along x and y.
#ifndef BURNISH_LOBE_GGX
#define BURNISH_LOBE_GGX

#include "lobe/interface.glsl"
#include "lobe/kurt.glsl"

// Slope of Kurt's lobe, by which prefiltered maps are made, that serves it best, over alpha.
const float GGX_FILTER_SLOPE = 1.1;

// D(h) = 1/(pi ax ay q^2): q from components, as (n.h)^2 (a^2 - 1) + 1 would cancel.
float ggx_d(vec3 h, vec2 a) {
    float x = h.x / a.x, y = h.y / a.y;
    float q = x * x + y * y + h.z * h.z;
    return 1.0 / (PI * a.x * a.y * q * q);
}

// a(v): Smith's G_1 is 2 v_z/(v_z + a(v)).
float projected_width(vec3 v, vec2 a) {
    vec2 xy = a * v.xy;
    return sqrt(v.z * v.z + dot(xy, xy));
}

// f cos_i/D without weight and Fresnel: cos_i/(2 (co a(i) + ci a(o))).
float ggx_rest(vec3 omega_i, vec3 omega_o, vec2 a) {
    float co = max(omega_o.z, MIN_COS);
    return 0.5 * omega_i.z / (co * projected_width(omega_i, a) + omega_i.z * projected_width(omega_o, a));
}

// The unit disc of normals that a view sees of a hemisphere that is stretched by alpha (Heitz 2018).
struct GgxDisc {
    vec3 view;     // stretched, unit
    vec2 level;    // unit, across the plane of view
    vec3 other;    // view x level
    float c, rest; // the disc is squeezed to c, rest = 1 - c
};

GgxDisc ggx_disc(vec3 omega_o, vec2 a) {
    GgxDisc disc;
    disc.view = normalize(vec3(a * omega_o.xy, omega_o.z));
    float sine = length(disc.view.xy);
    // Seen along the normal the disc is the same whichever way it is turned.
    disc.level = sine > 1e-7 ? vec2(-disc.view.y, disc.view.x) / sine : vec2(0.0, 1.0);
    disc.other = vec3(-disc.view.z * disc.level.y, disc.view.z * disc.level.x, sine > 1e-7 ? sine : 0.0);
    disc.c = 0.5 + 0.5 * disc.view.z;
    disc.rest = 0.5 * sine * sine / (1.0 + disc.view.z);
    return disc;
}

// The half-vector of a place of the lobe's plane, of density (1 + |p|^2)^-2/pi: the point p/(1 + |p|^2)^1/2
// of the disc, squeezed to what is seen.
struct GgxNormal {
    vec3 h;
    float q; // as in ggx_d
};

GgxNormal ggx_normal(vec3 omega_o, vec2 p, vec2 a) {
    GgxDisc disc = ggx_disc(omega_o, a);
    vec2 turned = vec2(dot(disc.level, p), disc.level.x * p.y - disc.level.y * p.x);
    float k = inversesqrt(1.0 + dot(p, p));
    float x = k * turned.x, y = k * turned.y;
    float edge = k * sqrt(1.0 + turned.y * turned.y); // of the disc: (1 - x^2)^1/2
    // (edge - y) (edge + y) = k^2: the smaller one from the larger.
    float larger = edge + abs(y), smaller = k * k / larger;
    float above = y > 0.0 ? smaller : larger, below = y > 0.0 ? larger : smaller;
    float squeezed = disc.rest * edge + disc.c * y;
    float z = sqrt(disc.c * above * (2.0 * disc.rest * edge + disc.c * below));
    vec3 m = x * vec3(disc.level, 0.0) + squeezed * disc.other + z * disc.view;
    vec3 g = vec3(a * m.xy, max(m.z, 1e-9));
    GgxNormal normal;
    normal.q = 1.0 / dot(g, g);
    normal.h = g * sqrt(normal.q);
    return normal;
}

// Derivative of the direction at the middle of the plane, whose half-vector is A (rest other + z view) but
// for its length, A = diag(ax, ay, 1): on the disc it moves by A level and c A (other - rest/z view).
mat2x3 ggx_linear_map(vec3 omega_o, vec2 a) {
    GgxDisc disc = ggx_disc(omega_o, a);
    vec3 squash = vec3(a, 1.0);
    float z = sqrt(1.0 - disc.rest * disc.rest); // c >= 1/2
    vec3 g = squash * (disc.rest * disc.other + z * disc.view);
    float scale = inversesqrt(dot(g, g));
    vec3 h = scale * g;
    vec3 first = scale * squash * vec3(disc.level, 0.0);
    vec3 second = scale * disc.c * squash * (disc.other - (disc.rest / z) * disc.view);
    first -= dot(h, first) * h;
    second -= dot(h, second) * h;
    float oh = dot(omega_o, h);
    first = 2.0 * (dot(omega_o, first) * h + oh * first);
    second = 2.0 * (dot(omega_o, second) * h + oh * second);
    return mat2x3(disc.level.x * first - disc.level.y * second, disc.level.y * first + disc.level.x * second);
}

// Half-vector of density D G_1(o) (o.h)/co, from x in the unit square.
vec3 sample_ggx(vec3 omega_o, vec2 x, vec2 a) {
    float share = min(x.x, 0.99999994);
    float azimuth = 2.0 * PI * (x.y - 0.5); // half a turn back: sin and cos are accurate in [-pi, pi]
    return ggx_normal(omega_o, -sqrt(share / (1.0 - share)) * vec2(cos(azimuth), sin(azimuth)), a).h;
}

// Density of the mirrored direction per solid angle.
float ggx_pdf(vec3 h, vec3 omega_o, vec2 a) {
    return ggx_d(h, a) / (2.0 * (max(omega_o.z, MIN_COS) + projected_width(omega_o, a)));
}

LobePoint ggx_at(vec3 omega_o, vec2 p, vec2 a) {
    GgxNormal normal = ggx_normal(omega_o, p, a);
    LobePoint point;
    point.cos_d = dot(omega_o, normal.h);
    point.omega_i = 2.0 * point.cos_d * normal.h - omega_o;
    float twice = 2.0 * (max(omega_o.z, MIN_COS) + projected_width(omega_o, a));
    point.base = point.omega_i.z > 0.0 ? twice * ggx_rest(point.omega_i, omega_o, a) : 0.0;
    float r = normal.q / (1.0 + dot(p, p));
    point.stretch = twice * a.x * a.y * r * r;
    return point;
}

// D cos_h^4 of a lobe that is wider by a light. The density is a mean of normal ones of variance a^2/(2 u)
// under exp(-u): those narrower than the light, u above some u0, become one of its variance and their own
// mean; the others remain, a little wider. In the tail next to nothing changes.
float ggx_widened_d(Widened w, vec2 a) {
    vec2 a2 = a * a;
    float share = max(0.25 * (w.wider.x / a2.x + w.wider.y / a2.y), 1e-6), u0 = 0.4 / share;
    float x = w.slope.x * w.slope.x / a2.x + w.slope.y * w.slope.y / a2.y;
    vec2 form = widened_form(w, a2, 1.5 / (1.0 + 3.0 * share + 0.3 * x));
    float y = u0 * (1.0 + x);
    float tail = (1.0 - (1.0 + y) * exp(-y)) / (sqrt(form.y) * (1.0 + form.x) * (1.0 + form.x));
    form = widened_form(w, a2 * log(1.0 + 1.0 / u0), 1.0);
    return (tail + exp(-u0 - form.x) / sqrt(form.y)) / PI;
}

#endif
