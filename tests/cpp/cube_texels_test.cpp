// What is summed over a cube's texels: solid angles, harmonics, tables to draw them by.
#include "burnish/light/cube_texels.h"
#include "burnish/light/spherical_harmonics.h"
#include "burnish/light/texel_alias.h"
#include "error_message.h"
#include "made_environments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;

TEST(CubeTexels, FaceAxesAreThoseOfTheEnvironment) {
    for (uint32_t face = 0; face < 6; ++face) {
        const FaceAxes axes = face_axes(face);
        const glm::dvec3 direction = glm::normalize(axes.axis + 0.5 * axes.right - 0.25 * axes.down);
        EXPECT_LT(glm::length(direction - glm::dvec3(cube_direction(face, 0.5f, -0.25f))), 1e-6)
            << "face " << face;
    }
}

TEST(CubeTexels, FillTheSphere) {
    for (const uint32_t face_size : {1u, 2u, 64u, 2048u}) {
        const std::vector<double> solid_angles = texel_solid_angles(face_size);
        EXPECT_NEAR(6.0 * std::accumulate(solid_angles.begin(), solid_angles.end(), 0.0), 4.0 * PI, 1e-9);
        // At a point of the face it is area / r^3; the texel in the corner of a large map is nearly one.
        if (face_size == 2048) {
            EXPECT_NEAR(solid_angles[0] * face_size * face_size / 4.0, std::pow(3.0, -1.5), 2e-4);
        }
    }
    for (uint32_t face = 0; face < 6; ++face) {
        const FaceAxes axes = face_axes(face);
        const glm::vec3 expected = cube_direction(face, 0.25f, -0.5f);
        EXPECT_NEAR(glm::distance(glm::normalize(axes.axis + 0.25 * axes.right - 0.5 * axes.down),
                                  glm::dvec3(expected)),
                    0.0, 1e-7);
    }
}

// One function for each coefficient, orthogonal to the others: constant, y, z, x, xy, yz, 3z^2-1, xz,
// x^2-y^2.
TEST(SphericalHarmonics, FindEachHarmonicInItsPlace) {
    using Function = double (*)(const glm::dvec3&);
    const Function functions[9] = {
        [](const glm::dvec3&) { return 1.0; },
        [](const glm::dvec3& d) { return d.y; },
        [](const glm::dvec3& d) { return d.z; },
        [](const glm::dvec3& d) { return d.x; },
        [](const glm::dvec3& d) { return d.x * d.y; },
        [](const glm::dvec3& d) { return d.y * d.z; },
        [](const glm::dvec3& d) { return 3.0 * d.z * d.z - 1.0; },
        [](const glm::dvec3& d) { return d.x * d.z; },
        [](const glm::dvec3& d) { return d.x * d.x - d.y * d.y; },
    };
    const double normalization[9] = {0.28209479177387814, 0.4886025119029199, 0.4886025119029199,
                                     0.4886025119029199,  1.0925484305920792, 1.0925484305920792,
                                     0.31539156525252005, 1.0925484305920792, 0.5462742152960396};
    const double cosine_over_pi[9] = {1.0, 2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25, 0.25, 0.25, 0.25, 0.25};
    for (int k = 0; k < 9; ++k) {
        // Radiance 3 + f is never negative; a channel each for it, for twice it and for the constant.
        const auto environment = environment_of(128, [&](const glm::dvec3& d) {
            return glm::dvec3(3.0 + functions[k](d), 6.0 + 2.0 * functions[k](d), 3.0);
        });
        const std::array<glm::dvec3, 9> found =
            irradiance_over_pi_coefficients({environment->face_size(), environment->radiance()});
        for (size_t j = 0; j < 9; ++j) {
            const double constant = j == 0 ? 3.0 / normalization[0] : 0.0;
            const double own = j == size_t(k) ? cosine_over_pi[j] / normalization[j] : 0.0;
            EXPECT_NEAR(found[j].r, constant + own, 2e-4) << "function " << k << ", coefficient " << j;
            EXPECT_NEAR(found[j].g, 2.0 * (constant + own), 4e-4);
            EXPECT_NEAR(found[j].b, constant, 1e-6); // only the rounding of the solid angles is left
        }
    }
}

// Light of one hemisphere in proportion to the cosine: its coefficients are the cosine lobe's own, A_l
// Y_l0(z), so that irradiance takes the lobe's factors twice.
TEST(SphericalHarmonics, AgreeWithTheCosineLobe) {
    for (const uint32_t face_size : {64u, 256u}) { // without and with threads
        const auto environment =
            environment_of(face_size, [](const glm::dvec3& d) { return glm::dvec3(std::max(d.z, 0.0)); });
        const std::array<glm::dvec3, 9> found =
            irradiance_over_pi_coefficients({environment->face_size(), environment->radiance()});
        const double tolerance = 2.0 / (face_size * face_size); // midpoint rule over texels
        EXPECT_NEAR(found[0].r, PI * PI / PI * std::sqrt(1.0 / (4.0 * PI)), tolerance);
        EXPECT_NEAR(found[2].r, (2.0 * PI / 3.0) * (2.0 / 3.0) * std::sqrt(3.0 / (4.0 * PI)), tolerance);
        EXPECT_NEAR(found[6].r, (PI / 4.0) * (1.0 / 4.0) * std::sqrt(5.0 / (4.0 * PI)), tolerance);
        for (const size_t zero : {1u, 3u, 4u, 5u, 7u, 8u})
            EXPECT_NEAR(found[zero].r, 0.0, 1e-9);
    }
}

TEST(SphericalHarmonics, RefuseAnEmptyEnvironment) {
    EXPECT_EQ(message_of([] { irradiance_over_pi_coefficients(CubeTexels()); }),
              "environment: expected one with texels, got an empty one");
}

// What build_texel_alias aims at, from its description.
std::vector<double> expected_probabilities(const Environment& environment) {
    const int size = int(environment.face_size());
    const std::vector<double> solid_angles = texel_solid_angles(environment.face_size());
    std::vector<double> light;
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < size; ++row) {
            for (int column = 0; column < size; ++column) {
                double sum = 0.0;
                for (int i = -1; i <= 1; ++i) {
                    for (int j = -1; j <= 1; ++j) {
                        const int y = std::clamp(row + i, 0, size - 1),
                                  x = std::clamp(column + j, 0, size - 1);
                        const float* rgb =
                            &environment.radiance()[size_t(3 * ((face * size + y) * size + x))];
                        sum += 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
                    }
                }
                light.push_back(sum / 9.0 * solid_angles[size_t(row * size + column)]);
            }
        }
    }
    const double total = std::accumulate(light.begin(), light.end(), 0.0);
    for (size_t texel = 0; texel < light.size(); ++texel) {
        const double by_angle = solid_angles[texel % solid_angles.size()] / (4.0 * PI);
        light[texel] = total > 0.0 ? 0.95 * light[texel] / total + 0.05 * by_angle : by_angle;
    }
    return light;
}

void expect_draws_its_probabilities(const Environment& environment) {
    const std::vector<shared::TexelAlias> table =
        build_texel_alias({environment.face_size(), environment.radiance()});
    const std::vector<double> expected = expected_probabilities(environment);
    ASSERT_EQ(table.size(), expected.size());
    std::vector<double> drawn(table.size());
    for (size_t entry = 0; entry < table.size(); ++entry) {
        ASSERT_GE(table[entry].threshold, 0.0f);
        ASSERT_LE(table[entry].threshold, 1.0f);
        ASSERT_LT(table[entry].alias, table.size());
        drawn[entry] += double(table[entry].threshold) / double(table.size());
        drawn[table[entry].alias] += (1.0 - double(table[entry].threshold)) / double(table.size());
    }
    double sum = 0.0;
    for (size_t texel = 0; texel < table.size(); ++texel) {
        sum += double(table[texel].probability);
        ASSERT_NEAR(drawn[texel] / expected[texel], 1.0, 1e-6) << "texel " << texel;
        ASSERT_NEAR(double(table[texel].probability) / drawn[texel], 1.0, 1e-7) << "texel " << texel;
    }
    EXPECT_NEAR(sum, 1.0, 1e-7);
}

TEST(TexelAlias, DrawsTexelsInProportionToTheirLight) {
    for (const uint32_t face_size : {1u, 2u, 16u, 128u}) {
        expect_draws_its_probabilities(*random_environment(face_size, face_size));
    }
}

TEST(TexelAlias, DrawsASingleSunAndABlackSky) {
    std::vector<float> faces(size_t{6} * 64 * 64 * 3, 1e-4f);
    faces[3 * 12345 + 1] = 65504.0f;
    expect_draws_its_probabilities(Environment::from_faces(64, faces));
    expect_draws_its_probabilities(Environment::from_faces(64, std::vector<float>(faces.size(), 0.0f)));
    expect_draws_its_probabilities(Environment::from_faces(64, std::vector<float>(faces.size(), 1.0f)));
}

TEST(TexelAlias, RefusesAnEmptyEnvironment) {
    EXPECT_EQ(message_of([] { build_texel_alias(CubeTexels()); }),
              "environment: expected one with texels, got an empty one");
}

} // namespace
} // namespace burnish
