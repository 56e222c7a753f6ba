#include "burnish/scene/camera.h"

#include <stdexcept>

#include "burnish/scene/check.h"

namespace burnish {

Camera look_at(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up) {
    if (!is_finite(eye) || !is_finite(target) || !is_finite(up))
        throw std::invalid_argument("eye, target, up: expected finite numbers, got a non-finite one");
    glm::dvec3 backward = glm::dvec3(eye) - glm::dvec3(target);
    double distance = glm::length(backward);
    if (!(distance > 0.0))
        throw std::invalid_argument("target: expected a point other than eye, got the same point");
    backward /= distance;
    glm::dvec3 right = glm::cross(glm::dvec3(up), backward);
    double sine = glm::length(right);
    if (!(sine > 1e-6 * glm::length(glm::dvec3(up))))
        throw std::invalid_argument("up: expected a direction across the view, got one along it or zero");
    right /= sine;
    Camera camera;
    camera.world_from_camera =
        glm::mat4(glm::vec4(glm::vec3(right), 0.0f), glm::vec4(glm::vec3(glm::cross(backward, right)), 0.0f),
                  glm::vec4(glm::vec3(backward), 0.0f), glm::vec4(eye, 1.0f));
    return camera;
}

void validate(const Camera& camera) {
    const glm::mat4& m = camera.world_from_camera;
    glm::mat3 rotation(m);
    glm::mat3 product = glm::transpose(rotation) * rotation;
    bool is_rigid = is_finite(m) && m[0].w == 0.0f && m[1].w == 0.0f && m[2].w == 0.0f && m[3].w == 1.0f &&
                    glm::determinant(rotation) > 0.0f;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            is_rigid = is_rigid && std::abs(product[column][row] - (row == column ? 1.0f : 0.0f)) < 1e-3f;
    if (!is_rigid)
        throw std::invalid_argument(
            "world_from_camera: expected a rotation and a translation, got another matrix");
    if (camera.is_orthographic) {
        require_positive("half_height", camera.half_height);
        if (!std::isfinite(camera.near_plane))
            throw std::invalid_argument(
                message("near_plane: expected a finite number, got ", camera.near_plane));
        if (!(camera.far_plane > camera.near_plane) || !std::isfinite(camera.far_plane))
            throw std::invalid_argument(message("far_plane: expected a finite number above near_plane = ",
                                                camera.near_plane, ", got ", camera.far_plane));
    } else {
        if (!(camera.vertical_fov > 0.0f && camera.vertical_fov < 3.14159265f))
            throw std::invalid_argument(
                message("vertical_fov: expected radians between 0 and pi, got ", camera.vertical_fov));
        require_positive("near_plane", camera.near_plane);
    }
}

} // namespace burnish
