#include "burnish/sampler/regular_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "burnish/error.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;

struct Circle {
    double theta;
    uint32_t count;
};

/// Samples on a circle by eq. 13: the first non-zero circle holds n0, the others as many as keep its arc
/// length.
std::vector<Circle> circles_of(Spacing spacing, uint32_t circle_count, double theta_max) {
    std::vector<Circle> circles;
    const bool has_pole = spacing == Spacing::s1;
    const double step = has_pole ? theta_max / (circle_count - 0.5) : theta_max / (circle_count + 1.0 / 6.0);
    const uint32_t first_count = has_pole ? 6 : 4;
    const double first_theta = has_pole ? step : step * 2.0 / 3.0;
    for (uint32_t i = 0; i < circle_count; ++i) {
        if (has_pole && i == 0) {
            circles.push_back({0.0, 1});
            continue;
        }
        const double theta = has_pole ? i * step : (i + 2.0 / 3.0) * step;
        const double exact = first_count * std::sin(theta) / std::sin(first_theta);
        // Rounded up: the only rounding that gives all published counts. Whole numbers stay what they are.
        circles.push_back({theta, static_cast<uint32_t>(std::ceil(exact - 1e-9))});
    }
    return circles;
}

glm::dvec3 on_circle(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The samples of one circle that survive the threshold, turned by `phase`, and their sum of q.
std::pair<std::vector<glm::dvec3>, double> survivors(const Circle& circle, double phase, glm::dvec2 roughness,
                                                     double threshold) {
    std::vector<glm::dvec3> kept;
    double sum = 0.0;
    for (uint32_t j = 0; j < circle.count; ++j) {
        const glm::dvec3 h = on_circle(circle.theta, 2.0 * PI * (j + phase) / circle.count);
        const double q = lobe_q(h, roughness);
        // A sample exactly on the threshold stays, whatever the rounding of exp and tan.
        if (q < threshold * (1.0 - 1e-9)) continue;
        kept.push_back(h);
        sum += q;
    }
    return {kept, sum};
}

} // namespace

double lobe_q(glm::dvec3 half_vector, glm::dvec2 roughness) {
    if (half_vector.z <= 0.0) return 0.0;
    const double x = half_vector.x / (roughness.x * half_vector.z);
    const double y = half_vector.y / (roughness.y * half_vector.z);
    return std::exp(-(x * x + y * y));
}

std::vector<glm::dvec3> regular_pattern(glm::dvec2 roughness, Spacing spacing, uint32_t circle_count,
                                        double threshold) {
    if (!(roughness.x > 0.0 && roughness.y > 0.0 && roughness.x <= 10.0 && roughness.y <= 10.0))
        throw std::invalid_argument(
            message("roughness: expected values in (0, 10], got (", roughness.x, ", ", roughness.y, ")"));
    if (!(threshold > 0.0 && threshold < 1.0))
        throw std::invalid_argument(message("threshold: expected a value in (0, 1), got ", threshold));
    if (circle_count < 1 || circle_count > 64)
        throw std::invalid_argument(message("circles: expected 1..64, got ", circle_count));

    const double theta_max = std::atan(std::sqrt(-std::log(threshold)) * std::max(roughness.x, roughness.y));
    const bool is_anisotropic = roughness.x != roughness.y;
    std::vector<glm::dvec3> pattern;
    for (const Circle& circle : circles_of(spacing, circle_count, theta_max)) {
        auto [kept, sum] = survivors(circle, 0.0, roughness, is_anisotropic ? threshold : 0.0);
        if (is_anisotropic && circle.count > 1) {
            auto [turned, turned_sum] = survivors(circle, 0.5, roughness, threshold);
            if (turned_sum > sum * (1.0 + 1e-9)) kept = std::move(turned);
        }
        pattern.insert(pattern.end(), kept.begin(), kept.end());
    }
    return pattern;
}

std::vector<glm::dvec3> choose_regular_pattern(glm::dvec2 roughness, uint32_t samples, double threshold) {
    std::vector<glm::dvec3> best;
    const auto distance = [&](const std::vector<glm::dvec3>& pattern) {
        return std::abs(static_cast<int64_t>(pattern.size()) - static_cast<int64_t>(samples));
    };
    const auto is_better = [&](const std::vector<glm::dvec3>& pattern) {
        if (pattern.empty()) return false;
        if (best.empty() || distance(pattern) != distance(best))
            return best.empty() || distance(pattern) < distance(best);
        return pattern.size() > best.size();
    };
    for (const Spacing spacing : {Spacing::s1, Spacing::s2}) {
        for (uint32_t circle_count = 1; circle_count <= 64; ++circle_count) {
            std::vector<glm::dvec3> pattern = regular_pattern(roughness, spacing, circle_count, threshold);
            const bool is_past_budget = pattern.size() > 2ull * samples + 8;
            if (is_better(pattern)) best = std::move(pattern);
            if (is_past_budget) break;
        }
    }
    return best;
}

double lobe_solid_angle(glm::dvec2 roughness, double threshold) {
    // The lobe's edge has slopes (a cos t, b sin t). 1 - cos(theta) integrated over azimuth, with azimuth in
    // terms of t: dphi = a b / |slopes|^2 dt, and 1 - cos = |slopes|^2 / (w (w + 1)), w^2 = 1 + |slopes|^2.
    // Periodic and smooth even for aspects of a thousand, so that the midpoint rule converges exponentially.
    constexpr int steps = 1024;
    const double reach = std::sqrt(-std::log(threshold));
    const glm::dvec2 axes = roughness * reach;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double t = 2.0 * PI * (k + 0.5) / steps;
        const glm::dvec2 slope = axes * glm::dvec2(std::cos(t), std::sin(t));
        const double w = std::sqrt(1.0 + glm::dot(slope, slope));
        sum += axes.x * axes.y / (w * (w + 1.0));
    }
    return sum * 2.0 * PI / steps;
}

} // namespace burnish
