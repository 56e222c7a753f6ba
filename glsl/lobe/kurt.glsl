// The Kurt lobe (RS eqs. 1-5, after Kurt et al. 2010) in forms that stay exact in float32.
// Half-vectors and directions are in the local frame, z = normal. m = roughness along x and y.
#ifndef BURNISH_LOBE_KURT
#define BURNISH_LOBE_KURT

#include "lobe/interface.glsl"

const float PI = 3.14159265358979;
// Cosines of the view below it are taken as this: the lobe's grazing power stays finite.
const float MIN_COS = 1e-4;

// (1 - u)^5, the part of Schlick's Fresnel that grows toward grazing: F = r0 + (1 - r0) schlick_weight(o.h).
float schlick_weight(float u) {
    float a = clamp(1.0 - u, 0.0, 1.0);
    float a2 = a * a;
    return a2 * a2 * a;
}

float schlick_fresnel(float u, float r0) { return r0 + (1.0 - r0) * schlick_weight(u); }

// q(h) = exp(-tan^2), the tangents from components: 1/cos^2 - 1 would lose all digits for narrow lobes.
float kurt_q(vec3 h, vec2 m) {
    float x = h.x / m.x;
    float y = h.y / m.y;
    float exponent = (x * x + y * y) / max(h.z * h.z, 1e-24);
    return h.z > 0.0 ? exp(-exponent) : 0.0;
}

// D(h) = q / (pi mx my cos_h^4). The exponent comes first: where it flushes q to zero, D is zero whatever
// cos_h.
float kurt_d(vec3 h, vec2 m) {
    float q = kurt_q(h, m);
    float z2 = max(h.z * h.z, 1e-16);
    return q > 0.0 ? q / (PI * m.x * m.y * z2 * z2) : 0.0;
}

// cos_i^(1-alpha) cos_o^-alpha, 0 at and below the horizon; alpha 1 has no cos_i left, so pow(0, 0) never
// arises.
float grazing_term(float cos_i, float cos_o, float alpha) {
    float i = max(cos_i, 1e-30);
    float value = pow(i, 1.0 - alpha) * pow(max(cos_o, MIN_COS), -alpha);
    return cos_i > 0.0 ? value : 0.0;
}

// Half-vector with density D cos_h, from x in the unit square. x.x >= 2^-24 keeps it above the horizon; log,
// good to 2^-21 only beside 1, may come out positive there.
vec3 sample_kurt(vec2 x, vec2 m) {
    float radius = sqrt(max(-log(clamp(x.x, 5.9604645e-8, 1.0)), 0.0));
    float azimuth = 2.0 * PI * (x.y - 0.5); // half a turn back: sin and cos are accurate in [-pi, pi]
    vec2 slope = -m * radius * vec2(cos(azimuth), sin(azimuth));
    return vec3(slope, 1.0) * inversesqrt(1.0 + dot(slope, slope));
}

// Density of the mirrored direction per solid angle: D cos_h / (4 o.h).
float kurt_pdf(vec3 h, float cos_d, vec2 m) { return kurt_d(h, m) * h.z / (4.0 * max(cos_d, 1e-20)); }

// f cos_i without weight and Fresnel: D cos_i / (4 (o.h) (cos_i cos_o)^alpha).
float kurt_value(vec3 omega_i, vec3 omega_o, vec2 m, float alpha) {
    vec3 h = omega_i + omega_o;
    float length2 = dot(h, h);
    if (omega_i.z <= 0.0 || length2 < 1e-12) return 0.0;
    h *= inversesqrt(length2);
    return kurt_d(h, m) * grazing_term(omega_i.z, omega_o.z, alpha) / (4.0 * max(dot(omega_o, h), 1e-20));
}

// D cos_h^4 of a lobe that is wider by a light.
float kurt_widened_d(Widened w, vec2 m) {
    vec2 form = widened_form(w, m * m, 1.0);
    return exp(-form.x) / (PI * sqrt(form.y));
}

#endif
