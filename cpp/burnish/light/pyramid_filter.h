// The filters that make one mip level from the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace burnish {

/// Separable filters; tap k of texel i reads texel 2 i + k - (taps/2 - 1) of the level above.
enum class PyramidFilter {
    box,    // [1 1]/2
    gauss4, // [1 3 3 1]/8
    gauss6, // [1 5 10 10 5 1]/32
};

/// All that is known of a filter beside its weights, which stand in glsl/pyramid/reduce.comp.glsl.
struct PyramidFilterRow {
    PyramidFilter filter; ///< its place in the list
    const char* name;
    uint32_t taps; ///< along each axis
    /// c_f: the variance of a bilinear lookup in level l of the pyramid is c_f 4^l squared texels of level 0,
    /// per axis (maths: section 5).
    float lookup_variance;
};

inline constexpr PyramidFilterRow PYRAMID_FILTERS[] = {
    {PyramidFilter::box, "box", 2, 1.0f / 4.0f},
    {PyramidFilter::gauss4, "gauss4", 4, 5.0f / 12.0f},
    {PyramidFilter::gauss6, "gauss6", 6, 7.0f / 12.0f},
};

constexpr const PyramidFilterRow& row_of(PyramidFilter filter) {
    return PYRAMID_FILTERS[static_cast<size_t>(filter)];
}

/// Throws std::invalid_argument on a name that is none of the list.
PyramidFilter pyramid_filter(const std::string& name);

} // namespace burnish
