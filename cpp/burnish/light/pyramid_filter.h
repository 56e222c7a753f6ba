// The filters that make one mip level from the next.
#pragma once

#include <string>

namespace burnish {

/// Separable filters; tap k of texel i reads texel 2 i + k - (taps/2 - 1) of the level above.
enum class PyramidFilter {
    box,    // [1 1]/2
    gauss4, // [1 3 3 1]/8
    gauss6, // [1 5 10 10 5 1]/32
};

/// "box", "gauss4", "gauss6". Throws std::invalid_argument on any other name.
PyramidFilter pyramid_filter(const std::string& name);
/// c_f: the variance of a bilinear lookup in level l of the pyramid is c_f 4^l squared texels of level 0, per
/// axis (maths: section 5).
float lookup_variance(PyramidFilter filter);
const char* pyramid_filter_name(PyramidFilter filter);

} // namespace burnish
