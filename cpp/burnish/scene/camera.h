// A pinhole or orthographic camera, glTF's conventions: it looks along its own -z, y up.
#pragma once

#include <string>

#include <glm/glm.hpp>

namespace burnish {

struct Camera {
    std::string name;
    glm::dmat4 world_from_camera{1.0}; ///< rigid: rotation and translation only
    bool is_orthographic = false;
    float vertical_fov = 0.8f; ///< radians, in (0, pi); perspective only
    float half_height = 1.0f;  ///< > 0; orthographic only
    float near_plane = 0.01f;  ///< > 0 for perspective; the far plane is at infinity (reverse z)
    float far_plane = 1000.0f; ///< orthographic only
};

/// A perspective camera at `eye` that looks at `target`, `up` upward in its picture.
/// Throws std::invalid_argument where the three do not span a view.
Camera look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

/// Throws std::invalid_argument, naming field, rule and value, unless every number is in its documented
/// range.
void validate(const Camera& camera);

} // namespace burnish
