#include "burnish/light/cube_texels.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace burnish {

std::vector<double> texel_solid_angles(uint32_t face_size) {
    // The integral of du dv / (1 + u^2 + v^2)^(3/2) from (0, 0) is atan(u v / sqrt(1 + u^2 + v^2)): a
    // rectangle is its mixed difference. A quarter of a face is enough, and of that one side of its diagonal.
    const size_t n = face_size, quarter = (n + 1) / 2;
    std::vector<double> corners((quarter + 1) * (quarter + 1));
    for (size_t row = 0; row <= quarter; ++row) {
        const double v = 2.0 * double(row) / face_size - 1.0;
        for (size_t column = 0; column <= row; ++column) {
            const double u = 2.0 * double(column) / face_size - 1.0;
            corners[row * (quarter + 1) + column] = corners[column * (quarter + 1) + row] =
                std::atan2(u * v, std::sqrt(1.0 + u * u + v * v));
        }
    }
    std::vector<double> solid_angles(n * n);
    for (size_t row = 0; row < quarter; ++row) {
        const double* above = &corners[row * (quarter + 1)];
        const double* below = above + quarter + 1;
        for (size_t column = 0; column < quarter; ++column) {
            const double value = (below[column + 1] - below[column]) - (above[column + 1] - above[column]);
            for (const size_t y : {row, n - 1 - row})
                for (const size_t x : {column, n - 1 - column})
                    solid_angles[y * n + x] = value;
        }
    }
    return solid_angles;
}

FaceAxes face_axes(uint32_t face) {
    // Vulkan's faces; scene/environment.h says the same, and a test compares the two.
    static const FaceAxes axes[6] = {
        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
        {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
        {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
    };
    return axes[face];
}

uint32_t require_texels(const CubeTexels& cube) {
    if (cube.face_size == 0) {
        throw std::invalid_argument("environment: expected one with texels, got an empty one");
    }
    return cube.face_size;
}

} // namespace burnish
