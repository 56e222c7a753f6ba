#include "burnish/light/direct_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/check.h"

namespace burnish {
namespace {

constexpr float HALF_PI = std::numbers::pi_v<float> / 2.0f;
/// A spot's edge is at least this wide, in cosines.
constexpr double LEAST_EDGE = 1e-4;

template <typename... Cases>
struct Match : Cases... {
    using Cases::operator()...;
};

void require_direction(const glm::dvec3& direction) {
    const double length = glm::length(direction);
    if (!(length > 0.0) || !std::isfinite(length))
        throw std::invalid_argument(message("direction: expected finite numbers of a length above 0, got ",
                                            direction.x, ", ", direction.y, ", ", direction.z));
}

void check(const PointLight& light) {
    if (!is_finite(glm::vec3(light.position)))
        throw std::invalid_argument(message("position: expected finite numbers, got ", light.position.x, ", ",
                                            light.position.y, ", ", light.position.z));
    require_non_negative("intensity", light.intensity);
    if (!(light.radius >= 0.0f) || !std::isfinite(light.radius))
        throw std::invalid_argument(message("radius: expected a finite number >= 0, got ", light.radius));
    if (light.range && (!(*light.range > light.radius) || !std::isfinite(*light.range)))
        throw std::invalid_argument(
            message("range: expected a finite number above radius = ", light.radius, ", got ", *light.range));
}

void check(const DirectionalLight& light) {
    require_direction(light.direction);
    require_non_negative("irradiance", light.irradiance);
    if (!(light.angle >= 0.0f && light.angle < 2.0f * HALF_PI))
        throw std::invalid_argument(message("angle: expected radians from 0 to below pi, got ", light.angle));
}

void check(const SpotLight& light) {
    check(light.light);
    require_direction(light.direction);
    if (!(light.outer_angle > 0.0f && light.outer_angle <= HALF_PI))
        throw std::invalid_argument(
            message("outer_angle: expected radians above 0 and up to pi/2, got ", light.outer_angle));
    if (!(light.inner_angle >= 0.0f && light.inner_angle <= light.outer_angle))
        throw std::invalid_argument(message("inner_angle: expected radians from 0 to outer_angle = ",
                                            light.outer_angle, ", got ", light.inner_angle));
}

shared::LightRecord record_of(const PointLight& light, const glm::dvec3& origin) {
    const double end = light.range ? 1.0 / *light.range : 0.0;
    return {glm::vec4(light.position - origin, light.radius), glm::vec4(light.intensity, end * end),
            glm::vec4(0.0f), glm::vec4(0.0f, 1.0f, 0.0f, 0.0f)};
}

shared::LightRecord record_of(const DirectionalLight& light, const glm::dvec3&) {
    return {glm::vec4(-glm::normalize(light.direction), std::sin(0.5 * light.angle)),
            glm::vec4(light.irradiance, 0.0f), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f),
            glm::vec4(0.0f, 1.0f, 0.0f, 0.0f)};
}

shared::LightRecord record_of(const SpotLight& light, const glm::dvec3& origin) {
    shared::LightRecord record = record_of(light.light, origin);
    const double outer = std::cos(light.outer_angle), inner = std::cos(light.inner_angle);
    const double scale = 1.0 / std::max(inner - outer, LEAST_EDGE);
    record.axis = glm::vec4(glm::normalize(light.direction), 0.0f);
    record.cone = glm::vec4(scale, -outer * scale, outer, std::sin(light.outer_angle));
    return record;
}

const glm::vec3& strength(const DirectLight& light) {
    return std::visit(Match{[](const PointLight& one) -> const glm::vec3& { return one.intensity; },
                            [](const DirectionalLight& one) -> const glm::vec3& { return one.irradiance; },
                            [](const SpotLight& one) -> const glm::vec3& { return one.light.intensity; }},
                      light);
}

} // namespace

void validate(const DirectLight& light) {
    std::visit([](const auto& one) { check(one); }, light);
}

const char* kind_name(const DirectLight& light) {
    constexpr const char* NAMES[] = {"point", "directional", "spot"};
    return NAMES[light.index()];
}

bool is_lit(const DirectLight& light) {
    return strength(light) != glm::vec3(0.0f);
}

bool is_bounded(const DirectLight& light) {
    return std::visit(Match{[](const PointLight& one) { return one.range.has_value(); },
                            [](const DirectionalLight&) { return false; },
                            [](const SpotLight&) { return true; }},
                      light);
}

shared::LightRecord record(const DirectLight& light, const glm::dvec3& origin) {
    return std::visit([&](const auto& one) { return record_of(one, origin); }, light);
}

} // namespace burnish
