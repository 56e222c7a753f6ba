// Nodes and weights of integrals over [0, 1], and where half-vectors end.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace burnish {

template <int count>
struct Quadrature {
    std::array<double, count> x, weight;
};

/// Gauss-Legendre: roots of the Legendre polynomial by Newton's method, from Chebyshev's.
template <int count>
Quadrature<count> gauss_legendre() {
    Quadrature<count> result;
    for (int k = 0; k < count; ++k) {
        double x = std::cos(std::numbers::pi * (k + 0.75) / (count + 0.5)), slope = 1.0;
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

/// Half-vectors (s p, 1) mirror a view to the horizon at this s, the one positive root of
/// o_z a s^2 - 2 b s = o_z, a = |p|^2, b = o.p.
inline double horizon_radius(glm::dvec3 omega_o, glm::dvec2 p) {
    const double a = glm::dot(p, p), b = omega_o.x * p.x + omega_o.y * p.y;
    const double root = std::sqrt(b * b + omega_o.z * omega_o.z * a);
    // Without cancellation on either side of b = 0.
    return b > 0.0 ? (b + root) / (omega_o.z * a) : omega_o.z / (root - b);
}

} // namespace burnish
