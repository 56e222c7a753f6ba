// Local frames and their packing. A frame is the columns (tangent, bitangent, normal).
#ifndef BURNISH_LIB_FRAME
#define BURNISH_LIB_FRAME

// Two unit vectors that complete the unit vector `n` (Duff et al. 2017); finite for every n, (0, 0, -1)
// included.
mat3 orthonormal_basis(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// The part of `t` orthogonal to the unit vector `n`, normalised. A second step removes what rounding left of
// n when t is almost parallel to it; parallel or zero t falls back to orthonormal_basis.
mat3 frame_from_tangent(vec3 n, vec3 t, float handedness) {
    float length2 = dot(t, t);
    vec3 unit = t * inversesqrt(max(length2, 1e-36));
    vec3 once = unit - n * dot(n, unit);
    float once2 = dot(once, once);
    vec3 tangent = once * inversesqrt(max(once2, 1e-36));
    vec3 twice = tangent - n * dot(n, tangent);
    tangent = twice * inversesqrt(max(dot(twice, twice), 1e-36));
    bool is_usable = length2 > 1e-36 && once2 > 1e-10;
    mat3 basis = orthonormal_basis(n);
    tangent = is_usable ? tangent : basis[0];
    return mat3(tangent, handedness * cross(n, tangent), n);
}

// Tangent along growing longitude about y, cross(y, n): smooth but at the two poles, where orthonormal_basis
// serves.
mat3 longitude_frame(vec3 n) {
    float length2 = n.x * n.x + n.z * n.z;
    vec3 tangent = vec3(n.z, 0.0, -n.x) * inversesqrt(max(length2, 1e-36));
    mat3 basis = orthonormal_basis(n);
    tangent = length2 > 1e-10 ? tangent : basis[0];
    return mat3(tangent, cross(n, tangent), n);
}

vec2 sign_not_zero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

// Unit vector to [-1, 1]^2: the octahedron's upper half inside the diamond, its lower half folded out over
// the corners.
vec2 octahedral_encode(vec3 n) {
    vec2 p = n.xy / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-36);
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * sign_not_zero(p);
}

// The sign of z decides which basis a packed tangent refers to. On the equator z is rounding alone, so that
// the shader that packs and the one that unpacks must round alike: `precise`.
vec3 octahedral_decode(vec2 p) {
    precise float z = 1.0 - abs(p.x) - abs(p.y);
    vec3 n = vec3(p, z);
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * sign_not_zero(n.xy);
    return normalize(n);
}

// Angle of a plane vector as its way around a diamond, -1..1: monotone in the angle, exact to invert, no
// trigonometry.
float diamond_encode(vec2 v) {
    float a = v.y / max(abs(v.x) + abs(v.y), 1e-36);
    return 0.5 * (v.x >= 0.0 ? a : (v.y >= 0.0 ? 2.0 - a : -2.0 - a));
}

vec2 diamond_decode(float d) {
    float a = 2.0 * d;
    float y = abs(a) <= 1.0 ? a : (a > 0.0 ? 2.0 - a : -2.0 - a);
    float x = abs(a) <= 1.0 ? 1.0 - abs(a) : abs(y) - 1.0;
    return normalize(vec2(x, y));
}

// Surface attributes in 8 bytes: x: octahedral normal, two snorm16; y: diamond angle of the tangent in the
// orthonormal_basis of the packed normal (15 bits), handedness (1 bit), material + 1 (16 bits, 0 = no
// surface).
uvec2 pack_surface(vec3 normal, vec3 tangent, float handedness, uint material) {
    uint packed_normal = packSnorm2x16(octahedral_encode(normal));
    mat3 basis = orthonormal_basis(octahedral_decode(unpackSnorm2x16(packed_normal)));
    float angle = diamond_encode(vec2(dot(tangent, basis[0]), dot(tangent, basis[1])));
    uint packed_angle =
        uint(clamp(round((angle * 0.5 + 0.5) * 32768.0), 0.0, 32768.0)) & 0x7fffu; // 1 is -1 again
    return uvec2(packed_normal, (packed_angle << 17) | (handedness < 0.0 ? 0x10000u : 0u) | (material + 1u));
}

// Of a surface whose tangent nothing asks for.
uvec2 pack_surface(vec3 normal, uint material) {
    return uvec2(packSnorm2x16(octahedral_encode(normal)), material + 1u);
}

bool has_surface(uvec2 surface) { return (surface.y & 0xffffu) != 0u; }
uint unpack_material(uvec2 surface) { return (surface.y & 0xffffu) - 1u; }
vec3 unpack_normal(uvec2 surface) { return octahedral_decode(unpackSnorm2x16(surface.x)); }

struct PackedFrame {
    vec3 normal, tangent;
    float handedness;
};

PackedFrame unpack_frame(uvec2 surface) {
    PackedFrame frame;
    frame.normal = unpack_normal(surface);
    mat3 basis = orthonormal_basis(frame.normal);
    vec2 t = diamond_decode(float(surface.y >> 17) / 16384.0 - 1.0);
    frame.tangent = t.x * basis[0] + t.y * basis[1];
    frame.handedness = (surface.y & 0x10000u) != 0u ? -1.0 : 1.0;
    return frame;
}

#endif
