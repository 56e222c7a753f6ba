// Runs one function of lib/footprint.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/footprint.glsl"
#include "probe/items.glsl"

void run() {
    vec4 a = argument(0u);
    switch (FUNCTION) {
    case PROBE_MIP_LEVEL: put(mip_level(a.x)); break;
    case PROBE_TEXELS_EXACT: put(texels_exact(a.x, a.y, a.z)); break;
    case PROBE_PUBLISHED_AREA_TERM: put(published_area_term(a.xyz)); break;
    case PROBE_TEXELS_PUBLISHED: put(texels_published(a.x, a.y, a.z, a.w)); break;
    }
}
