// Runs one function of lib/spherical_harmonics.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/spherical_harmonics.glsl"
#include "probe/items.glsl"

void put_harmonics(vec3 n) {
    float y[9];
    harmonics(n, y);
    put(0u, vec4(y[0], y[1], y[2], y[3]));
    put(1u, vec4(y[4], y[5], y[6], y[7]));
    put(2u, vec4(y[8], 0.0, 0.0, 0.0));
}

// The normal, then the nine coefficients.
void put_irradiance(vec3 n) {
    vec4 coefficients[9];
    for (uint k = 0u; k < 9u; ++k)
        coefficients[k] = argument(k + 1u);
    put(irradiance_over_pi(coefficients, n));
}

void run() {
    vec4 a = argument(0u);
    switch (FUNCTION) {
    case PROBE_HARMONICS: put_harmonics(a.xyz); break;
    case PROBE_IRRADIANCE_OVER_PI: put_irradiance(a.xyz); break;
    }
}
