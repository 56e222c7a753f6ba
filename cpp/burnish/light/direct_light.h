// Lights that are not part of an environment: each kind is a struct, and a name in a list.
#pragma once

#include <optional>
#include <variant>

#include <glm/glm.hpp>

#include "shared/records.h"

namespace burnish {

/// A sphere that radiates evenly, or a point: irradiance across its way is intensity/d^2.
struct PointLight {
    glm::dvec3 position{0.0};
    glm::vec3 intensity{1.0f};  ///< W/sr, >= 0
    float radius = 0.0f;        ///< >= 0; lobes show a highlight of that size
    std::optional<float> range; ///< > radius: times max(1 - (d/range)^4, 0), nothing beyond; none: no end
};

/// Light from far away.
struct DirectionalLight {
    glm::dvec3 direction{0.0, -1.0, 0.0}; ///< where it goes, of any length but 0
    glm::vec3 irradiance{1.0f};           ///< across its way, W/m^2, >= 0
    float angle = 0.0f;                   ///< that its disc is seen under, radians, in [0, pi)
};

/// A point light that shines into a cone: times clamp((cos - cos outer)/(cos inner - cos outer), 0, 1)^2.
struct SpotLight {
    PointLight light;
    glm::dvec3 direction{0.0, -1.0, 0.0}; ///< its axis, where it shines, of any length but 0
    float inner_angle = 0.0f;             ///< from the axis, radians, in [0, outer_angle]
    float outer_angle = 0.785398163f;     ///< in (0, pi/2]
};

using DirectLight = std::variant<PointLight, DirectionalLight, SpotLight>;

/// Throws std::invalid_argument, naming field, range and value.
void validate(const DirectLight& light);
/// For reports: "point", "directional" or "spot".
const char* kind_name(const DirectLight& light);
/// It gives some light.
bool is_lit(const DirectLight& light);
/// It ends somewhere: there are places that it does not reach.
bool is_bounded(const DirectLight& light);
/// Kernels read this of it; places are relative to `origin`.
shared::LightRecord record(const DirectLight& light, const glm::dvec3& origin);

} // namespace burnish
