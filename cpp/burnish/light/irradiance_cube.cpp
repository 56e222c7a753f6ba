#include "burnish/light/irradiance_cube.h"

#include <algorithm>
#include <cmath>

#include "burnish/cores.h"
#include "burnish/light/spherical_harmonics.h"
#include "shared/constants.h"

namespace burnish {
namespace {

constexpr int SIZE = shared::IRRADIANCE_FACE, PITCH = shared::IRRADIANCE_PITCH;
constexpr int CHECK_STEP = 4; ///< texels between the places along a face that are checked

/// Through (u, v) of a face none of whose axes is mirrored: z sees (x, y), y sees (x, z), x sees (z, y).
glm::dvec3 unmirrored_direction(int face, double u, double v) {
    const double side = face % 2 ? -1.0 : 1.0;
    return face < 2 ? glm::dvec3(side, v, u) : face < 4 ? glm::dvec3(u, side, v) : glm::dvec3(u, v, side);
}

double place(double texel) {
    return (2.0 * texel + 1.0) / SIZE - 1.0;
}

/// Index of texel (x, y) of a face, counted without the border.
size_t texel_index(int face, int x, int y) {
    return size_t((face * PITCH + y + 1) * PITCH + x + 1);
}

/// Of the texel that lies as deep inside the neighbouring face as (x, y) is beyond one edge.
size_t neighbour_index(int face, int x, int y) {
    const double deep = 1.0 - 1.0 / SIZE;
    const double u = place(x), v = place(y);
    glm::dvec3 point = unmirrored_direction(face, std::clamp(u, -1.0, 1.0), std::clamp(v, -1.0, 1.0));
    point[face / 2 == 0 ? 0 : face / 2 == 1 ? 1 : 2] *= deep;
    const int axis = std::abs(point.x) == 1.0 ? 0 : std::abs(point.y) == 1.0 ? 1 : 2;
    const int owner = 2 * axis + (point[axis] < 0.0 ? 1 : 0);
    const double right = axis == 0 ? point.z : point.x, down = axis == 2   ? point.y
                                                               : axis == 1 ? point.z
                                                                           : point.y;
    const auto texel = [](double coordinate) { return int((coordinate + 1.0) * 0.5 * SIZE); };
    return texel_index(owner, texel(right), texel(down));
}

void add_border(std::vector<glm::vec4>& texels) {
    for (int face = 0; face < 6; ++face) {
        for (int k = 0; k < SIZE; ++k)
            for (const int beyond : {-1, SIZE}) {
                texels[texel_index(face, beyond, k)] = texels[neighbour_index(face, beyond, k)];
                texels[texel_index(face, k, beyond)] = texels[neighbour_index(face, k, beyond)];
            }
        for (const int y : {-1, SIZE})
            for (const int x : {-1, SIZE}) {
                const int inside_x = std::clamp(x, 0, SIZE - 1), inside_y = std::clamp(y, 0, SIZE - 1);
                texels[texel_index(face, x, y)] =
                    (texels[texel_index(face, inside_x, inside_y)] + texels[texel_index(face, inside_x, y)] +
                     texels[texel_index(face, x, inside_y)]) /
                    3.0f;
            }
    }
}

/// Takes off what a bilinear lookup is too large by on the average.
std::vector<glm::vec4> sharpen(const std::vector<glm::vec4>& exact) {
    std::vector<glm::vec4> texels = exact;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < SIZE; ++y)
            for (int x = 0; x < SIZE; ++x) {
                const glm::vec4 around =
                    exact[texel_index(face, x - 1, y)] + exact[texel_index(face, x + 1, y)] +
                    exact[texel_index(face, x, y - 1)] + exact[texel_index(face, x, y + 1)];
                const size_t here = texel_index(face, x, y);
                texels[here] -= (around - 4.0f * exact[here]) / 12.0f;
            }
    return texels;
}

/// Sums of squares of errors and of values, by solid angle.
struct Squares {
    double error = 0.0, value = 0.0;

    void add(glm::dvec3 exact, glm::dvec3 found, glm::dvec3 direction) {
        const double weight = std::pow(glm::dot(direction, direction), -1.5);
        error += weight * glm::dot(found - exact, found - exact);
        value += weight * glm::dot(exact, exact);
    }
    double relative() const { return value > 0.0 ? std::sqrt(error / value) : 0.0; }
};

double bilinear_error(const CosineSums& light, const std::vector<glm::vec4>& texels) {
    Squares squares;
    for (int face = 0; face < 6; ++face)
        for (int y = CHECK_STEP / 2; y < SIZE; y += CHECK_STEP)
            for (int x = CHECK_STEP / 2; x < SIZE; x += CHECK_STEP) {
                const glm::dvec3 direction = unmirrored_direction(face, place(x - 0.5), place(y - 0.5));
                const glm::vec4 sum = texels[texel_index(face, x - 1, y - 1)] +
                                      texels[texel_index(face, x, y - 1)] +
                                      texels[texel_index(face, x - 1, y)] + texels[texel_index(face, x, y)];
                squares.add(light.irradiance_over_pi(glm::normalize(direction)),
                            glm::max(0.25f * sum, glm::vec4(0.0f)), direction);
            }
    return squares.relative();
}

} // namespace

IrradianceCube make_irradiance_cube(const CosineSums& light) {
    IrradianceCube cube;
    cube.texels.assign(shared::IRRADIANCE_TEXELS, glm::vec4(0.0f));
    for_each_on_cores(size_t{6} * SIZE, true, [&](size_t row) {
        const int face = int(row) / SIZE, y = int(row) % SIZE;
        for (int x = 0; x < SIZE; ++x) {
            const glm::vec3 normal = glm::normalize(unmirrored_direction(face, place(x), place(y)));
            cube.texels[texel_index(face, x, y)] = glm::vec4(light.irradiance_over_pi(normal), 0.0f);
        }
    });
    add_border(cube.texels);
    cube.texels = sharpen(cube.texels);
    add_border(cube.texels);
    cube.error = bilinear_error(light, cube.texels);
    return cube;
}

double harmonics_error(const std::array<glm::dvec3, 9>& coefficients, const IrradianceCube& cube) {
    Squares squares;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < SIZE; ++y)
            for (int x = 0; x < SIZE; ++x) {
                const glm::dvec3 direction = unmirrored_direction(face, place(x), place(y));
                squares.add(glm::max(cube.texels[texel_index(face, x, y)], glm::vec4(0.0f)),
                            irradiance_over_pi(coefficients, glm::normalize(direction)), direction);
            }
    return squares.relative();
}

} // namespace burnish
