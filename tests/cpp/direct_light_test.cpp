// Records of direct lights, and which of them end somewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "burnish/light/direct_light.h"

namespace burnish {
namespace {

TEST(DirectLight, PlacesAreRelativeToTheOriginInDouble) {
    PointLight light;
    light.position = {1e8 + 0.25, 2.0, -1e8};
    light.range = 4.0f;
    const shared::LightRecord point = record(light, {1e8, 0.0, -1e8});
    EXPECT_EQ(glm::vec3(point.place), glm::vec3(0.25f, 2.0f, 0.0f));
    EXPECT_FLOAT_EQ(point.intensity.w, 1.0f / 16.0f);
    EXPECT_EQ(point.axis.w, 0.0f);
}

TEST(DirectLight, ASpotFallsFromItsInnerToItsOuterAngle) {
    SpotLight spot;
    spot.direction = {0.0, 0.0, -3.0};
    spot.inner_angle = 0.3f;
    spot.outer_angle = 0.6f;
    const shared::LightRecord made = record(spot, glm::dvec3(0.0));
    const auto share = [&](double angle) { return made.cone.x * std::cos(angle) + made.cone.y; };
    EXPECT_EQ(glm::vec3(made.axis), glm::vec3(0.0f, 0.0f, -1.0f));
    EXPECT_NEAR(share(0.3), 1.0, 1e-6);
    EXPECT_NEAR(share(0.6), 0.0, 1e-6);
    EXPECT_NEAR(made.cone.w / made.cone.z, std::tan(0.6), 1e-6);
}

TEST(DirectLight, OnlyLightsWithAnEndAreBounded) {
    PointLight ending;
    ending.range = 2.0f;
    EXPECT_FALSE(is_bounded(PointLight{}));
    EXPECT_TRUE(is_bounded(ending));
    EXPECT_TRUE(is_bounded(SpotLight{}));
    EXPECT_FALSE(is_bounded(DirectionalLight{}));
    ending.intensity = glm::vec3(0.0f);
    EXPECT_FALSE(is_lit(ending));
}

TEST(DirectLight, NumbersOutOfRangeAreRefused) {
    PointLight point;
    point.range = 0.0f;
    EXPECT_THROW(validate(point), std::invalid_argument);
    SpotLight spot;
    spot.outer_angle = 2.0f;
    EXPECT_THROW(validate(spot), std::invalid_argument);
    EXPECT_THROW(validate(DirectionalLight{.direction = {}, .irradiance = {}, .angle = 0.0f}),
                 std::invalid_argument);
}

} // namespace
} // namespace burnish
