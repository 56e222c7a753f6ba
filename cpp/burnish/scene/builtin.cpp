// Meshes made by code: bodies of revolution about y, and a plane.
#include <cmath>
#include <stdexcept>

#include <glm/gtc/constants.hpp>

#include "burnish/check.h"
#include "burnish/scene/mesh.h"

namespace burnish {
namespace {

constexpr double PI = glm::pi<double>();

void require_segments(uint32_t segments) {
    if (segments < 3 || segments > 4096)
        throw std::invalid_argument(message("segments: expected 3..4096, got ", segments));
}

/// A point of the curve that turns about y: distance from the axis, height, and the outward normal in that
/// plane.
struct ProfilePoint {
    double radius, height, normal_radius, normal_height;
};

/// Appends the surface swept by `profile`, which runs with the outside on its left when height is drawn
/// upward and radius to the right (from the top downward). A point of radius 0 is a pole: a fan of single
/// triangles ends there. Longitude grows from +z toward +x; the tangent follows it; u grows with it and v
/// along the profile.
void append_revolution(Mesh& mesh, const std::vector<ProfilePoint>& profile, uint32_t segments) {
    uint32_t first = static_cast<uint32_t>(mesh.positions.size());
    uint32_t row_size = segments + 1; // the seam's vertices differ in u
    for (size_t row = 0; row < profile.size(); ++row) {
        const ProfilePoint& point = profile[row];
        bool is_pole = point.radius == 0.0;
        for (uint32_t column = 0; column < row_size; ++column) {
            double turn =
                (column + (is_pole ? 0.5 : 0.0)) / segments; // a pole's vertex serves the fan's middle
            double s = std::sin(2.0 * PI * turn), c = std::cos(2.0 * PI * turn);
            if (!is_pole && column == segments) s = 0.0, c = 1.0; // the seam closes exactly
            mesh.positions.emplace_back(point.radius * s, point.height, point.radius * c);
            mesh.normals.emplace_back(point.normal_radius * s, point.normal_height, point.normal_radius * c);
            mesh.tangents.emplace_back(c, 0.0, -s, 1.0);
            mesh.uv0.emplace_back(turn, static_cast<double>(row) / static_cast<double>(profile.size() - 1));
        }
    }
    for (uint32_t row = 0; row + 1 < profile.size(); ++row) {
        for (uint32_t column = 0; column < segments; ++column) {
            uint32_t a = first + row * row_size + column, b = a + row_size;
            if (profile[row + 1].radius > 0.0) mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
            if (profile[row].radius > 0.0)
                mesh.indices.insert(mesh.indices.end(),
                                    {a, profile[row + 1].radius > 0.0 ? b + 1 : b, a + 1});
        }
    }
}

/// A closed curve around (radius, height) from its outermost point downward: half widths times |cos|^e and
/// |sin|^e. Exponent 1 is an ellipse, smaller ones tend to a rounded box.
std::vector<ProfilePoint> ring_profile(double radius, double height, double half_width, double half_height,
                                       double exponent, uint32_t count) {
    auto power = [](double x, double e) { return std::copysign(std::pow(std::abs(x), e), x); };
    std::vector<ProfilePoint> profile;
    for (uint32_t i = 0; i <= count; ++i) {
        double angle = -2.0 * PI * (i % count) / count; // clockwise: the outside stays on the left
        double c = std::cos(angle), s = std::sin(angle);
        double normal_x = power(c, 2.0 - exponent) / half_width,
               normal_y = power(s, 2.0 - exponent) / half_height;
        double length = std::hypot(normal_x, normal_y);
        profile.push_back({radius + half_width * power(c, exponent),
                           height + half_height * power(s, exponent), normal_x / length, normal_y / length});
    }
    return profile;
}

} // namespace

Mesh make_sphere(float radius, uint32_t segments) {
    require_positive("radius", radius);
    require_segments(segments);
    uint32_t rows = std::max(2u, segments / 2);
    std::vector<ProfilePoint> profile;
    for (uint32_t row = 0; row <= rows; ++row) {
        bool is_pole = row == 0 || row == rows;
        double angle = PI * row / rows;
        double s = is_pole ? 0.0 : std::sin(angle), c = is_pole ? (row == 0 ? 1.0 : -1.0) : std::cos(angle);
        profile.push_back({radius * s, radius * c, s, c});
    }
    Mesh mesh;
    mesh.name = "sphere";
    append_revolution(mesh, profile, segments);
    return mesh;
}

Mesh make_plane(float size, uint32_t segments) {
    require_positive("size", size);
    if (segments < 1 || segments > 4096)
        throw std::invalid_argument(message("segments: expected 1..4096, got ", segments));
    Mesh mesh;
    mesh.name = "plane";
    for (uint32_t row = 0; row <= segments; ++row) {
        for (uint32_t column = 0; column <= segments; ++column) {
            glm::vec2 uv(static_cast<float>(column) / static_cast<float>(segments),
                         static_cast<float>(row) / static_cast<float>(segments));
            mesh.positions.emplace_back(size * (uv.x - 0.5f), 0.0f, size * (uv.y - 0.5f));
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
            mesh.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
            mesh.uv0.push_back(uv);
        }
    }
    for (uint32_t row = 0; row < segments; ++row) {
        for (uint32_t column = 0; column < segments; ++column) {
            uint32_t a = row * (segments + 1) + column, b = a + segments + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    return mesh;
}

Mesh make_torus(float radius, float tube_radius, uint32_t segments) {
    require_positive("radius", radius);
    require_segments(segments);
    if (!(tube_radius > 0.0f && tube_radius < radius))
        throw std::invalid_argument(
            message("tube_radius: expected a number between 0 and radius = ", radius, ", got ", tube_radius));
    Mesh mesh;
    mesh.name = "torus";
    append_revolution(
        mesh, ring_profile(radius, 0.0, tube_radius, tube_radius, 1.0, std::max(3u, segments / 2)), segments);
    return mesh;
}

Mesh make_shader_ball(uint32_t segments) {
    require_segments(segments);
    // The ball: R(latitude) = 1 - depth exp(-(latitude/width)^6), a flat-bottomed groove with rounded lips
    // around the equator. With P = R (cos, sin) the normal is P' turned by a right angle: (R' sin + R cos, R
    // sin - R' cos).
    constexpr double CENTER = 1.13, GROOVE_DEPTH = 0.07, GROOVE_WIDTH = 0.075;
    // Where the ball disappears in its foot nothing is seen, so the ball is complete and sinks into the ring.
    uint32_t rows = std::max(8u, segments);
    std::vector<ProfilePoint> profile;
    for (uint32_t row = 0; row <= rows; ++row) {
        // Rows gather near the equator, where the groove bends: latitude = pi/2 (0.35 t + 0.65 t^3), t in
        // [-1, 1].
        double t = 1.0 - 2.0 * row / rows;
        double latitude = 0.5 * PI * (0.35 * t + 0.65 * t * t * t);
        bool is_pole = row == 0 || row == rows;
        double c = is_pole ? 0.0 : std::cos(latitude), s = std::sin(latitude);
        double x = latitude / GROOVE_WIDTH;
        double dent = GROOVE_DEPTH * std::exp(-std::pow(x, 6.0));
        double slope = dent * 6.0 * std::pow(x, 5.0) / GROOVE_WIDTH; // R'
        double normal_radius = slope * s + (1.0 - dent) * c, normal_height = (1.0 - dent) * s - slope * c;
        double length = std::hypot(normal_radius, normal_height);
        profile.push_back(
            {(1.0 - dent) * c, CENTER + (1.0 - dent) * s, normal_radius / length, normal_height / length});
    }
    Mesh mesh;
    mesh.name = "shader_ball";
    append_revolution(mesh, profile, segments);
    append_revolution(mesh, ring_profile(0.6, 0.15, 0.2, 0.15, 0.5, std::max(16u, segments / 2)), segments);
    return mesh;
}

} // namespace burnish
