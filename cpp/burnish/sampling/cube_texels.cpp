#include "burnish/sampling/cube_texels.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace burnish {

std::vector<double> texel_solid_angles(uint32_t face_size) {
    // The integral of du dv / (1 + u^2 + v^2)^(3/2) from (0, 0) is atan(u v / sqrt(1 + u^2 + v^2)): a
    // rectangle is its mixed difference.
    const auto corner_row = [&](uint32_t row) {
        const double v = 2.0 * row / face_size - 1.0;
        std::vector<double> corners(face_size + 1);
        for (uint32_t column = 0; column <= face_size; ++column) {
            const double u = 2.0 * column / face_size - 1.0;
            corners[column] = std::atan2(u * v, std::sqrt(1.0 + u * u + v * v));
        }
        return corners;
    };
    std::vector<double> solid_angles(size_t{face_size} * face_size);
    std::vector<double> above = corner_row(0);
    for (uint32_t row = 0; row < (face_size + 1) / 2; ++row) {
        const std::vector<double> below = corner_row(row + 1);
        for (uint32_t column = 0; column < face_size; ++column) {
            const double value = (below[column + 1] - below[column]) - (above[column + 1] - above[column]);
            solid_angles[size_t{row} * face_size + column] = value;
            solid_angles[size_t{face_size - 1 - row} * face_size + column] = value;
        }
        above = below;
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
