#include "burnish/light/cosine_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/cores.h"

namespace burnish {
namespace {

/// Where texel or cell `k` of `count` has its left edge, in [-1, 1].
double edge(uint32_t k, uint32_t count) {
    return 2.0 * k / count - 1.0;
}

} // namespace

CosineSums::CosineSums(const CubeTexels& cube) : blocks_(size_t{6} * BLOCKS * BLOCKS) {
    require_texels(cube);
    for_each_on_cores(size_t{6} * CELLS, true,
                      [&](size_t k) { add_cell_row(cube, uint32_t(k / CELLS), uint32_t(k % CELLS)); });
    for (uint32_t k = 0; k < blocks_.size(); ++k) {
        const FaceAxes face = face_axes(k / (BLOCKS * BLOCKS));
        const uint32_t row = k / BLOCKS % BLOCKS, column = k % BLOCKS;
        const auto direction = [&](double x, double y) {
            return glm::normalize(face.axis + x * face.right + y * face.down);
        };
        Block& one = blocks_[k];
        const glm::dvec3 middle = direction(edge(2 * column + 1, 2 * BLOCKS), edge(2 * row + 1, 2 * BLOCKS));
        one.middle = middle;
        for (const uint32_t y : {row, row + 1}) // the corners are furthest
            for (const uint32_t x : {column, column + 1})
                one.reach = std::max(
                    one.reach, float(glm::distance(middle, direction(edge(x, BLOCKS), edge(y, BLOCKS)))));
        for (const CellRow& cells : one.rows)
            for (size_t channel = 0; channel < CHANNELS; ++channel)
                for (int axis = 0; axis < 3; ++axis)
                    for (const float moment : cells[channel][axis])
                        one.moments[channel][axis] += moment;
    }
}

void CosineSums::add_cell_row(const CubeTexels& cube, uint32_t face, uint32_t cell_row) {
    const FaceAxes axes = face_axes(face);
    const uint32_t size = cube.face_size;
    // A coarse texel is taken at several points: the weights change within it.
    const uint32_t points = std::max(size, LEAST_POINTS), of_cell = points / CELLS, of_texel = points / size;
    // w dw over an area du dv of the face is (u, v, 1)/(1 + u^2 + v^2)^2 du dv.
    const double area = 4.0 / (double(points) * points * std::numbers::pi);
    for (uint32_t cell = 0; cell < CELLS; ++cell) {
        std::array<glm::dvec3, CHANNELS> sums{}; // by channel; along right, down and the axis
        for (uint32_t y = cell_row * of_cell; y < (cell_row + 1) * of_cell; ++y) {
            const double v = edge(2 * y + 1, 2 * points);
            const float* texels = cube.radiance.data() + 3 * (size_t{face} * size + y / of_texel) * size;
            glm::dvec4 along(0.0), across(0.0); // by channel
            for (uint32_t x = cell * of_cell; x < (cell + 1) * of_cell; ++x) {
                const double u = edge(2 * x + 1, 2 * points);
                const double stretch = 1.0 + u * u + v * v;
                const float* texel = texels + 3 * (x / of_texel);
                const glm::dvec4 light =
                    (area / (stretch * stretch)) * glm::dvec4(texel[0], texel[1], texel[2], 1.0);
                along += u * light;
                across += light;
            }
            for (int channel = 0; channel < int(CHANNELS); ++channel)
                sums[size_t(channel)] += glm::dvec3(along[channel], v * across[channel], across[channel]);
        }
        CellRow& cells = block(face, cell_row / BLOCK, cell / BLOCK).rows[cell_row % BLOCK];
        for (size_t channel = 0; channel < CHANNELS; ++channel) {
            const glm::dvec3 sum = sums[channel];
            const glm::dvec3 moment = sum.x * axes.right + sum.y * axes.down + sum.z * axes.axis;
            for (int axis = 0; axis < 3; ++axis)
                cells[channel][axis][cell % BLOCK] = float(moment[axis]);
        }
    }
}

glm::vec3 CosineSums::irradiance_over_pi(glm::vec3 normal) const {
    std::array<float, CHANNELS> sums{};
    std::array<std::array<float, BLOCK>, CHANNELS> horizon{}; // by lane
    for (const Block& one : blocks_) {
        const float cosine = glm::dot(normal, one.middle);
        if (cosine <= -one.reach) continue;
        if (cosine >= one.reach) {
            for (size_t channel = 0; channel < CHANNELS; ++channel)
                sums[channel] += glm::dot(normal, one.moments[channel]);
            continue;
        }
        for (const CellRow& cells : one.rows)
            for (size_t channel = 0; channel < CHANNELS; ++channel)
                for (size_t k = 0; k < BLOCK; ++k)
                    horizon[channel][k] +=
                        std::max(0.0f, normal.x * cells[channel][0][k] + normal.y * cells[channel][1][k] +
                                           normal.z * cells[channel][2][k]);
    }
    for (size_t channel = 0; channel < CHANNELS; ++channel)
        for (const float lane : horizon[channel])
            sums[channel] += lane;
    return glm::vec3(sums[0], sums[1], sums[2]) / sums[3];
}

} // namespace burnish
