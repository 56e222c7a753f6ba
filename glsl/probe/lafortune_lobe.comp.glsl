// Runs one function of lobe/lafortune.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lobe/lafortune.glsl"
#include "probe/items.glsl"

void put_point(LobePoint point) {
    put(0u, vec4(point.omega_i, point.cos_d));
    put(1u, vec4(point.base, point.stretch, 0.0, 0.0));
}

void put_map(mat2x3 map) {
    put(0u, vec4(map[0], 0.0));
    put(1u, vec4(map[1], 0.0));
}

void put_lobe(PowerLobe lobe) { put(vec4(lobe.axis, lobe.gain)); }

void run() {
    vec4 a = argument(0u);
    vec4 b = argument(1u);
    vec4 own = argument(2u);
    switch (FUNCTION) {
    case PROBE_POWER_LOBE: put_lobe(power_lobe(a.xyz, own)); break;
    case PROBE_COSINE_POWER: put(cosine_power(a.xyz, b.xyz, own.w)); break;
    case PROBE_LAFORTUNE_VALUE: put(lafortune_value(a.xyz, b.xyz, own)); break;
    case PROBE_LAFORTUNE_UNDER_LIGHT: put(lafortune_under_light(a.xyz, b.xyz, own, a.w)); break;
    case PROBE_LAFORTUNE_PDF: put(lafortune_pdf(a.xyz, b.xyz, own)); break;
    case PROBE_LAFORTUNE_AXES: put_map(lafortune_axes(a.xyz)); break;
    case PROBE_LAFORTUNE_LINEAR_MAP: put_map(lafortune_linear_map(a.xyz, own)); break;
    case PROBE_LAFORTUNE_AT: put_point(lafortune_at(a.xyz, b.xy, own)); break;
    }
}
