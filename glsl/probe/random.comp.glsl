// Runs one function of lib/random.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/random.glsl"
#include "probe/items.glsl"

void run() {
    uvec4 a = bits(0u);
    switch (FUNCTION) {
    case PROBE_HASH_UINT: put(hash_uint(a.x)); break;
    case PROBE_UNIT_FROM_UINT: put(unit_from_uint(a.x)); break;
    case PROBE_RECURRENCE_2D: put(recurrence_2d(a.x, a.y)); break;
    case PROBE_RECURRENCE_3D: put(recurrence_3d(a.x, a.y)); break;
    case PROBE_DITHER: put(dither(a.xy, a.z)); break;
    case PROBE_RECURRENCE_3D_X: put(recurrence_3d_x(a.x, a.y)); break;
    }
}
