#include "burnish/render/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace burnish::render {
namespace {

constexpr double FILTER_RADIUS = 1.5;

/// Inverse of the window's cumulative distribution at x in [0, 1].
double sample_window(double x) {
    constexpr size_t steps = 1024;
    static const std::array<double, steps + 1> cumulative = [] {
        std::array<double, steps + 1> sum{};
        for (size_t k = 0; k < steps; ++k) {
            const double t = 2.0 * std::numbers::pi * (double(k) + 0.5) / steps;
            const double w =
                0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
            sum[k + 1] = sum[k] + w;
        }
        return sum;
    }();
    const double wanted = x * cumulative.back();
    const size_t k = std::clamp<size_t>(
        size_t(std::lower_bound(cumulative.begin(), cumulative.end(), wanted) - cumulative.begin()), 1,
        steps);
    const double part = (wanted - cumulative[k - 1]) / (cumulative[k] - cumulative[k - 1]);
    return ((double(k - 1) + part) / steps * 2.0 - 1.0) * FILTER_RADIUS;
}

} // namespace

shared::ViewRecord make_view(const Camera& camera, uint32_t width, uint32_t height, glm::vec2 jitter_px) {
    const float aspect = float(width) / float(height);
    const glm::mat3 rotation(camera.world_from_camera);
    const float half_height =
        camera.is_orthographic ? camera.half_height : std::tan(0.5f * camera.vertical_fov);
    const glm::vec2 half = {half_height * aspect, half_height};

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
    // Multiplied in double: a far camera's translation would eat the digits of a small scene.
    view.clip_from_world =
        glm::mat4(glm::dmat4(shift) * glm::dmat4(clip) * glm::inverse(glm::dmat4(camera.world_from_camera)));
    const glm::vec3 right =
        camera.is_orthographic ? glm::vec3(0.0f) : rotation[0] * (2.0f * half.x / float(width));
    const glm::vec3 down =
        camera.is_orthographic ? glm::vec3(0.0f) : rotation[1] * (-2.0f * half.y / float(height));
    const glm::vec3 corner =
        camera.is_orthographic ? -rotation[2] : -half.x * rotation[0] + half.y * rotation[1] - rotation[2];
    view.ray_corner = glm::vec4(corner + jitter_px.x * right + jitter_px.y * down, 0.0f);
    view.ray_dx = glm::vec4(right, 0.0f);
    view.ray_dy = glm::vec4(down, 0.0f);
    view.width_px = width;
    view.height_px = height;
    return view;
}

void keep_clip_in_range(shared::ViewRecord& view, double clip_reach) {
    constexpr int MOST_EXPONENT = 40;
    const int exponent = std::ilogb(std::max(clip_reach, 1.0)) + 1;
    if (exponent > MOST_EXPONENT) view.clip_from_world *= std::ldexp(1.0f, MOST_EXPONENT - exponent);
}

glm::vec2 filter_offset(uint32_t index, uint32_t count) {
    if (count <= 1) return glm::vec2(0.0f);
    // Additive recurrence of the plastic number; half a step in, so that no picture looks at the window's
    // end.
    const double x = std::fmod((index + 0.5) * 0.7548776662466927, 1.0);
    const double y = std::fmod((index + 0.5) * 0.5698402909980532, 1.0);
    return {float(sample_window(x)), float(sample_window(y))};
}

float view_depth(const Camera& camera, float depth) {
    if (!(depth > 0.0f)) return std::numeric_limits<float>::infinity();
    if (camera.is_orthographic) return camera.far_plane - depth * (camera.far_plane - camera.near_plane);
    return camera.near_plane / depth;
}

} // namespace burnish::render
