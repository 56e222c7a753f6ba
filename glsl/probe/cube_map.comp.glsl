// Runs one function of lib/cube_map.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/cube_map.glsl"
#include "probe/items.glsl"

void put_face_uv(vec3 direction) {
    vec2 uv;
    uint face = cube_face_uv(direction, uv);
    put(vec4(uintBitsToFloat(face), uv, 0.0));
}

void run() {
    vec4 a = argument(0u);
    switch (FUNCTION) {
    case PROBE_CUBE_DIRECTION: put(cube_direction(bits(0u).x, a.y, a.z)); break;
    case PROBE_CUBE_FACE_UV: put_face_uv(a.xyz); break;
    case PROBE_CUBE_STRETCH: put(cube_stretch(a.xyz)); break;
    case PROBE_TEXEL_SOLID_ANGLE: put(texel_solid_angle(a.x, argument(1u).xyz)); break;
    }
}
