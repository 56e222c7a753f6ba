#include "burnish/lobe/ggx.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/check.h"
#include "burnish/lobe/quadrature.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double LEAST_COS = 1e-4;
/// A normal of the stretched hemisphere is at least so high: its half-vector has a slope.
constexpr double LEAST_HEIGHT = 1e-9;
constexpr double LEAST_COS_O = 1e-6; ///< of albedos
/// Nodes of albedos, and of quick ones; azimuths in each quarter.
constexpr int RADII = 24, FEW_RADII = 20;
constexpr int AZIMUTHS = 12, FEW_AZIMUTHS = 10;
/// From one place to the next of a difference, in widths: its square is the error.
constexpr double DIFFERENCE = 1e-5;

/// The unit disc of normals that a view sees: axes of the stretched view, and how far it is squeezed.
struct Disc {
    glm::dvec3 view, level, other;
    double squeeze;
};

Disc disc_of(const LobeShape& shape, glm::dvec3 omega_o) {
    Disc disc;
    disc.view = glm::normalize(omega_o * glm::dvec3(shape.width(), 1.0));
    const double sine = std::hypot(disc.view.x, disc.view.y);
    // Seen along the normal the disc is the same whichever way it is turned.
    disc.level = sine > 1e-9 ? glm::dvec3(-disc.view.y, disc.view.x, 0.0) / sine : glm::dvec3(0.0, 1.0, 0.0);
    disc.other = glm::cross(disc.view, disc.level);
    disc.squeeze = 0.5 * (1.0 + disc.view.z);
    return disc;
}

/// The half-vector of a place: on the disc at p/(1 + |p|^2)^1/2, squeezed to the part that is seen.
glm::dvec3 half_vector(const LobeShape& shape, const Disc& disc, glm::dvec2 p) {
    const glm::dvec2 level(disc.level);
    const glm::dvec2 turned(glm::dot(level, p), glm::dot(glm::dvec2(-level.y, level.x), p));
    const double k = 1.0 / std::sqrt(1.0 + glm::dot(p, p)), first = k * turned.x;
    const double second = (1.0 - disc.squeeze) * std::sqrt(1.0 - first * first) + disc.squeeze * k * turned.y;
    const double third = std::sqrt(std::max(1.0 - first * first - second * second, 0.0));
    const glm::dvec3 normal = first * disc.level + second * disc.other + third * disc.view;
    return glm::normalize(glm::dvec3(shape.width() * glm::dvec2(normal), std::max(normal.z, LEAST_HEIGHT)));
}

/// Smith's G_1 is 2 v_z/(v_z + this).
double projected_width(const LobeShape& shape, glm::dvec3 v) {
    return glm::length(v * glm::dvec3(shape.width(), 1.0));
}

double lit_exponent(const LobeShape&) {
    return 1.0; // where light grazes
}

/// The base is G_2/G_1(o).
LobePoint point(const LobeShape& shape, const Disc& disc, glm::dvec3 omega_o, glm::dvec2 p) {
    const glm::dvec3 h = half_vector(shape, disc, p);
    const double o_h = glm::dot(omega_o, h);
    const glm::dvec3 omega_i = 2.0 * o_h * h - omega_o;
    if (omega_i.z <= 0.0 || o_h <= 0.0) return {omega_i, 0.0, 0.0};
    const double cos_o = std::max(omega_o.z, LEAST_COS), a_o = projected_width(shape, omega_o);
    const double a_i = projected_width(shape, omega_i);
    return {omega_i, omega_i.z * (a_o + cos_o) / (a_i * cos_o + a_o * omega_i.z), schlick_weight(o_h)};
}

LobePoint at(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 p) {
    return point(shape, disc_of(shape, omega_o), omega_o, p);
}

/// By differences: the closed form is its twin's.
glm::dmat2 linear_map(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 p) {
    const glm::dvec3 middle = at(shape, omega_o, p).omega_i;
    const glm::dvec3 axis = std::abs(middle.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 t = glm::normalize(glm::cross(middle, axis)), b = glm::cross(middle, t);
    glm::dmat2 map;
    for (int k = 0; k < 2; ++k) {
        glm::dvec2 step(0.0);
        step[k] = DIFFERENCE;
        const glm::dvec3 moved = at(shape, omega_o, p + step).omega_i - at(shape, omega_o, p - step).omega_i;
        map[k] = glm::dvec2(glm::dot(t, moved), glm::dot(b, moved)) / (2.0 * DIFFERENCE);
    }
    return map;
}

/// In the middle: what is drawn by the plane's density has the density D/(2 (cos_o + a(o))) of directions.
double stretch(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 one, glm::dvec2 other) {
    const glm::dvec2 p = 0.5 * (one + other), width = shape.width();
    const glm::dvec3 h = half_vector(shape, disc_of(shape, omega_o), p);
    if (glm::dot(omega_o, h) <= 0.0) return 0.0;
    const glm::dvec3 scaled = h / glm::dvec3(width, 1.0);
    const double q = glm::dot(scaled, scaled), r2 = 1.0 + glm::dot(p, p);
    return 2.0 * (std::max(omega_o.z, LEAST_COS) + projected_width(shape, omega_o)) * width.x * width.y * q *
           q / (r2 * r2);
}

/// The plane itself follows what is seen.
double moment_share(const LobeShape&) {
    return 0.0;
}

/// Over slopes s (ax cos phi, ay sin phi) of half-vectors, with v = s^2/(1 + s^2): int int G_2 (o.h)/(co
/// cos_h) dv/2 dphi/pi. Nodes crowd toward the horizon, and toward the azimuths at which a grazing view's
/// horizon jumps.
template <int radius_nodes, int azimuth_nodes>
glm::dvec2 integrate(const LobeShape& shape, glm::dvec3 omega_o) {
    static const Quadrature<radius_nodes> radii = graded<radius_nodes>();
    static const Quadrature<azimuth_nodes> azimuths = graded<azimuth_nodes>();
    omega_o.z = std::max(omega_o.z, LEAST_COS_O);
    const glm::dvec2 a = shape.width();
    const double a_o = projected_width(shape, omega_o);
    const double first = std::atan2(omega_o.y * a.y, omega_o.x * a.x) - PI / 2.0;
    glm::dvec2 sum(0.0);
    for (int j = 0; j < azimuth_nodes; ++j) {
        const double near = PI / 2.0 * azimuths.x[j];
        for (const double phi : {first + near, first - near, first + PI - near, first + PI + near}) {
            const glm::dvec2 p = a * glm::dvec2(std::cos(phi), std::sin(phi));
            const double horizon = horizon_radius(omega_o, p),
                         last = horizon / std::sqrt(1.0 + horizon * horizon);
            for (int k = 0; k < radius_nodes; ++k) {
                const double root = last * (1.0 - radii.x[k]), s = root / std::sqrt(1.0 - root * root);
                const glm::dvec3 g(s * p, 1.0);
                const double length2 = glm::dot(g, g), og = glm::dot(omega_o, g);
                const glm::dvec3 omega_i = 2.0 * og / length2 * g - omega_o;
                if (omega_i.z <= 0.0 || og <= 0.0) continue;
                const double visible =
                    2.0 * omega_i.z / (omega_o.z * projected_width(shape, omega_i) + omega_i.z * a_o);
                // dv/2 = root droot.
                const double value = azimuths.weight[j] * radii.weight[k] * last * root * visible * og;
                sum += value * glm::dvec2(1.0, schlick_weight(og / std::sqrt(length2)));
            }
        }
    }
    return sum * 0.5;
}

glm::dvec2 albedo(const LobeShape& shape, glm::dvec3 omega_o, bool is_quick) {
    return is_quick ? integrate<FEW_RADII, FEW_AZIMUTHS>(shape, omega_o)
                    : integrate<RADII, AZIMUTHS>(shape, omega_o);
}

constexpr ViewPlane VIEW = {
    .lit_exponent = lit_exponent,
    .at = at,
    .linear_map = linear_map,
    .stretch = stretch,
    .moment_share = moment_share,
};

constexpr LobeModel GGX = {
    .name = "GGX",
    .id = shared::MODEL_GGX,
    .density = Density::student,
    .has_fixed_half_vectors = false,
    .view = &VIEW,
    .albedo = albedo,
    .albedo_width = plane_width,
};

} // namespace

void validate(const GgxLobe& lobe, const std::string& prefix) {
    validate_shared(prefix, lobe.roughness, lobe.r0, lobe.weight, lobe.rotation);
    require_unit(prefix + "f90", lobe.f90);
}

LobeFacts facts(const GgxLobe& lobe) {
    LobeFacts facts;
    facts.shape = {.model = &GGX, .width_x = lobe.roughness.x, .width_y = lobe.roughness.y};
    facts.is_brushed = lobe.is_anisotropic();
    facts.scales_energy = lobe.compensates;
    set_fresnel(facts, lobe.weight, lobe.r0, lobe.f90);
    return facts;
}

shared::LobeRecord record(const GgxLobe& lobe) {
    shared::LobeRecord record = make_record(facts(lobe).shape, lobe.weight, lobe.r0, lobe.f90, lobe.rotation);
    record.energy = lobe.compensates ? shared::ENERGY_COMPENSATED : shared::ENERGY_AS_IT_IS;
    return record;
}

} // namespace burnish
