#include "burnish/scene/camera.h"

#include <stdexcept>

#include "burnish/check.h"

namespace burnish {

Camera look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    if (!is_finite(glm::vec3(eye)) || !is_finite(glm::vec3(target)) || !is_finite(glm::vec3(up)))
        throw std::invalid_argument("eye, target, up: expected finite numbers, got a non-finite one");
    glm::dvec3 backward = eye - target;
    double distance = glm::length(backward);
    if (!(distance > 0.0))
        throw std::invalid_argument("target: expected a point other than eye, got the same point");
    backward /= distance;
    glm::dvec3 right = glm::cross(up, backward);
    double sine = glm::length(right);
    if (!(sine > 1e-6 * glm::length(up)))
        throw std::invalid_argument("up: expected a direction across the view, got one along it or zero");
    right /= sine;
    Camera camera;
    camera.world_from_camera =
        glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(backward, right), 0.0),
                   glm::dvec4(backward, 0.0), glm::dvec4(eye, 1.0));
    return camera;
}

void validate(const Camera& camera) {
    const glm::dmat4& m = camera.world_from_camera;
    glm::dmat3 rotation(m);
    glm::dmat3 product = glm::transpose(rotation) * rotation;
    bool is_rigid = is_finite(glm::mat4(m)) && m[0].w == 0.0 && m[1].w == 0.0 && m[2].w == 0.0 &&
                    m[3].w == 1.0 && glm::determinant(rotation) > 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            is_rigid = is_rigid && std::abs(product[column][row] - (row == column ? 1.0 : 0.0)) < 1e-3;
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
