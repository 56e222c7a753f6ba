#include "burnish/lobe/albedo_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/cores.h"
#include "burnish/lobe/quadrature.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;
constexpr uint32_t WIDTH_NODES = 33;
constexpr int RADII = 24;
constexpr int AZIMUTHS = 16;        ///< in each quarter
constexpr double LAST_RADIUS = 6.0; ///< q = exp(-36): nothing of the lobe lies beyond
/// Of quick albedos.
constexpr int FEW_RADII = 16;
constexpr int FEW_AZIMUTHS = 8;
constexpr double NEAR_RADIUS = 4.0;     ///< q = 1e-7
constexpr double LEAST_VARIANCE = 1e-8; ///< of nodes at zero
constexpr double LEAST_COS_O =
    1e-6; ///< of nodes: below what kernels ask for, so that none stands in for another

double power(double x, double exponent) {
    if (exponent == 1.0) return x;
    if (exponent == 0.5) return std::sqrt(x);
    if (exponent == 0.0) return 1.0;
    return std::pow(x, exponent);
}

/// The part of the integral along one azimuth: slopes s (px, py), D cos_h dh = exp(-s^2)/pi s ds dphi. Light
/// comes from above for oz a s^2 - 2 b s < oz, a = px^2 + py^2, b = o.(px, py): up to the one positive root,
/// where cos_i^(1-alpha) has a branch point; nodes crowd toward it.
template <int radii>
glm::dvec2 integrate_radius(glm::dvec3 omega_o, glm::dvec2 p, double alpha, double last_radius) {
    static const Quadrature<radii> nodes = graded<radii>();
    const double a = glm::dot(p, p), b = omega_o.x * p.x + omega_o.y * p.y;
    const double last = std::min(horizon_radius(omega_o, p), last_radius);
    glm::dvec2 sum(0.0);
    for (int k = 0; k < radii; ++k) {
        const double s = last * (1.0 - nodes.x[k]);
        const double length2 = 1.0 + a * s * s; // 1/cos_h^2
        const double o_p = omega_o.z + b * s;
        const double cos_i = std::max(2.0 * o_p / length2 - omega_o.z, 0.0);
        const double length = std::sqrt(length2);
        const double value =
            nodes.weight[k] * last * std::exp(-s * s) * s * length * power(cos_i, 1.0 - alpha);
        sum += value * glm::dvec2(1.0, schlick_weight(o_p / length));
    }
    return sum / PI;
}

template <int radii, int azimuths>
glm::dvec2 integrate(glm::dvec3 omega_o, glm::dvec2 roughness, double alpha, double last_radius) {
    static const Quadrature<azimuths> nodes = graded<azimuths>();
    omega_o.z = std::max(omega_o.z, LEAST_COS_O);
    // Where b changes sign a grazing view's horizon jumps: nodes crowd toward these two azimuths, from both
    // sides.
    const double first = std::atan2(omega_o.y * roughness.y, omega_o.x * roughness.x) - PI / 2.0;
    glm::dvec2 sum(0.0);
    for (int k = 0; k < azimuths; ++k) {
        const double near = PI / 2.0 * nodes.x[k];
        for (const double phi : {first + near, first - near, first + PI - near, first + PI + near})
            sum += nodes.weight[k] *
                   integrate_radius<radii>(omega_o, roughness * glm::dvec2(std::cos(phi), std::sin(phi)),
                                           alpha, last_radius);
    }
    return sum * (PI / 2.0);
}

/// Node k of `count`, at squares over [0, 1].
double square_node(uint32_t k, uint32_t count) {
    const double root = double(k) / (count - 1);
    return root * root;
}

glm::dvec3 view_at(double cos_o, glm::dvec2 azimuth) {
    cos_o = std::max(cos_o, LEAST_COS_O);
    return glm::dvec3(std::sqrt(1.0 - cos_o * cos_o) * azimuth, cos_o);
}

LobeShape with_width(LobeShape shape, glm::dvec2 width) {
    shape.width_x = float(width.x);
    shape.width_y = float(width.y);
    return shape;
}

/// The brushed lobe whose slopes have the covariance C/2 in the plane of view (x) and across it.
struct LobeInView {
    glm::dvec2 roughness; ///< along its axes
    glm::dvec2 view;      ///< direction of the view in them
};

LobeInView lobe_in_view(double c_xx, double c_yy, double c_xy) {
    const double mean = 0.5 * (c_xx + c_yy), difference = 0.5 * (c_xx - c_yy);
    const double radius = std::sqrt(difference * difference + c_xy * c_xy);
    const double major = std::max(mean + radius, LEAST_VARIANCE);
    const double minor = std::max((c_xx * c_yy - c_xy * c_xy) / major, LEAST_VARIANCE);
    const double cos2 = radius > 0.0 ? std::clamp(0.5 + 0.5 * difference / radius, 0.0, 1.0) : 0.5;
    return {{std::sqrt(major), std::sqrt(minor)}, {std::sqrt(cos2), std::sqrt(1.0 - cos2)}};
}

} // namespace

glm::dvec2 directional_albedo(glm::dvec3 omega_o, glm::dvec2 roughness, double alpha, bool is_quick) {
    return is_quick ? integrate<FEW_RADII, FEW_AZIMUTHS>(omega_o, roughness, alpha, NEAR_RADIUS)
                    : integrate<RADII, AZIMUTHS>(omega_o, roughness, alpha, LAST_RADIUS);
}

AlbedoTable build_albedo_table(const LobeShape& shape) {
    AlbedoTable table;
    const glm::dvec2 m = shape.model->albedo_width(shape);
    table.width_nodes = m.x == m.y ? 1 : WIDTH_NODES;
    table.entries.resize(table.width_nodes * ALBEDO_COS_NODES);
    const double low = std::min(m.x, m.y), high = std::max(m.x, m.y);
    for_each_on_cores(table.width_nodes, table.width_nodes > 1, [&](size_t j) {
        glm::dvec2 azimuth(1.0, 0.0);
        if (table.width_nodes > 1) {
            const double share = double(j) / (table.width_nodes - 1),
                         width = low + (high - low) * share * share;
            const double cos2 = std::clamp((width * width - m.y * m.y) / (m.x * m.x - m.y * m.y), 0.0, 1.0);
            azimuth = {std::sqrt(cos2), std::sqrt(1.0 - cos2)};
        }
        for (uint32_t i = 0; i < ALBEDO_COS_NODES; ++i)
            table.entries[j * ALBEDO_COS_NODES + i] =
                shape.model->albedo(shape, view_at(square_node(i, ALBEDO_COS_NODES), azimuth), false);
    });
    return table;
}

std::vector<glm::vec2> build_varying_albedo_table(const LobeShape& shape) {
    using shared::ALBEDO_ROUGHNESS_NODES;
    std::vector<glm::vec2> entries(size_t(ALBEDO_ROUGHNESS_NODES) * ALBEDO_COS_NODES);
    for_each_on_cores(ALBEDO_ROUGHNESS_NODES, true, [&](size_t k) {
        const double m =
            std::max(square_node(uint32_t(k), ALBEDO_ROUGHNESS_NODES), std::sqrt(LEAST_VARIANCE));
        for (uint32_t i = 0; i < ALBEDO_COS_NODES; ++i)
            entries[k * ALBEDO_COS_NODES + i] =
                shape.model->albedo(with_width(shape, glm::dvec2(m)),
                                    view_at(square_node(i, ALBEDO_COS_NODES), {1.0, 0.0}), false);
    });
    return entries;
}

std::vector<glm::vec2> build_brushed_albedo_table(const LobeShape& shape) {
    using namespace shared;
    constexpr size_t row = size_t(ALBEDO_CORRELATION_NODES) * ALBEDO_BRUSHED_COS_NODES;
    std::vector<glm::vec2> entries(ALBEDO_ALONG_NODES * ALBEDO_ACROSS_NODES * row);
    for_each_on_cores(ALBEDO_ALONG_NODES * ALBEDO_ACROSS_NODES, true, [&](size_t k) {
        const double along = square_node(uint32_t(k / ALBEDO_ACROSS_NODES), ALBEDO_ALONG_NODES),
                     across = square_node(uint32_t(k % ALBEDO_ACROSS_NODES), ALBEDO_ACROSS_NODES);
        for (uint32_t r = 0; r < ALBEDO_CORRELATION_NODES; ++r) {
            const double correlation = std::sqrt(double(r) / (ALBEDO_CORRELATION_NODES - 1));
            const LobeInView lobe =
                lobe_in_view(along * along, across * across, correlation * along * across);
            for (uint32_t i = 0; i < ALBEDO_BRUSHED_COS_NODES; ++i)
                entries[k * row + r * ALBEDO_BRUSHED_COS_NODES + i] =
                    shape.model->albedo(with_width(shape, lobe.roughness),
                                        view_at(square_node(i, ALBEDO_BRUSHED_COS_NODES), lobe.view), true);
        }
    });
    return entries;
}

} // namespace burnish
