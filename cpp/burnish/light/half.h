// Half precision, rounded as IEEE 754 does: glm rounds ties up.
#pragma once

#include <bit>
#include <cstdint>

namespace burnish {

/// Float to half for values in [0, HALF_MAX], to nearest even. Below 2^-14 a half is subnormal, a multiple of
/// 2^-24: adding 0.5 makes the float unit round at just that step. Above, the carry of the added bits does
/// the rounding.
inline uint16_t half_bits(float value) {
    constexpr uint32_t SMALLEST_NORMAL = 0x38800000u; // 2^-14
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t subnormal = std::bit_cast<uint32_t>(value + 0.5f) - std::bit_cast<uint32_t>(0.5f);
    const uint32_t rebased = bits - ((127u - 15u) << 23);
    const uint32_t normal = (rebased + 0xFFFu + ((bits >> 13) & 1u)) >> 13;
    return static_cast<uint16_t>(bits < SMALLEST_NORMAL ? subnormal : normal);
}

} // namespace burnish
