#include "burnish/render/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burnish::render {
namespace {

/// Half of what the picture covers: of a pinhole camera at a distance of 1.
glm::vec2 half_extent(const Camera& camera, uint32_t width, uint32_t height) {
    const float half_height =
        camera.is_orthographic ? camera.half_height : std::tan(0.5f * camera.vertical_fov);
    return {half_height * (float(width) / float(height)), half_height};
}

} // namespace

shared::ViewRecord make_view(const Camera& camera, uint32_t width, uint32_t height, glm::vec2 jitter_px) {
    const glm::dmat3 world_axes(camera.world_from_camera);
    const glm::mat3 rotation(world_axes);
    const glm::vec2 half = half_extent(camera, width, height);

    // Vulkan's clip space: y down, depth 1 at the near plane and 0 far away, where float has the most digits
    // left.
    glm::mat4 clip(0.0f);
    clip[0][0] = 1.0f / half.x;
    clip[1][1] = -1.0f / half.y;
    if (camera.is_orthographic) {
        const float range = camera.far_plane - camera.near_plane;
        clip[2][2] = 1.0f / range;
        clip[3][2] = camera.far_plane / range;
        clip[3][3] = 1.0f;
    } else {
        clip[3][2] = camera.near_plane;
        clip[2][3] = -1.0f;
    }
    glm::mat4 shift(1.0f);
    shift[3][0] = -2.0f * jitter_px.x / float(width);
    shift[3][1] = -2.0f * jitter_px.y / float(height);

    shared::ViewRecord view{};
    // The eye is the origin: a far camera's translation would eat the digits of a small scene.
    view.clip_from_world =
        glm::mat4(glm::dmat4(shift) * glm::dmat4(clip) * glm::inverse(glm::dmat4(world_axes)));
    const glm::vec3 right =
        camera.is_orthographic ? glm::vec3(0.0f) : rotation[0] * (2.0f * half.x / float(width));
    const glm::vec3 down =
        camera.is_orthographic ? glm::vec3(0.0f) : rotation[1] * (-2.0f * half.y / float(height));
    const glm::vec3 corner =
        camera.is_orthographic ? -rotation[2] : -half.x * rotation[0] + half.y * rotation[1] - rotation[2];
    view.ray_corner = glm::vec4(corner + jitter_px.x * right + jitter_px.y * down, 0.0f);
    view.ray_dx = glm::vec4(right, 0.0f);
    view.ray_dy = glm::vec4(down, 0.0f);
    glm::dmat4 place = world_from_picture(camera, width, height);
    place[3] += double(jitter_px.x) * place[0] + double(jitter_px.y) * place[1];
    place[2] = glm::min(place[2], glm::dvec4(std::numeric_limits<float>::max()));
    view.world_from_picture = glm::mat4(place);
    view.width_px = width;
    view.height_px = height;
    return view;
}

void keep_clip_in_range(shared::ViewRecord& view, double clip_reach) {
    constexpr int MOST_EXPONENT = 40;
    const int exponent = std::ilogb(std::max(clip_reach, 1.0)) + 1;
    if (exponent > MOST_EXPONENT) view.clip_from_world *= std::ldexp(1.0f, MOST_EXPONENT - exponent);
}

glm::dmat4 world_from_picture(const Camera& camera, uint32_t width, uint32_t height) {
    const glm::dmat3 axes(camera.world_from_camera);
    const glm::dvec2 half(half_extent(camera, width, height));
    const glm::dvec3 right = axes[0] * (2.0 * half.x / width), down = axes[1] * (-2.0 * half.y / height);
    const glm::dvec3 corner = half.y * axes[1] - half.x * axes[0];
    if (!camera.is_orthographic)
        return {glm::dvec4(right, 0.0), glm::dvec4(down, 0.0),
                glm::dvec4(0.0, 0.0, 0.0, 1.0 / camera.near_plane), glm::dvec4(corner - axes[2], 0.0)};
    const double range = double(camera.far_plane) - camera.near_plane;
    return {glm::dvec4(right, 0.0), glm::dvec4(down, 0.0), glm::dvec4(range * axes[2], 0.0),
            glm::dvec4(corner - double(camera.far_plane) * axes[2], 1.0)};
}

float view_depth(const Camera& camera, float depth) {
    if (!(depth > 0.0f)) return std::numeric_limits<float>::infinity();
    if (camera.is_orthographic) return camera.far_plane - depth * (camera.far_plane - camera.near_plane);
    return camera.near_plane / depth;
}

} // namespace burnish::render
