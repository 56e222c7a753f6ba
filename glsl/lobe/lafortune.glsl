// Lafortune's lobe (after McAllister, Lastra and Heidrich 2002): (o^T C i)^n, a power lobe around p = C o.
// Directions are in the local frame, z = normal. own = diagonal of C, then n.
#ifndef BURNISH_LOBE_LAFORTUNE
#define BURNISH_LOBE_LAFORTUNE

#include "lobe/interface.glsl"
#include "lobe/kurt.glsl"

// Powers are taken by exp of no more than this: they and their products stay finite.
const float LAFORTUNE_MOST_EXPONENT = 60.0;

struct PowerLobe {
    vec3 axis;  // p/|p|
    float gain; // |p|^n
};

PowerLobe power_lobe(vec3 omega_o, vec4 own) {
    vec3 p = own.xyz * omega_o;
    float length2 = dot(p, p);
    if (length2 < 1e-30) return PowerLobe(vec3(0.0, 0.0, 1.0), 0.0);
    float exponent = 0.5 * own.w * log(length2);
    return PowerLobe(p * inversesqrt(length2),
                     exp(clamp(exponent, -LAFORTUNE_MOST_EXPONENT, LAFORTUNE_MOST_EXPONENT)));
}

// Cosine to the power n, the cosine of unit vectors from their difference: beside 1 it has all digits. 0
// behind.
float cosine_power(vec3 a, vec3 b, float n) {
    vec3 difference = a - b;
    float rest = 0.5 * dot(difference, difference); // 1 - cos
    float logarithm = rest < 1e-2 ? -rest * (1.0 + rest * (0.5 + rest / 3.0)) : log(max(1.0 - rest, 1e-30));
    return rest < 1.0 ? exp(n * logarithm) : 0.0;
}

// f cos_i without weight, for directions above the horizon.
float lafortune_value(vec3 omega_i, vec3 omega_o, vec4 own) {
    PowerLobe lobe = power_lobe(omega_o, own);
    return lobe.gain * cosine_power(lobe.axis, omega_i, own.w) * max(omega_i.z, 0.0);
}

// The same under a light whose directions have a variance per axis: variances, 1/(n + 1) a lobe's, add up.
float lafortune_under_light(vec3 omega_i, vec3 omega_o, vec4 own, float variance) {
    PowerLobe lobe = power_lobe(omega_o, own);
    float n = max(1.0 / (1.0 / (own.w + 1.0) + variance) - 1.0, 0.0);
    return lobe.gain * (n + 1.0) / (own.w + 1.0) * cosine_power(lobe.axis, omega_i, n) * max(omega_i.z, 0.0);
}

// Density of what is drawn, per solid angle.
float lafortune_pdf(vec3 omega_i, vec3 omega_o, vec4 own) {
    return (own.w + 1.0) / (2.0 * PI) * cosine_power(power_lobe(omega_o, own).axis, omega_i, own.w);
}

// Axes of the plane across the lobe's axis: seen along the normal they are the lobe's own.
mat2x3 lafortune_axes(vec3 axis) {
    float sine = length(axis.xy);
    vec2 e = sine > 1e-7 ? axis.xy / sine : vec2(1.0, 0.0);
    vec3 across = vec3(-e.y, e.x, 0.0), along = vec3(axis.z * e, -sine);
    return mat2x3(e.x * along - e.y * across, e.y * along + e.x * across);
}

// Derivative of the direction at the middle of the plane.
mat2x3 lafortune_linear_map(vec3 omega_o, vec4 own) {
    return sqrt(2.0 / (own.w + 1.0)) * lafortune_axes(power_lobe(omega_o, own).axis);
}

// exp(-r^2) = cos^(n+1): a place at the radius r lies at the angle of that cosine.
LobePoint lafortune_at(vec3 omega_o, vec2 p, vec4 own) {
    PowerLobe lobe = power_lobe(omega_o, own);
    float r2 = dot(p, p), t = r2 / (own.w + 1.0);
    float cosine = exp(-t);
    // (1 - exp(-2 t))/r^2, beside 0 by its series.
    float square = t < 0.05 ? 2.0 / (own.w + 1.0) *
                                  (1.0 - t * (1.0 - t * (2.0 / 3.0 - t * (1.0 / 3.0 - t * 2.0 / 15.0))))
                            : (1.0 - cosine * cosine) / r2;
    LobePoint point;
    point.omega_i = cosine * lobe.axis + sqrt(square) * (lafortune_axes(lobe.axis) * p);
    point.cos_d = 1.0;
    point.base = lobe.gain * 2.0 * PI / (own.w + 1.0) * max(point.omega_i.z, 0.0);
    point.stretch = 2.0 / (own.w + 1.0) * cosine;
    return point;
}

#endif
