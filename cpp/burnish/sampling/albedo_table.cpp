#include "burnish/sampling/albedo_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;
constexpr uint32_t WIDTH_NODES = 33;
constexpr int RADII = 24;
constexpr int AZIMUTHS = 16;        ///< in each quarter
constexpr double LAST_RADIUS = 6.0; ///< q = exp(-36): nothing of the lobe lies beyond
constexpr double LEAST_COS_O =
    1e-6; ///< of nodes: below what kernels ask for, so that none stands in for another

/// Nodes and weights of an integral over [0, 1].
template <int count>
struct Quadrature {
    std::array<double, count> x, weight;
};

/// Gauss-Legendre: roots of the Legendre polynomial by Newton's method, from Chebyshev's.
template <int count>
Quadrature<count> gauss_legendre() {
    Quadrature<count> result;
    for (int k = 0; k < count; ++k) {
        double x = std::cos(PI * (k + 0.75) / (count + 0.5)), slope = 1.0;
        for (int step = 0; step < 10; ++step) {
            double before = 1.0, here = x;
            for (int n = 2; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * here - (n - 1) * before) / n;
                before = here;
                here = next;
            }
            slope = count * (x * here - before) / (x * x - 1.0);
            x -= here / slope;
        }
        result.x[k] = 0.5 * (1.0 + x);
        result.weight[k] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    return result;
}

/// Nodes crowded toward 0 by x -> x^3.
template <int count>
Quadrature<count> graded() {
    Quadrature<count> result = gauss_legendre<count>();
    for (int k = 0; k < count; ++k) {
        const double x = result.x[k];
        result.x[k] = x * x * x;
        result.weight[k] *= 3.0 * x * x;
    }
    return result;
}

double power(double x, double exponent) {
    if (exponent == 1.0) return x;
    if (exponent == 0.5) return std::sqrt(x);
    if (exponent == 0.0) return 1.0;
    return std::pow(x, exponent);
}

/// The part of the integral along one azimuth: slopes s (px, py), D cos_h dh = exp(-s^2)/pi s ds dphi. Light
/// comes from above for oz a s^2 - 2 b s < oz, a = px^2 + py^2, b = o.(px, py): up to the one positive root,
/// where cos_i^(1-alpha) has a branch point; nodes crowd toward it.
glm::dvec2 integrate_radius(glm::dvec3 omega_o, glm::dvec2 p, double alpha) {
    static const Quadrature<RADII> nodes = graded<RADII>();
    const double a = glm::dot(p, p), b = omega_o.x * p.x + omega_o.y * p.y;
    const double root = std::sqrt(b * b + omega_o.z * omega_o.z * a);
    // Without cancellation on either side of b = 0.
    const double horizon = b > 0.0 ? (b + root) / (omega_o.z * a) : omega_o.z / (root - b);
    const double last = std::min(horizon, LAST_RADIUS);
    glm::dvec2 sum(0.0);
    for (int k = 0; k < RADII; ++k) {
        const double s = last * (1.0 - nodes.x[k]);
        const double length2 = 1.0 + a * s * s; // 1/cos_h^2
        const double o_p = omega_o.z + b * s;
        const double cos_i = std::max(2.0 * o_p / length2 - omega_o.z, 0.0);
        const double length = std::sqrt(length2);
        const double value =
            nodes.weight[k] * last * std::exp(-s * s) * s * length * power(cos_i, 1.0 - alpha);
        const double back = std::clamp(1.0 - o_p / length, 0.0, 1.0);
        sum += glm::dvec2(value, value * back * back * back * back * back);
    }
    return sum / PI;
}

} // namespace

glm::dvec2 directional_albedo(glm::dvec3 omega_o, glm::dvec2 roughness, double alpha) {
    static const Quadrature<AZIMUTHS> nodes = graded<AZIMUTHS>();
    omega_o.z = std::max(omega_o.z, LEAST_COS_O);
    // Where b changes sign a grazing view's horizon jumps: nodes crowd toward these two azimuths, from both
    // sides.
    const double first = std::atan2(omega_o.y * roughness.y, omega_o.x * roughness.x) - PI / 2.0;
    glm::dvec2 sum(0.0);
    for (int k = 0; k < AZIMUTHS; ++k) {
        const double near = PI / 2.0 * nodes.x[k];
        for (const double phi : {first + near, first - near, first + PI - near, first + PI + near})
            sum += nodes.weight[k] *
                   integrate_radius(omega_o, roughness * glm::dvec2(std::cos(phi), std::sin(phi)), alpha);
    }
    return sum * (PI / 2.0);
}

AlbedoTable build_albedo_table(glm::vec2 roughness, float alpha) {
    AlbedoTable table;
    table.width_nodes = roughness.x == roughness.y ? 1 : WIDTH_NODES;
    table.entries.resize(table.width_nodes * ALBEDO_COS_NODES);
    const glm::dvec2 m(roughness);
    const double low = std::min(m.x, m.y), high = std::max(m.x, m.y);
    for (uint32_t j = 0; j < table.width_nodes; ++j) {
        glm::dvec2 azimuth(1.0, 0.0);
        if (table.width_nodes > 1) {
            const double share = double(j) / (table.width_nodes - 1),
                         width = low + (high - low) * share * share;
            const double cos2 = std::clamp((width * width - m.y * m.y) / (m.x * m.x - m.y * m.y), 0.0, 1.0);
            azimuth = {std::sqrt(cos2), std::sqrt(1.0 - cos2)};
        }
        for (uint32_t i = 0; i < ALBEDO_COS_NODES; ++i) {
            const double root = double(i) / (ALBEDO_COS_NODES - 1);
            const double cos_o = std::max(root * root, LEAST_COS_O);
            const double sin_o = std::sqrt(1.0 - cos_o * cos_o);
            table.entries[j * ALBEDO_COS_NODES + i] =
                directional_albedo(glm::dvec3(sin_o * azimuth, cos_o), m, alpha);
        }
    }
    return table;
}

} // namespace burnish
