// Radiance of one lobe by the variance-matched sampler (maths: section 6): the lobe as a mixture of Gaussians
// whose widths are those of the lookups, so that centres and lookups together have the lobe's covariance. The
// map's levels are round on the sphere (shared/prefilter.h): where lookups go and how wide they are depends
// on the lobe and the view in its frame alone.
#ifndef BURNISH_SHADE_MATCHED
#define BURNISH_SHADE_MATCHED

#include "shade/lobe.glsl"

layout(constant_id = SPEC_WIDE_COMPONENTS) const bool HAS_WIDE_COMPONENTS = false;

// A mixture's place at one point. A slope y1 axis1 + y2 axis2 (y in units of the lobe's principal axes on the
// map) is
//   g = n + y1 g1 + y2 g2,  og = o.g = o.n + y1 o1 + y2 o2.
struct MixtureView {
    vec3 g1, g2;       // environment space
    float inverse_rho; // a component of width s has a deviation of s/rho in y1, of s in y2
    float o1, o2;
    // One deviation of a component of s = 1: h along the direction in which cos_i changes most, p across it
    // (o.p = 0).
    vec3 h, p;
    float oh, h2, p2; // o.h, |h|^2, |p|^2
    float linear;     // variance_share b^2/c: a component's variance over s^2 (o.h) cos_h^3
    float share;      // of level 1's variance, for a variance of 1: see spherical_level
    int row;          // its first entry in the table
    vec2 fresnel;     // F = x + y (1 - o.h)^5 over all channels: weighs directions within a component
};

struct LobeAxes {
    vec2 v1, v2; // unit circle of slopes to principal axes on the map: columns of V
    float rho, minor, foreshortening;
};

// The plane of view in the frame of the lobe: o_xy/|o_xy|, and |o_xy| as z. Along the normal any plane will
// do.
vec3 view_plane(vec3 local_o) {
    float sine = length(local_o.xy);
    return vec3(sine > 1e-6 ? local_o.xy / sine : vec2(1.0, 0.0), sine);
}

// Widths of the mirrored lobe on the sphere: L maps slopes in units of roughness to offsets from the mirror
// direction, along T1 in the plane of view and T2 across it,
//   L = 2 [ex mx, ey my; -ey mx c, ex my c],  e = o_xy/|o_xy|,  c^2 = max(o_z, .03)^2 + (ox mx)^2 + (oy
//   my)^2.
// V diagonalises L^T L; the singular values multiply to 4 mx my c.
LobeAxes lobe_axes(vec3 local_o, vec2 roughness) {
    vec2 e = view_plane(local_o).xy;
    vec2 along = local_o.xy * roughness;
    float floored = max(local_o.z, 0.03);
    float c2 = floored * floored + dot(along, along);
    LobeAxes axes;
    axes.foreshortening = sqrt(c2);
    vec2 e2 = e * e;
    float p = 4.0 * roughness.x * roughness.x * (e2.x + e2.y * c2);
    float s = 4.0 * roughness.y * roughness.y * (e2.y + e2.x * c2);
    float off = 4.0 * roughness.x * roughness.y * e.x * e.y * (1.0 - c2);
    float half_difference = 0.5 * (p - s);
    float radius = sqrt(half_difference * half_difference + off * off);
    float major2 = 0.5 * (p + s) + radius;
    float product = 4.0 * roughness.x * roughness.y * axes.foreshortening;
    axes.rho = max(major2 / product, 1.0);
    axes.minor = product * inversesqrt(major2);
    // Half the angle whose cosine is half_difference/radius, from its larger part: no cancellation.
    bool is_round = radius <= 1e-7 * major2;
    float cosine = is_round ? 1.0 : half_difference / radius;
    float larger = sqrt(0.5 + 0.5 * abs(cosine));
    float smaller = is_round ? 0.0 : 0.5 * off / (radius * larger);
    axes.v1 = cosine >= 0.0 ? vec2(larger, smaller) : vec2(abs(smaller), off < 0.0 ? -larger : larger);
    axes.v2 = vec2(-axes.v1.y, axes.v1.x);
    return axes;
}

// Of the linear map's variance, what a component has.
float variance_share(vec2 roughness, float rho) {
    const float less = MATCHED_NARROW_LESS - MATCHED_NARROW_LESS_OF_ONE / float(SAMPLE_COUNT);
    return MATCHED_VARIANCE_SHARE *
           (1.0 - less * exp(-MATCHED_NARROW_DECAY * roughness.x * roughness.y) / rho);
}

// F = x + y (1 - o.h)^5 over all channels. Where nothing is reflected, some direction must still come out.
vec2 grey_fresnel(vec3 specular, vec3 grazing) {
    vec2 fresnel = vec2(dot(specular, vec3(1.0)), dot(grazing, vec3(1.0)));
    fresnel.x = max(fresnel.x, 1e-3 * fresnel.y);
    return fresnel.x > 1e-9 ? fresnel / (fresnel.x + fresnel.y) : vec2(1.0, 0.0);
}

// The row of a lobe's aspect.
int mixture_row(float rho) {
    float node = log2(rho) * (float(MATCHED_ROWS - 1u) / MATCHED_LOG2_LARGEST_RHO) + 0.5;
    return int((SAMPLE_COUNT + 1u) / 2u) *
           int(node < float(MATCHED_ROWS - 1u) ? node : float(MATCHED_ROWS - 1u));
}

MixtureView view_mixture(LobeView v, uint table_begin, float level_share, vec3 specular, vec3 grazing) {
    LobeAxes axes = lobe_axes(v.local_o, v.roughness);

    MixtureView view;
    vec2 slope1 = v.roughness * axes.v1, slope2 = v.roughness * axes.v2;
    view.g1 = slope1.x * v.frame[0] + slope1.y * v.frame[1];
    view.g2 = slope2.x * v.frame[0] + slope2.y * v.frame[1];
    view.o1 = dot(slope1, v.local_o.xy);
    view.o2 = dot(slope2, v.local_o.xy);
    view.inverse_rho = 1.0 / axes.rho;
    vec2 slope = vec2(view.o1 * view.inverse_rho, view.o2);
    float steepness = length(slope);
    vec2 u = steepness > 1e-7 ? slope / steepness : vec2(0.0, 1.0);
    view.h = (u.x * view.inverse_rho) * view.g1 + u.y * view.g2;
    view.p = (-u.y * view.inverse_rho) * view.g1 + u.x * view.g2;
    view.oh = dot(u, slope);
    view.p2 = dot(view.p, view.p);
    view.linear = variance_share(v.roughness, axes.rho) * axes.minor * axes.minor / axes.foreshortening;
    view.h2 = dot(view.h, view.h);
    view.share = level_share;
    view.row = int(table_begin) + mixture_row(axes.rho);
    view.fresnel = grey_fresnel(specular, grazing);
    return view;
}

// cos_i^(1-alpha), a trace of it below the horizon: a component that lies there has a direction and next to
// no weight.
float lit_power(float cos_i, float alpha) {
    const float trace = 1e-8;
    if (ALPHA == ALPHA_ZERO) return cos_i > trace ? cos_i : trace;
    if (ALPHA == ALPHA_HALF) return sqrt(cos_i > trace * trace ? cos_i : trace * trace);
    return cos_i > 0.0 ? pow(cos_i, 1.0 - alpha) + trace : trace;
}

// Means of a component over its points: what it reflects, and the direction in which.
struct Component {
    float base;     // sum of w, w = cos_i^(1-alpha)/cos_h times a point's share
    float schlick;  // sum of w (1 - o.h)^5
    float gain;     // sum of F w
    vec3 direction; // sum of F w omega_i, environment space
};

// Level at which a lookup has a variance, given as a share of level 1's: 4^l grows with the level, but level
// 0 is not filtered, and below level 1 the mix of both has that share of level 1.
float spherical_level(float share) { return share > 1.0 ? 1.0 + 0.5 * log2(share) : share; }

// `share` is the linear map's, see spherical_level. Half of the spread of what the points reflect, 1 - |M|/G,
// is the least: it is more where the centre reflects the horizon.
// `level_share`: what a variance of 1 is.
Lookup finish_component(LobeView v, float level_share, Component component, float weight, float share) {
    Lookup lookup;
    float spread = 1.0 - length(component.direction) / component.gain;
    share = max(share, MATCHED_LEAST_SPREAD_SHARE * level_share * spread);
    lookup.aim = aim_at_map(component.direction, v.layer, spherical_level(share));
    lookup.weight = weight * component.base;
    lookup.schlick = HAS_FRESNEL ? component.schlick / component.base : 0.0;
    lookup.density = 0.0;
    return lookup;
}

// What two components at +y and -y of width s share.
struct Pair {
    vec3 d; // y1 g1 + y2 g2
    float s;
    float weight;
    vec2 lengths, inverse; // |g| at the points n + d + s h and n + d - s h, and |g|^-2
    float bend;            // what the curvature across h leaves of q
    float deviation;       // o.(s h)
    float variance;
};

// A narrow component by two points, one deviation to either side of its centre along the direction in which
// cos_i changes most: exact to second order in the product of weight and direction. The reflection bends
// across that direction as well: on average q is shorter there by s^2 |p|^2.
Lookup place_narrow(LobeView v, MixtureView view, Pair pair, vec3 d, float og, vec2 lengths, vec2 inverse) {
    vec2 products = vec2(og + pair.deviation, og - pair.deviation);
    vec2 q = (2.0 * pair.bend) * products * inverse;
    vec2 share = vec2(lit_power(q.x - v.local_o.z, v.alpha), lit_power(q.y - v.local_o.z, v.alpha)) * lengths;
    Component component;
    component.base = share.x + share.y;
    component.schlick = 0.0;
    if (HAS_FRESNEL) {
        vec2 cos_d = products * inverse * lengths;
        vec2 schlick = vec2(schlick_weight(cos_d.x), schlick_weight(cos_d.y));
        component.schlick = dot(share, schlick);
        share *= view.fresnel.x + view.fresnel.y * schlick;
    }
    component.gain = share.x + share.y;
    vec2 along = share * q;
    component.direction = (along.x + along.y) * (v.frame[2] + d) + (pair.s * (along.x - along.y)) * view.h -
                          component.gain * v.omega_o;
    return finish_component(v, view.share, component, pair.weight, pair.variance * og);
}

void add_point(LobeView v, MixtureView view, vec3 offset, float share, inout Component component) {
    vec3 g = v.frame[2] + offset;
    float og = dot(g, v.omega_o);
    float length2 = dot(g, g);
    float root = inversesqrt(length2);
    float q = 2.0 * og * root * root;
    float weight = share * lit_power(q - v.local_o.z, v.alpha) * (length2 * root);
    component.base += weight;
    if (HAS_FRESNEL) {
        float schlick = schlick_weight(og * root);
        component.schlick += weight * schlick;
        weight *= view.fresnel.x + view.fresnel.y * schlick;
    }
    component.gain += weight;
    component.direction += weight * (q * g - v.omega_o);
}

// A wide component by its centre and four corners at sqrt(1.2) deviations: exact to the third degree, and of
// the rules of up to nine points the one that errs least on wide lobes. Its variance is -ln(|M|/G).
Lookup place_wide(LobeView v, MixtureView view, Pair pair, vec3 d, float og) {
    vec3 along = (1.0954451 * pair.s * view.inverse_rho) * view.g1, across = (1.0954451 * pair.s) * view.g2;
    Component component = Component(0.0, 0.0, 0.0, vec3(0.0));
    add_point(v, view, d, 4.0 / 24.0, component);
    add_point(v, view, d - across - along, 5.0 / 24.0, component);
    add_point(v, view, d + across - along, 5.0 / 24.0, component);
    add_point(v, view, d - across + along, 5.0 / 24.0, component);
    add_point(v, view, d + across + along, 5.0 / 24.0, component);
    return finish_component(v, view.share, component, pair.weight, pair.variance * og);
}

void place_pair(LobeView v, MixtureView view, vec4 entry, out Lookup one, out Lookup other) {
    Pair pair;
    pair.d = entry.x * view.g1 + entry.y * view.g2;
    pair.s = entry.z;
    pair.weight = entry.w;
    float s2 = pair.s * pair.s;
    float middle = 1.0 + dot(pair.d, pair.d) + s2 * view.h2;
    float skew = 2.0 * pair.s * dot(pair.d, view.h);
    vec2 length2 = vec2(middle + skew, middle - skew); // swapped, those of n - d +- s h
    vec2 inverse_length = inversesqrt(length2);
    pair.lengths = length2 * inverse_length;
    pair.inverse = inverse_length * inverse_length;
    pair.deviation = pair.s * view.oh;
    // (s b)^2 (o.h) cos_h^3/c, the variance of the linear map, with the lengths at both points; og is left to
    // each.
    pair.variance = s2 * view.share * view.linear * (pair.inverse.x * pair.inverse.y);
    float od = entry.x * view.o1 + entry.y * view.o2;
    if (HAS_WIDE_COMPONENTS) {
        one = place_wide(v, view, pair, pair.d, v.local_o.z + od);
        other = place_wide(v, view, pair, -pair.d, v.local_o.z - od);
        return;
    }
    pair.bend = 1.0 - s2 * view.p2;
    one = place_narrow(v, view, pair, pair.d, v.local_o.z + od, pair.lengths, pair.inverse);
    other = place_narrow(v, view, pair, -pair.d, v.local_o.z - od, pair.lengths.yx, pair.inverse.yx);
}

// clang-format off
// All samples of `view`, a MixtureView or a PlaneMixture, at the point `v`, two pairs at a turn: a driver that
// compiles functions before it knows constants has each of them here but twice.
#define GATHER_MIXTURE                                                                                       \
    LobeSums sums = LobeSums(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);                                           \
    Lookup l0, l1, l2, l3;                                                                                   \
    const uint odd = SAMPLE_COUNT & 1u, pairs = odd + SAMPLE_COUNT / 2u;                                     \
    [[unroll]] for (uint k = 0u; k < pairs; k += 2u) {                                                       \
        bool has_next = k + 1u < pairs;                                                                      \
        place_pair(v, view, sample_entry(view.row + int(k)), l0, l1);                                        \
        if (has_next) place_pair(v, view, sample_entry(view.row + int(k) + 1), l2, l3);                      \
        add_lookup(sums, l0);                                                                                \
        if (k > 0u || odd == 0u) add_lookup(sums, l1); /* the one in the middle has none */                  \
        if (has_next) {                                                                                      \
            add_lookup(sums, l2);                                                                            \
            add_lookup(sums, l3);                                                                            \
        }                                                                                                    \
    }                                                                                                        \
    return sums;
// clang-format on

LobeSums gather_matched(LobeView v, MixtureView view) { GATHER_MIXTURE }

#endif
