// Runs one function of lobe/sheen.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lobe/sheen.glsl"
#include "probe/items.glsl"

void put_point(LobePoint point) {
    put(0u, vec4(point.omega_i, point.cos_d));
    put(1u, vec4(point.base, point.stretch, 0.0, 0.0));
}

void run() {
    vec4 a = argument(0u);
    vec4 b = argument(1u);
    float alpha = argument(2u).x;
    switch (FUNCTION) {
    case PROBE_SHEEN_D: put(sheen_d(a.xyz, alpha)); break;
    case PROBE_SHEEN_CURVE: put(sheen_curve(a.x, alpha)); break;
    case PROBE_SHEEN_LAMBDA: put(sheen_lambda(a.x, alpha)); break;
    case PROBE_SHEEN_BRDF: put(sheen_brdf(a.xyz, b.xyz, sheen_half_vector(a.xyz, b.xyz), alpha)); break;
    case PROBE_SHEEN_HALF_VECTOR: put(sheen_half_vector(a.xyz, b.xyz)); break;
    case PROBE_SHEEN_AT: put_point(sheen_at(a.xyz, b.xy, alpha)); break;
    }
}
