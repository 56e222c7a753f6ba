// Charlie sheen (Estevez and Kulla 2017, as KHR_materials_sheen has it): cloth, brightest toward grazing.
// Directions are in the local frame, z = normal. a = alpha, the square of the perceptual roughness.
#ifndef BURNISH_LOBE_SHEEN
#define BURNISH_LOBE_SHEEN

#include "lobe/interface.glsl"
#include "lobe/kurt.glsl"

// D = (2 + 1/a) sin_h^(1/a)/(2 pi); the sine from components.
float sheen_d(vec3 h, float a) {
    return (2.0 + 1.0 / a) * exp(0.5 / a * log(max(dot(h.xy, h.xy), 1e-30))) / (2.0 * PI);
}

float sheen_curve(float x, float a) {
    float t = (1.0 - a) * (1.0 - a);
    float A = mix(21.5473, 25.3245, t), B = mix(3.82987, 3.32435, t), C = mix(0.19823, 0.16801, t);
    float D = mix(-1.97760, -1.27393, t), E = mix(-4.32054, -4.85967, t);
    return A / (1.0 + B * pow(x, C)) + D * x + E;
}

// How far a cosine is masked; that of the half is where both branches meet.
float sheen_lambda(float cosine, float a) {
    return exp(cosine < 0.5 ? sheen_curve(cosine, a)
                            : 2.0 * sheen_curve(0.5, a) - sheen_curve(1.0 - cosine, a));
}

// f without weight; cosines are at least 1e-3 of the light's and MIN_COS of the view's.
float sheen_brdf(vec3 omega_i, vec3 omega_o, vec3 h, float a) {
    float ci = clamp(omega_i.z, 1e-3, 1.0), co = clamp(omega_o.z, MIN_COS, 1.0);
    return sheen_d(h, a) / ((1.0 + sheen_lambda(co, a) + sheen_lambda(ci, a)) * 4.0 * co * ci);
}

vec3 sheen_half_vector(vec3 omega_i, vec3 omega_o) {
    vec3 h = omega_i + omega_o;
    return h * inversesqrt(max(dot(h, h), 1e-20));
}

// The plane is that of the cosine about the normal: exp(-r^2) = cos^2.
LobePoint sheen_at(vec3 omega_o, vec2 p, float a) {
    float r2 = dot(p, p), t = 0.5 * r2;
    float cosine = exp(-t);
    float square = t < 0.05 ? 1.0 - t * (1.0 - t * (2.0 / 3.0 - t / 3.0)) : (1.0 - cosine * cosine) / r2;
    LobePoint point;
    point.omega_i = vec3(sqrt(square) * p, cosine);
    point.cos_d = 1.0;
    point.base = PI * sheen_brdf(point.omega_i, omega_o, sheen_half_vector(point.omega_i, omega_o), a);
    point.stretch = cosine;
    return point;
}

#endif
