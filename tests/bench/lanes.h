// Vectors of as many floats as the processor's registers hold, and the shading's functions on them.
#pragma once

#include <cstdint>

#include <immintrin.h>

namespace lanes {

#ifdef __AVX512F__
constexpr int COUNT = 16;
#else
constexpr int COUNT = 8;
#endif

using Floats = float __attribute__((vector_size(4 * COUNT)));
using Ints = int32_t __attribute__((vector_size(4 * COUNT)));

inline Floats as_floats(Ints v) {
    return reinterpret_cast<Floats>(v);
}
inline Ints as_ints(Floats v) {
    return reinterpret_cast<Ints>(v);
}
inline Ints truncate(Floats v) {
    return __builtin_convertvector(v, Ints);
}
inline Floats to_floats(Ints v) {
    return __builtin_convertvector(v, Floats);
}
inline Floats absolute(Floats v) {
    return as_floats(as_ints(v) & 0x7fffffff);
}
inline Floats least(Floats a, Floats b) {
    return a < b ? a : b;
}
inline Floats most(Floats a, Floats b) {
    return a > b ? a : b;
}

inline Floats square_root(Floats v) {
    for (int k = 0; k < COUNT; ++k)
        v[k] = __builtin_sqrtf(v[k]);
    return v;
}

inline bool any(Ints mask) {
    int bits = 0;
    for (int k = 0; k < COUNT; ++k)
        bits |= mask[k];
    return bits != 0;
}

inline Floats counting() {
    Floats v{};
    for (int k = 0; k < COUNT; ++k)
        v[k] = float(k);
    return v;
}

/// Of positive numbers: exponent and a polynomial of the mantissa that is off by at most 1.7e-5
/// (through the Chebyshev nodes of degree 5).
inline Floats log2(Floats v) {
    const Ints bits = as_ints(v);
    const Floats exponent = to_floats((bits >> 23) - 127);
    const Floats m = as_floats((bits & 0x007fffff) | 0x3f800000);
    const Floats p =
        m * (m * (m * (m * (m * 0.04300496f - 0.40251339f) + 1.58947429f) - 3.48987855f) + 5.04785541f);
    return exponent + (p - 2.78792621f);
}

struct Vector {
    Floats x, y, z;
};

inline Floats dot(Vector a, Vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector scaled(Vector v, Floats s) {
    return {v.x * s, v.y * s, v.z * s};
}
inline Vector normalized(Vector v) {
    return scaled(v, 1.0f / square_root(dot(v, v)));
}

inline Vector cross(Vector a, Vector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Vector select(Ints mask, Vector a, Vector b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

} // namespace lanes
