// Low-discrepancy points with a random shift, for progressive references. Fixed point: exact for any index.
#ifndef BURNISH_LIB_RANDOM
#define BURNISH_LIB_RANDOM

// A permutation of 32 bits that looks random (two rounds of multiply and xor-shift).
uint hash_uint(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

float unit_from_uint(uint x) { return float(x >> 8) * (1.0 / 16777216.0); }

// Point `index` of the additive recurrence with the first powers of 1/g, g the plastic number (2 dimensions)
// and its 3-dimensional sister, in 32-bit fixed point, shifted by `seed`.
vec2 recurrence_2d(uint index, uint seed) {
    uint x = index * 3242174889u + hash_uint(seed);
    uint y = index * 2447445414u + hash_uint(seed ^ 0x9e3779b9u);
    return vec2(unit_from_uint(x), unit_from_uint(y));
}

// All 32 bits of its first coordinate, for choices among more than 2^24.
uint recurrence_3d_x(uint index, uint seed) { return index * 3518319155u + hash_uint(seed ^ 0x68bc21ebu); }

// Threshold of a pixel in one of several pictures, [0, 1): the recurrence of the plastic number over rows and
// columns, that of the golden ratio over pictures. Any neighbourhood of pixels and any run of pictures has
// thresholds spread evenly.
float dither(uvec2 pixel, uint picture) {
    return unit_from_uint(pixel.x * 3242174889u + pixel.y * 2447445414u + picture * 2654435769u);
}

vec3 recurrence_3d(uint index, uint seed) {
    uint x = recurrence_3d_x(index, seed);
    uint y = index * 2882110345u + hash_uint(seed ^ 0x02e5be93u);
    uint z = index * 2360945575u + hash_uint(seed ^ 0x967a889bu);
    return vec3(unit_from_uint(x), unit_from_uint(y), unit_from_uint(z));
}

#endif
