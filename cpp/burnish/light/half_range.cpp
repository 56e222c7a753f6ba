#include "burnish/light/half_range.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "burnish/error.h"
#include "burnish/light/environment.h"

namespace burnish {
namespace {

constexpr int LEAST_NORMAL = -14;   // exponent of the smallest half that has all bits
constexpr int LEAST_STEP = -24;     // of the spacing of subnormal halves
constexpr double RESIDUE = 0x1p-44; // of the largest value

struct Extent {
    double least = 0.0, largest = 0.0; // of the positive values, 0 if there is none
};

Extent extent_of(std::span<const float> radiance) {
    // Bits of floats that are not negative have the order of their values; less one, zero comes last.
    uint32_t most = 0, least = 0xffffffffu;
    for (const float value : radiance) {
        const uint32_t bits = std::bit_cast<uint32_t>(value);
        most = std::max(most, bits);
        least = std::min(least, bits - 1u);
    }
    if (most == 0) return {};
    return {std::bit_cast<float>(least + 1u), std::bit_cast<float>(most)};
}

/// The smallest exponent at which the value is not above the largest half.
int fitting_exponent(double largest) {
    const int exponent = std::ilogb(largest) - std::ilogb(double(HALF_MAX));
    return largest > std::ldexp(double(HALF_MAX), exponent) ? exponent + 1 : exponent;
}

} // namespace

int half_exponent(double least, double largest) {
    if (!(largest > 0.0)) return 0;
    const int fit = fitting_exponent(largest);
    const int most = least > 0.0 ? std::max(fit, std::ilogb(least) - LEAST_NORMAL) : fit;
    return std::clamp(std::clamp(0, fit, most), -126, 112);
}

HalfRange half_range_of(uint32_t face_size, std::span<const float> radiance) {
    const Extent extent = extent_of(radiance);
    HalfRange range;
    if (extent.largest == 0.0) return range; // a black map loses nothing
    range.exponent = half_exponent(extent.least, extent.largest);
    if (extent.least >= std::ldexp(1.0, range.exponent + LEAST_NORMAL)) return range;

    const int fit = fitting_exponent(extent.largest);
    const double least_held = std::ldexp(1.0, fit + LEAST_NORMAL), step = std::ldexp(1.0, fit + LEAST_STEP);
    const double least_meant = RESIDUE * extent.largest;
    const uint32_t face_texels = face_size * face_size;
    double least = extent.largest, light = 0.0, lost = 0.0, faint_angle = 0.0, angle = 0.0;
    for (size_t texel = 0; texel < radiance.size() / 3; ++texel) {
        const uint32_t in_face = uint32_t(texel % face_texels);
        const double u = (2.0 * (in_face % face_size) + 1.0) / face_size - 1.0;
        const double v = (2.0 * (in_face / face_size) + 1.0) / face_size - 1.0;
        const double solid_angle = std::pow(1.0 + u * u + v * v, -1.5);
        bool is_faint = false;
        for (const float channel : radiance.subspan(3 * texel, 3)) {
            const double value = channel;
            light += value * solid_angle;
            if (value >= least_held) {
                least = std::min(least, value);
            } else if (value >= least_meant) {
                is_faint = true;
                lost += std::abs(std::nearbyint(value / step) * step - value) * solid_angle;
            }
        }
        angle += solid_angle;
        if (!is_faint) continue;
        ++range.faint_texels;
        faint_angle += solid_angle;
    }
    range.exponent = half_exponent(range.faint_texels > 0 ? 0.0 : least, extent.largest);
    range.faint_sphere = faint_angle / angle;
    range.lost_light = lost / light;
    return range;
}

std::string HalfRange::sentence() const {
    if (faint_texels == 0) return {};
    return message(
        faint_texels, " texels, ", 100.0 * faint_sphere,
        " % of the sphere, are over 2^30 times darker than the brightest and are held by less than "
        "all bits of a half; of the light ",
        100.0 * lost_light, " % is lost");
}

} // namespace burnish
