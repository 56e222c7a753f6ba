// Runs one function of lib/frame.glsl over a buffer, for tests.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/frame.glsl"
#include "probe/items.glsl"

void put(PackedFrame frame) {
    put(mat3(frame.tangent, frame.handedness * cross(frame.normal, frame.tangent), frame.normal));
}

void run() {
    vec4 a = argument(0u);
    vec4 b = argument(1u);
    uvec2 surface = bits(0u).xy;
    switch (FUNCTION) {
    case PROBE_ORTHONORMAL_BASIS: put(orthonormal_basis(a.xyz)); break;
    case PROBE_FRAME_FROM_TANGENT: put(frame_from_tangent(a.xyz, b.xyz, argument(2u).x)); break;
    case PROBE_LONGITUDE_FRAME: put(longitude_frame(a.xyz)); break;
    case PROBE_SIGN_NOT_ZERO: put(sign_not_zero(a.xy)); break;
    case PROBE_OCTAHEDRAL_ENCODE: put(octahedral_encode(a.xyz)); break;
    case PROBE_OCTAHEDRAL_DECODE: put(octahedral_decode(a.xy)); break;
    case PROBE_DIAMOND_ENCODE: put(diamond_encode(a.xy)); break;
    case PROBE_DIAMOND_DECODE: put(diamond_decode(a.x)); break;
    case PROBE_PACK_SURFACE: put(pack_surface(a.xyz, b.xyz, argument(2u).x, bits(3u).x)); break;
    case PROBE_HAS_SURFACE: put(has_surface(surface) ? 1u : 0u); break;
    case PROBE_UNPACK_MATERIAL: put(unpack_material(surface)); break;
    case PROBE_UNPACK_NORMAL: put(unpack_normal(surface)); break;
    case PROBE_UNPACK_FRAME: put(unpack_frame(surface)); break;
    }
}
