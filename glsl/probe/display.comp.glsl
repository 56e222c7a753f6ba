// Runs one function of lib/display.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/display.glsl"
#include "probe/items.glsl"

void run() {
    vec4 a = argument(0u);
    switch (FUNCTION) {
    case PROBE_SRGB_ENCODE: put(srgb_encode(a.xyz)); break;
    case PROBE_DISPLAY_PIXEL: put(display_pixel(a, argument(1u).x)); break;
    }
}
