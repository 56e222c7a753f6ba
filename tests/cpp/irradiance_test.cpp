// Diffuse light: cosine sums over a map's texels, and the cube of them.
#include "burnish/light/irradiance_cube.h"
#include "burnish/light/spherical_harmonics.h"
#include "error_message.h"
#include "made_environments.h"
#include "shared/constants.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace burnish {
namespace {

CosineSums sums_of(const Environment& environment) {
    return CosineSums({environment.face_size(), environment.radiance()});
}

std::vector<glm::dvec3> some_normals(uint32_t seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> normals = {{1, 0, 0}, {0, -1, 0}, glm::normalize(glm::dvec3(1, 1, 1))};
    for (int k = 0; k < 40; ++k)
        normals.push_back(
            glm::normalize(glm::dvec3(normal(generator), normal(generator), normal(generator))));
    return normals;
}

/// The sum itself, every texel split into parts x parts.
glm::dvec3 sum_texels(const Environment& environment, const glm::dvec3& normal, uint32_t parts) {
    const uint32_t size = environment.face_size() * parts;
    const std::vector<double> solid_angles = texel_solid_angles(size);
    glm::dvec3 sum(0.0);
    for (uint32_t face = 0; face < 6; ++face) {
        const FaceAxes axes = face_axes(face);
        for (uint32_t y = 0; y < size; ++y)
            for (uint32_t x = 0; x < size; ++x) {
                const glm::dvec3 direction =
                    glm::normalize(axes.axis + ((2.0 * x + 1.0) / size - 1.0) * axes.right +
                                   ((2.0 * y + 1.0) / size - 1.0) * axes.down);
                const size_t texel =
                    (size_t{face} * environment.face_size() + y / parts) * environment.face_size() +
                    x / parts;
                const float* rgb = environment.radiance().data() + 3 * texel;
                sum += std::max(0.0, glm::dot(direction, normal)) * solid_angles[size_t{y} * size + x] *
                       glm::dvec3(rgb[0], rgb[1], rgb[2]);
            }
    }
    return sum / std::numbers::pi;
}

TEST(CosineSums, AreThoseOverEveryTexel) {
    // Texels of 2^-12 to 2^9: some stand for suns. Coarse maps are split, fine ones gathered.
    for (const uint32_t face_size : {1u, 4u, 64u, 128u}) {
        const auto environment = random_environment(face_size, 7);
        const CosineSums sums = sums_of(*environment);
        const std::vector<glm::dvec3> normals = some_normals(face_size);
        std::vector<glm::dvec3> exact;
        glm::dvec3 mean(0.0);
        for (const glm::dvec3& normal : normals) {
            exact.push_back(sum_texels(*environment, normal, std::max(1u, 256u / face_size)));
            mean += exact.back() / double(normals.size());
        }
        for (size_t n = 0; n < normals.size(); ++n)
            for (int k = 0; k < 3; ++k) // where the brightest texel sets, most of the rest is dark
                EXPECT_NEAR(sums.irradiance_over_pi(normals[n])[k], exact[n][k],
                            3e-4 * exact[n][k] + 1e-4 * mean[k])
                    << face_size << ", channel " << k;
    }
}

TEST(CosineSums, SeeASunWhereItStands) {
    // One texel of a large map, anywhere in its cell, down to where it sets: the cosine to within a texel.
    const uint32_t face_size = 512;
    std::vector<float> faces(size_t{6} * face_size * face_size * 3, 0.0f);
    faces[3 * ((size_t{4} * face_size + 101) * face_size + 303)] = 60000.0f;
    const auto environment = Environment::from_faces(face_size, std::move(faces));
    const glm::dvec3 sun =
        glm::normalize(glm::dvec3(2.0 * 303 + 1 - face_size, face_size - 2.0 * 101 - 1, face_size));
    const double flux = 60000.0 * texel_solid_angles(face_size)[101 * face_size + 303] / std::numbers::pi;
    const CosineSums sums = sums_of(environment);
    const glm::dvec3 side = glm::normalize(glm::cross(sun, glm::dvec3(0.3, 0.5, 0.8)));
    for (const double degrees : {0.0, 30.0, 80.0, 89.5, 90.0, 90.5, 140.0}) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const glm::dvec3 normal = std::cos(angle) * sun + std::sin(angle) * side;
        EXPECT_NEAR(sums.irradiance_over_pi(normal).r, flux * std::max(0.0, std::cos(angle)), 1e-4 * flux);
    }
}

TEST(CosineSums, RefuseAnEmptyEnvironment) {
    EXPECT_EQ(message_of([] { CosineSums{CubeTexels()}; }),
              "environment: expected one with texels, got an empty one");
}

TEST(IrradianceCube, IsConstantUnderConstantLightBordersIncluded) {
    const auto environment = environment_of(32, [](const glm::dvec3&) { return glm::dvec3(1.0, 2.0, 0.0); });
    const IrradianceCube cube = make_irradiance_cube(sums_of(*environment));
    ASSERT_EQ(cube.texels.size(), shared::IRRADIANCE_TEXELS);
    for (const glm::vec4& texel : cube.texels)
        EXPECT_LT(glm::distance(texel, glm::vec4(1.0f, 2.0f, 0.0f, 0.0f)), 5e-4f);
    EXPECT_LT(cube.error, 2e-4);
}

// Light that grows along one axis has irradiance that grows along it, over the edges too.
TEST(IrradianceCube, BordersLieInTheNeighbouringFace) {
    constexpr int pitch = shared::IRRADIANCE_PITCH, size = shared::IRRADIANCE_FACE;
    const auto environment =
        environment_of(64, [](const glm::dvec3& d) { return 2.0 + glm::dvec3(d.x, d.y, d.z); });
    const IrradianceCube cube = make_irradiance_cube(sums_of(*environment));
    for (int face = 0; face < 6; ++face)
        for (int y = -1; y <= size; ++y)
            for (int x = -1; x <= size; ++x) {
                const bool is_corner = (x < 0 || x == size) && (y < 0 || y == size);
                const double u = (2.0 * x + 1.0) / size - 1.0, v = (2.0 * y + 1.0) / size - 1.0;
                const double side = face % 2 ? -1.0 : 1.0;
                const glm::dvec3 normal = glm::normalize(face < 2   ? glm::dvec3(side, v, u)
                                                         : face < 4 ? glm::dvec3(u, side, v)
                                                                    : glm::dvec3(u, v, side));
                const glm::vec4 texel = cube.texels[size_t((face * pitch + y + 1) * pitch + x + 1)];
                const glm::dvec3 expected = 2.0 + 2.0 / 3.0 * normal;
                // A neighbour's texel lies as deep inside, a border's as far outside: a little apart.
                const double allowed = is_corner                                  ? 0.04
                                       : x < 0 || y < 0 || x == size || y == size ? 0.025
                                                                                  : 1e-3;
                EXPECT_LT(glm::distance(glm::dvec3(glm::vec3(texel)), expected), allowed)
                    << "face " << face << ", " << x << ", " << y;
            }
}

TEST(IrradianceCube, TellsHowWrongNineHarmonicsAre) {
    // Light of degree two is theirs; under a lamp they ring.
    const auto smooth =
        environment_of(64, [](const glm::dvec3& d) { return glm::dvec3(2.0 + d.x * d.y + d.z); });
    const auto lamp =
        environment_of(64, [](const glm::dvec3& d) { return glm::dvec3(d.z > 0.99 ? 500.0 : 0.0); });
    const auto error = [](const Environment& environment) {
        const CubeTexels texels{environment.face_size(), environment.radiance()};
        return harmonics_error(irradiance_over_pi_coefficients(texels),
                               make_irradiance_cube(CosineSums(texels)));
    };
    EXPECT_LT(error(*smooth), 3e-4);
    // The bands from four on hold .0884 of max(0, z); the lamp's width and the clamp at 0 leave less.
    EXPECT_GT(error(*lamp), 0.06);
    EXPECT_LT(error(*lamp), 0.0884);
}

} // namespace
} // namespace burnish
