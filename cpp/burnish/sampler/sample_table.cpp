#include "burnish/sampler/sample_table.h"

#include <cmath>
#include <numbers>

namespace burnish {
namespace {

double radical_inverse(uint32_t index) {
    double result = 0.0;
    for (double digit = 0.5; index; index >>= 1, digit *= 0.5)
        if (index & 1u) result += digit;
    return result;
}

} // namespace

std::vector<glm::dvec2> unit_points(PointSet points, uint32_t count) {
    constexpr double smallest = 1.0 / (1 << 24);
    constexpr double golden = std::numbers::phi - 1.0;
    std::vector<glm::dvec2> result(count);
    for (uint32_t k = 0; k < count; ++k) {
        if (points == PointSet::hammersley)
            result[k] = {std::max(double(k) / count, smallest), radical_inverse(k)};
        else
            result[k] = {(k + 0.5) / count, std::fmod(k * golden, 1.0)};
    }
    return result;
}

double texels_of_face(uint32_t face_size, float mip_bias) {
    return static_cast<double>(face_size) * face_size * std::exp2(2.0 * mip_bias);
}

} // namespace burnish
