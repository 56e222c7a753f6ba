#include "burnish/light/spherical_harmonics.h"

#include "burnish/cores.h"
#include "burnish/light/cube_texels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace burnish {

namespace {

constexpr uint32_t LEAST_THREADED_FACE_SIZE = 256;
using Coefficients = std::array<glm::dvec3, 9>;

/// Integral over the texels of a row of radiance times the monomials 1, y, z, x, xy, yz, z^2, xz, x^2 - y^2
/// of the direction: what the harmonics are made of.
Coefficients integrate_row(const float* radiance, const double* solid_angles, const FaceAxes& face,
                           uint32_t face_size, uint32_t row) {
    Coefficients sum{};
    const glm::dvec3 left = face.axis + ((2.0 * row + 1.0) / face_size - 1.0) * face.down;
    for (uint32_t column = 0; column < face_size; ++column) {
        const glm::dvec3 toward = left + ((2.0 * column + 1.0) / face_size - 1.0) * face.right;
        const glm::dvec3 d = toward / std::sqrt(glm::dot(toward, toward));
        const std::array<double, 9> monomials{
            1.0, d.y, d.z, d.x, d.x * d.y, d.y * d.z, d.z * d.z, d.x * d.z, d.x * d.x - d.y * d.y};
        const float* texel = radiance + 3 * size_t{column};
        const glm::dvec3 light = solid_angles[column] * glm::dvec3(texel[0], texel[1], texel[2]);
        for (size_t k = 0; k < 9; ++k)
            sum[k] += monomials[k] * light;
    }
    return sum;
}

} // namespace

std::array<glm::dvec3, 9> irradiance_over_pi_coefficients(const CubeTexels& cube) {
    const uint32_t face_size = require_texels(cube);
    const std::vector<double> solid_angles = texel_solid_angles(face_size);
    // One sum a row, added up in order: the result does not depend on the number of threads.
    std::vector<Coefficients> rows(size_t{6} * face_size);
    for_each_on_cores(rows.size(), face_size >= LEAST_THREADED_FACE_SIZE, [&](size_t k) {
        const auto row = static_cast<uint32_t>(k % face_size);
        rows[k] = integrate_row(cube.radiance.data() + 3 * k * face_size,
                                solid_angles.data() + size_t{row} * face_size,
                                face_axes(static_cast<uint32_t>(k / face_size)), face_size, row);
    });
    Coefficients sum{};
    for (const Coefficients& row : rows) {
        for (size_t k = 0; k < 9; ++k)
            sum[k] += row[k];
    }

    // Normalisation of the harmonics, and the cosine lobe's factors pi, 2 pi/3, pi/4 over pi.
    constexpr double PI = std::numbers::pi;
    const double y0 = std::sqrt(1.0 / (4.0 * PI));
    const double y1 = std::sqrt(3.0 / (4.0 * PI)) * (2.0 / 3.0);
    const double y2 = std::sqrt(15.0 / (4.0 * PI)) * (1.0 / 4.0);
    const double y20 = std::sqrt(5.0 / (16.0 * PI)) * (1.0 / 4.0);
    const glm::dvec3 all = sum[0];
    return {y0 * all,
            y1 * sum[1],
            y1 * sum[2],
            y1 * sum[3],
            y2 * sum[4],
            y2 * sum[5],
            y20 * (3.0 * sum[6] - all),
            y2 * sum[7],
            y2 / 2.0 * sum[8]};
}

glm::dvec3 irradiance_over_pi(const std::array<glm::dvec3, 9>& coefficients, glm::dvec3 n) {
    constexpr double PI = std::numbers::pi;
    const double y0 = std::sqrt(1.0 / (4.0 * PI)), y1 = std::sqrt(3.0 / (4.0 * PI));
    const double y2 = std::sqrt(15.0 / (4.0 * PI)), y20 = std::sqrt(5.0 / (16.0 * PI));
    const std::array<double, 9> harmonics{y0,
                                          y1 * n.y,
                                          y1 * n.z,
                                          y1 * n.x,
                                          y2 * n.x * n.y,
                                          y2 * n.y * n.z,
                                          y20 * (3.0 * n.z * n.z - 1.0),
                                          y2 * n.x * n.z,
                                          y2 / 2.0 * (n.x * n.x - n.y * n.y)};
    glm::dvec3 sum(0.0);
    for (size_t k = 0; k < 9; ++k)
        sum += harmonics[k] * coefficients[k];
    return glm::max(sum, glm::dvec3(0.0));
}

} // namespace burnish
