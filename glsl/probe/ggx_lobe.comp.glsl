// Runs one function of lobe/ggx.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lobe/ggx.glsl"
#include "probe/items.glsl"

void put_normal(GgxNormal normal) { put(vec4(normal.h, normal.q)); }

void put_point(LobePoint point) {
    put(0u, vec4(point.omega_i, point.cos_d));
    put(1u, vec4(point.base, point.stretch, 0.0, 0.0));
}

void put_disc(GgxDisc disc) {
    put(0u, vec4(disc.view, disc.c));
    put(1u, vec4(disc.other, disc.rest));
    put(2u, vec4(disc.level, 0.0, 0.0));
}

void put_map(mat2x3 map) {
    put(0u, vec4(map[0], 0.0));
    put(1u, vec4(map[1], 0.0));
}

void run() {
    vec4 a = argument(0u);
    vec4 b = argument(1u);
    vec4 c = argument(2u);
    switch (FUNCTION) {
    case PROBE_GGX_D: put(ggx_d(a.xyz, c.xy)); break;
    case PROBE_PROJECTED_WIDTH: put(projected_width(a.xyz, c.xy)); break;
    case PROBE_GGX_REST: put(ggx_rest(a.xyz, b.xyz, c.xy)); break;
    case PROBE_GGX_NORMAL: put_normal(ggx_normal(a.xyz, b.xy, c.xy)); break;
    case PROBE_GGX_DISC: put_disc(ggx_disc(a.xyz, c.xy)); break;
    case PROBE_GGX_LINEAR_MAP: put_map(ggx_linear_map(a.xyz, c.xy)); break;
    case PROBE_SAMPLE_GGX: put(sample_ggx(a.xyz, b.xy, c.xy)); break;
    case PROBE_GGX_PDF: put(ggx_pdf(a.xyz, b.xyz, c.xy)); break;
    case PROBE_GGX_AT: put_point(ggx_at(a.xyz, b.xy, c.xy)); break;
    case PROBE_GGX_WIDENED_D: put(ggx_widened_d(Widened(a.xy, b.xy, b.z, b.w), c.xy)); break;
    }
}
