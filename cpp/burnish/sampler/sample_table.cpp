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

double plane_density(Density density, double r2) {
    const double square = (1.0 + r2) * (1.0 + r2);
    return (density == Density::gaussian ? std::exp(-r2) : 1.0 / square) / std::numbers::pi;
}

SampleTable make_plane_table(const PlanePoints& points, Density density, uint32_t face_size, float mip_bias) {
    const double quarter = 0.25 * texels_of_face(face_size, mip_bias);
    std::vector<double> weights;
    double sum = 0.0;
    for (size_t k = 0; k < points.places.size(); ++k) {
        const glm::dvec2 p = points.places[k];
        weights.push_back(points.areas[k] * plane_density(density, glm::dot(p, p)));
        sum += weights.back();
    }
    SampleTable table;
    for (size_t k = 0; k < points.places.size(); ++k)
        table.entries.emplace_back(points.places[k], weights[k] / (points.is_normalized ? sum : 1.0),
                                   quarter * points.areas[k]);
    return table;
}

double texels_of_face(uint32_t face_size, float mip_bias) {
    return static_cast<double>(face_size) * face_size * std::exp2(2.0 * mip_bias);
}

} // namespace burnish
