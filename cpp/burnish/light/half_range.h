// How a map's texels, floats of any size, are held by halves: all of a map over one power of two.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace burnish {

/// Halves hold radiance / 2^exponent. A power of two is exact: as long as no half is subnormal, texels keep
/// the bits that they would have in a map of any other brightness.
struct HalfRange {
    int exponent = 0;
    /// Texels with a channel more than 2^30 times darker than the brightest one: no power of two holds both
    /// with all their bits. The brightest is held; the faint are rounded to multiples of 2^(exponent - 24).
    uint64_t faint_texels = 0;
    double faint_sphere = 0.0; ///< their share of the sphere
    double lost_light = 0.0;   ///< share of the map's light that the rounding of the faint changes

    /// One sentence for the report, empty when all is held.
    std::string sentence() const;
};

/// The range of a map's texels, which are finite and not negative: 6 face_size^2 of three channels.
///
/// The exponent is the one nearest to 0 at which the brightest channel is at most HALF_MAX and the darkest
/// one that is not black at least 2^-14, a normal half; where some are too faint for that beside the
/// brightest, it is the smallest at which the brightest fits. A channel below 2^-44 of the brightest is taken
/// for black: resampling in double leaves such residues.
HalfRange half_range_of(uint32_t face_size, std::span<const float> radiance);

/// The exponent nearest to 0 at which halves hold values from `least` to `largest` with all their bits, or
/// the smallest at which they hold `largest`; within -126..112, so that 2^-exponent is a float. 0 where
/// `largest` is.
int half_exponent(double least, double largest);

} // namespace burnish
