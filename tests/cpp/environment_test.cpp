#include "burnish/light/environment.h"
#include "error_message.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;

double texel_solid_angle(uint32_t face_size, uint32_t row, uint32_t column) {
    const auto corner = [&](uint32_t i, uint32_t j) {
        const double u = 2.0 * j / face_size - 1.0;
        const double v = 2.0 * i / face_size - 1.0;
        return std::atan2(u * v, std::sqrt(1.0 + u * u + v * v));
    };
    return corner(row + 1, column + 1) - corner(row, column + 1) - corner(row + 1, column) +
           corner(row, column);
}

// Integral of the first channel over the sphere.
double cube_energy(const Environment& environment) {
    const uint32_t n = environment.face_size();
    double energy = 0.0;
    for (uint32_t face = 0; face < 6; ++face) {
        for (uint32_t row = 0; row < n; ++row) {
            for (uint32_t column = 0; column < n; ++column) {
                energy += texel_solid_angle(n, row, column) *
                          environment.radiance()[3 * ((face * n + row) * n + column)];
            }
        }
    }
    return energy;
}

double lat_long_energy(uint32_t height, uint32_t width, const std::vector<float>& radiance) {
    double energy = 0.0;
    for (uint32_t row = 0; row < height; ++row) {
        const double band =
            std::sin(PI * (0.5 - double(row) / height)) - std::sin(PI * (0.5 - double(row + 1) / height));
        for (uint32_t column = 0; column < width; ++column) {
            energy += band * 2.0 * PI / width * radiance[3 * (row * width + column)];
        }
    }
    return energy;
}

glm::dvec3 lat_long_direction(uint32_t height, uint32_t width, double row, double column) {
    const double latitude = PI * (0.5 - (row + 0.5) / height);
    const double longitude = PI * (1.0 - 2.0 * (column + 0.5) / width);
    return {std::cos(latitude) * std::sin(longitude), std::sin(latitude),
            std::cos(latitude) * std::cos(longitude)};
}

std::vector<float> lat_long_sun(uint32_t height, uint32_t width, const glm::dvec3& center,
                                double diameter_degrees) {
    std::vector<float> radiance(size_t{3} * height * width, 0.01f);
    const double cos_radius = std::cos(0.5 * diameter_degrees * PI / 180.0);
    for (uint32_t row = 0; row < height; ++row) {
        for (uint32_t column = 0; column < width; ++column) {
            if (glm::dot(lat_long_direction(height, width, row, column), center) < 0.998) {
                continue; // far from the sun
            }
            // Coverage by 8 x 8 points: the sun of the map itself is smooth-edged, as a photograph's is.
            int inside = 0;
            for (int i = 0; i < 64; ++i) {
                const double y = row + (i / 8 + 0.5) / 8.0 - 0.5;
                const double x = column + (i % 8 + 0.5) / 8.0 - 0.5;
                inside += glm::dot(lat_long_direction(height, width, y, x), center) > cos_radius ? 1 : 0;
            }
            for (int channel = 0; channel < 3; ++channel) {
                radiance[3 * (row * width + column) + static_cast<uint32_t>(channel)] +=
                    50000.0f * static_cast<float>(inside) / 64.0f;
            }
        }
    }
    return radiance;
}

TEST(LatLong, ConstantMapStaysConstant) {
    for (const uint32_t face_size : {1u, 2u, 4u, 32u, 128u}) {
        for (const auto& [height, width] :
             std::array<std::pair<uint32_t, uint32_t>, 4>{{{1, 1}, {3, 5}, {64, 128}, {77, 150}}}) {
            const std::vector<float> radiance(size_t{3} * height * width, 2.5f);
            const Environment environment = Environment::from_lat_long(height, width, radiance, face_size);
            for (const float value : environment.radiance()) {
                ASSERT_NEAR(value, 2.5f, 1e-6f) << face_size << " from " << height << " x " << width;
            }
        }
    }
}

TEST(LatLong, SunKeepsItsEnergyWhereverItStands) {
    const double seam = 1.0 / std::sqrt(2.0);
    const double corner = 1.0 / std::sqrt(3.0);
    const std::array<glm::dvec3, 9> centers = {{{0, 1, 0},
                                                {0, -1, 0},
                                                {0, 0, -1},
                                                {seam, 0, seam},
                                                {corner, corner, -corner},
                                                {0, seam, seam},
                                                {0.01, 0.99995, 0},
                                                {0.36, 0.48, 0.8},
                                                {-0.6, -0.64, 0.48}}};
    for (const glm::dvec3& center : centers) {
        const std::vector<float> radiance = lat_long_sun(256, 512, glm::normalize(center), 0.5);
        const double expected = lat_long_energy(256, 512, radiance);
        for (const uint32_t face_size : {1u, 8u, 64u, 128u, 512u}) {
            const Environment environment = Environment::from_lat_long(256, 512, radiance, face_size);
            EXPECT_NEAR(cube_energy(environment) / expected, 1.0, 1e-6)
                << "sun at " << center.x << " " << center.y << " " << center.z << ", faces of " << face_size;
        }
    }
}

TEST(LatLong, AxesLandOnTheirFaces) {
    // One lit texel column and row around each axis; longitude falls to the right, 0 in the middle.
    const uint32_t height = 64;
    const uint32_t width = 128;
    const std::array<std::pair<uint32_t, uint32_t>, 6> texels = {
        {{32, 32}, {32, 96}, {0, 0}, {63, 0}, {32, 64}, {32, 0}}};
    for (uint32_t face = 0; face < 6; ++face) {
        std::vector<float> radiance(size_t{3} * height * width, 0.0f);
        for (uint32_t column = 0; column < width; ++column) {
            if (column == texels[face].second || face == 2 || face == 3) {
                radiance[3 * (texels[face].first * width + column)] = 1.0f;
            }
        }
        const Environment environment = Environment::from_lat_long(height, width, radiance, 16);
        for (uint32_t other = 0; other < 6; ++other) {
            float sum = 0.0f;
            for (uint32_t i = 0; i < 16 * 16; ++i) {
                sum += environment.radiance()[3 * (other * 256 + i)];
            }
            EXPECT_EQ(sum > 1e-9f, other == face) // rounding leaves less than that
                << "axis " << face << " on face " << other;
        }
    }
}

TEST(LatLong, TexelMeansAgreeWithBruteForce) {
    const uint32_t height = 24;
    const uint32_t width = 48;
    std::vector<float> radiance(size_t{3} * height * width);
    for (size_t i = 0; i < radiance.size(); ++i) {
        radiance[i] = static_cast<float>((i * 2654435761u) % 1000) / 100.0f;
    }
    const uint32_t n = 8;
    const uint32_t steps = 200;
    const Environment environment = Environment::from_lat_long(height, width, radiance, n);
    for (uint32_t face = 0; face < 6; ++face) {
        for (const uint32_t texel : {0u, 9u, 27u, 36u, 63u}) {
            const uint32_t row = texel / n;
            const uint32_t column = texel % n;
            double sum = 0.0;
            double weight_sum = 0.0;
            for (uint32_t i = 0; i < steps * steps; ++i) {
                const double u = 2.0 * (column + (i % steps + 0.5) / steps) / n - 1.0;
                const double v = 2.0 * (row + (i / steps + 0.5) / steps) / n - 1.0;
                const glm::vec3 d = cube_direction(face, static_cast<float>(u), static_cast<float>(v));
                const double weight = std::pow(1.0 + u * u + v * v, -1.5);
                const double y = (0.5 - std::asin(double(d.y)) / PI) * height;
                const double x = (0.5 - std::atan2(double(d.x), double(d.z)) / (2.0 * PI)) * width;
                const uint32_t source_row = std::min(static_cast<uint32_t>(y), height - 1);
                const uint32_t source_column = std::min(static_cast<uint32_t>(x), width - 1);
                sum += weight * radiance[3 * (source_row * width + source_column) + 1];
                weight_sum += weight;
            }
            EXPECT_NEAR(environment.radiance()[3 * (face * n * n + texel) + 1], sum / weight_sum,
                        0.02) // points err by a step, 1/200, at edges
                << "face " << face << " texel " << texel;
        }
    }
}

TEST(LatLong, BothGridsPutTexelsWhereTheySay) {
    const uint32_t height = 33;
    const uint32_t width = 65;
    for (const LatLongGrid grid : {LatLongGrid::bands, LatLongGrid::samples}) {
        const bool is_bands = grid == LatLongGrid::bands;
        for (const auto& [row, column] :
             std::array<std::pair<uint32_t, uint32_t>, 5>{{{16, 32}, {5, 7}, {0, 3}, {28, 50}, {20, 0}}}) {
            std::vector<float> radiance(size_t{3} * height * width, 0.0f);
            radiance[3 * (row * width + column)] = 1000.0f;
            const Environment environment = Environment::from_lat_long(height, width, radiance, 128, grid);
            glm::dvec3 centroid(0.0);
            for (uint32_t texel = 0; texel < 6 * 128 * 128; ++texel) {
                const uint32_t i = texel / 128 % 128;
                const uint32_t j = texel % 128;
                const glm::dvec3 direction = cube_direction(
                    texel / (128 * 128), (float(j) + 0.5f) / 64.0f - 1.0f, (float(i) + 0.5f) / 64.0f - 1.0f);
                centroid +=
                    direction * texel_solid_angle(128, i, j) * double(environment.radiance()[3 * texel]);
            }
            const double latitude =
                PI * (0.5 - (is_bands ? (row + 0.5) / height : double(row) / (height - 1)));
            const double longitude =
                PI * (1.0 - 2.0 * (is_bands ? (column + 0.5) / width : double(column) / (width - 1)));
            const glm::dvec3 expected(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                                      std::cos(latitude) * std::cos(longitude));
            // A texel is 0.1 wide, the grids are half of that apart; bands at the pole have their centroid
            // off their centre.
            EXPECT_GT(glm::dot(glm::normalize(centroid), expected), std::cos(row == 0 ? 0.04 : 0.005))
                << (is_bands ? "bands " : "samples ") << row << ", " << column;
        }
    }
    const std::vector<float> constant(size_t{3} * height * width, 2.5f);
    const Environment flat = Environment::from_lat_long(height, width, constant, 16, LatLongGrid::samples);
    for (const float value : flat.radiance()) {
        ASSERT_NEAR(value, 2.5f, 1e-6f);
    }
}

TEST(Environment, FaultyTexelsAreCountedAndRepaired) {
    std::vector<float> radiance(size_t{6} * 4 * 3, 1.0f);
    radiance[0] = std::numeric_limits<float>::quiet_NaN();
    radiance[1] = -1.0f; // the same texel: counts once
    radiance[3] = std::numeric_limits<float>::infinity();
    radiance[6] = -std::numeric_limits<float>::infinity();
    radiance[9] = 1e6f;
    radiance[12] = -0.5f;
    const Environment environment = Environment::from_faces(2, radiance);
    const TexelReport& report = environment.texel_report();
    EXPECT_EQ(report.not_a_number, 1u);
    EXPECT_EQ(report.infinite, 2u);
    EXPECT_EQ(report.above_half, 1u);
    EXPECT_EQ(report.negative, 1u);
    EXPECT_EQ(report.count(), 4u);
    EXPECT_EQ(report.largest, 1e6f);
    EXPECT_EQ(environment.radiance()[0], 0.0f);
    EXPECT_EQ(environment.radiance()[1], 0.0f);
    EXPECT_EQ(environment.radiance()[2], 1.0f);
    EXPECT_EQ(environment.radiance()[3], HALF_MAX);
    EXPECT_EQ(environment.radiance()[6], 0.0f);
    EXPECT_EQ(environment.radiance()[9], 1e6f);
    EXPECT_EQ(environment.radiance()[12], 0.0f);
    EXPECT_EQ(report.sentence().find("half range"), std::string::npos) << report.sentence();
    EXPECT_EQ(TexelReport{}.sentence(), "");
}

TEST(Environment, FindsAFaultWhereverItLies) {
    constexpr size_t COUNT = size_t{6} * 32 * 32 * 3;
    for (const size_t at : {size_t{0}, size_t{1535}, size_t{1536}, COUNT - 1}) {
        std::vector<float> radiance(COUNT, 0.5f);
        radiance[at] = -3.0f;
        radiance[COUNT / 2] = 7.0f;
        const Environment environment = Environment::from_faces(32, radiance);
        EXPECT_EQ(environment.texel_report().negative, 1u) << "value " << at;
        EXPECT_EQ(environment.texel_report().count(), 1u) << "value " << at;
        EXPECT_EQ(environment.texel_report().largest, 7.0f) << "value " << at;
        EXPECT_EQ(environment.radiance()[at], 0.0f) << "value " << at;
    }
}

// Its bits are those of no half in range: they once became a radiance of 2.
TEST(Environment, MinusZeroIsBlackAndNoFault) {
    const Environment environment = Environment::from_faces(1, std::vector<float>(18, -0.0f));
    EXPECT_EQ(environment.texel_report().count(), 0u);
    for (size_t k = 0; k < 24; ++k)
        EXPECT_EQ(environment.half_rgba()[k], k % 4 == 3 ? 0x3C00u : 0u) << "half " << k;
}

TEST(Environment, FaceSizeErrorNamesTheNearest) {
    EXPECT_EQ(message_of([] { Environment::from_faces(100, std::vector<float>(size_t{6} * 100 * 100 * 3)); }),
              "face_size: expected a power of two in 1..2048, got 100 (nearest: 64 or 128)");
    EXPECT_THROW(require_face_size(0), std::invalid_argument);
    EXPECT_THROW(require_face_size(4096), std::invalid_argument);
    EXPECT_NO_THROW(require_face_size(1));
    EXPECT_NO_THROW(require_face_size(2048));
}

TEST(Environment, HalvesAreTheNearestEven) {
    std::vector<float> radiance(size_t{6} * 64 * 64 * 3);
    for (size_t i = 0; i < radiance.size();
         ++i) { // every exponent of a half and its subnormals, many mantissas
        radiance[i] =
            std::ldexp(1.0f + static_cast<float>((i * 7919) % 8192) / 8192.0f, static_cast<int>(i % 42) - 27);
    }
    radiance[0] = 0.0f;
    radiance[1] = HALF_MAX;
    radiance[2] = 1.0f + 1.0f / 2048.0f; // halfway: to even
    const Environment environment = Environment::from_faces(64, radiance);
    const std::vector<uint16_t> half = environment.half_rgba();
    for (size_t i = 0; i < radiance.size(); ++i) {
        const float value = environment.radiance()[i];
        const uint16_t bits = half[4 * (i / 3) + i % 3];
        int exponent = 0;
        std::frexp(value, &exponent);
        const double step = std::ldexp(1.0, std::max(exponent - 11, -24));
        const double expected =
            std::nearbyint(double(value) / step) * step; // to even, in the default rounding mode
        const int half_exponent = bits >> 10;
        const double decoded = half_exponent == 0 ? std::ldexp(bits & 1023, -24)
                                                  : std::ldexp(1024 + (bits & 1023), half_exponent - 25);
        ASSERT_EQ(decoded, expected) << value;
    }
    EXPECT_EQ(half[3], 0x3C00);
    EXPECT_EQ(half[1], 0x7BFF);
    EXPECT_EQ(half[2], 0x3C00);
}

TEST(Cube, DirectionAndFaceAreInverse) {
    for (uint32_t face = 0; face < 6; ++face) {
        for (const float a : {-0.99f, -0.3f, 0.0f, 0.7f}) {
            float u = 0.0f;
            float v = 0.0f;
            EXPECT_EQ(cube_face(2.0f * cube_direction(face, a, 0.5f * a + 0.1f), u, v), face);
            EXPECT_NEAR(u, a, 1e-6f);
            EXPECT_NEAR(v, 0.5f * a + 0.1f, 1e-6f);
        }
    }
}

} // namespace
} // namespace burnish
