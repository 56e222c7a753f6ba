#include "burnish/sampler/weighted_lobe.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/packing.hpp>

#include "burnish/cores.h"
#include "shared/constants.h"

namespace burnish {
namespace {

constexpr double LEAST_COS_O = 1e-4;
constexpr int LAST = int(shared::MATCHED_MOMENT_NODES) - 1;
/// Close to the normal, on the square of views.
constexpr double DRIFT_RADIUS = 0.125;
/// Sums go over a square of slopes, 25 by 25: the density has next to nothing beyond.
constexpr double SUM_STEP = 0.25;
constexpr int SUM_REACH = 12;

Moments sum_moments(const MatchedLobe& lobe, glm::dvec3 omega_o) {
    const glm::dvec2 roughness(lobe.roughness_x, lobe.roughness_y);
    double sum = 0.0;
    glm::dvec2 first(0.0);
    glm::dvec3 second(0.0);
    for (int j = -SUM_REACH; j <= SUM_REACH; ++j)
        for (int i = -SUM_REACH; i <= SUM_REACH; ++i) {
            const glm::dvec2 p = SUM_STEP * glm::dvec2(i, j);
            const std::optional<Reflected> light = reflect_slope(lobe, omega_o, roughness * p);
            if (!light) continue;
            const double value = light->grey * std::exp(-glm::dot(p, p));
            sum += value;
            first += value * p;
            second += value * glm::dvec3(p.x * p.x, p.x * p.y, p.y * p.y);
        }
    // The lobe itself serves where nothing is reflected.
    if (sum <= 0.0) return {glm::dvec2(0.0), glm::dvec3(0.5, 0.0, 0.5)};
    const glm::dvec2 mean = first / sum;
    return {mean, second / sum - glm::dvec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y)};
}

Moments mix(const Moments& one, const Moments& other, double share) {
    return {glm::mix(one.mean, other.mean, share), glm::mix(one.covariance, other.covariance, share)};
}

} // namespace

std::optional<Reflected> reflect_slope(const MatchedLobe& lobe, glm::dvec3 omega_o, glm::dvec2 slope) {
    const glm::dvec3 g(slope, 1.0);
    const double length2 = glm::dot(g, g), og = glm::dot(omega_o, g);
    const glm::dvec3 omega_i = 2.0 * og / length2 * g - omega_o;
    if (omega_i.z <= 0.0 || og <= 0.0) return std::nullopt;
    const double length = std::sqrt(length2);
    const double cos_power = lobe.alpha == 0.0f   ? omega_i.z
                             : lobe.alpha == 0.5f ? std::sqrt(omega_i.z)
                                                  : std::pow(omega_i.z, 1.0 - lobe.alpha);
    const double rest = std::clamp(1.0 - og / length, 0.0, 1.0), rest2 = rest * rest;
    const double base = cos_power * length, schlick = rest2 * rest2 * rest;
    return Reflected{omega_i, base, schlick, base * (lobe.specular + lobe.grazing * schlick)};
}

SquareView view_of_square(glm::dvec2 square) {
    const double radius = std::max(std::abs(square.x), std::abs(square.y));
    const double root = 0.5 * (std::sqrt(9.0 - 8.0 * radius * radius) - 1.0);
    // Along the normal there is no plane of view: the first axis serves.
    const glm::dvec2 e = radius > 0.0 ? glm::normalize(square) : glm::dvec2(1.0, 0.0);
    const double cos_o = std::max(root * root, LEAST_COS_O);
    return {glm::dvec3(std::sqrt(1.0 - cos_o * cos_o) * e, cos_o), e};
}

double moment_share(const MatchedLobe& lobe) {
    return shared::MATCHED_MOMENT_SHARE * std::exp(-lobe.roughness_x * lobe.roughness_y);
}

glm::vec2 lobe_drift(const MatchedLobe& lobe) {
    const glm::dvec3 along = view_of_square({DRIFT_RADIUS, 0.0}).omega_o;
    const glm::dvec3 across = view_of_square({0.0, DRIFT_RADIUS}).omega_o;
    const double x = sum_moments(lobe, along).mean.x / along.x;
    const double y = view_columns(lobe) == 1 ? x : sum_moments(lobe, across).mean.y / across.y;
    const glm::dvec2 drift = moment_share(lobe) * glm::dvec2(lobe.roughness_x * x, lobe.roughness_y * y);
    return glm::unpackHalf2x16(glm::packHalf2x16(glm::vec2(drift)));
}

WeightedLobe::WeightedLobe(const MatchedLobe& lobe) : is_round_(view_columns(lobe) == 1) {
    const size_t columns = is_round_ ? 1 : 2 * LAST + 1;
    nodes_.resize(columns * (LAST + 1));
    for_each_on_cores(LAST + 1, !is_round_, [&](size_t line) {
        for (size_t column = 0; column < columns; ++column) {
            const glm::dvec2 place =
                is_round_ ? glm::dvec2(line, 0.0) : glm::dvec2(double(column) - LAST, line);
            nodes_[line * columns + column] = sum_moments(lobe, view_of_square(place / double(LAST)).omega_o);
        }
    });
}

Moments WeightedLobe::node(int x, int y) const {
    return nodes_[size_t(y * (2 * LAST + 1) + x + LAST)];
}

Moments WeightedLobe::at(glm::dvec2 square) const {
    const glm::dvec2 place = double(LAST) * square;
    if (is_round_) {
        const int low = std::min(int(place.x), LAST - 1);
        return mix(nodes_[size_t(low)], nodes_[size_t(low) + 1], place.x - low);
    }
    const int x = std::min(int(std::floor(place.x)), LAST - 1), y = std::min(int(place.y), LAST - 1);
    return mix(mix(node(x, y), node(x + 1, y), place.x - x),
               mix(node(x, y + 1), node(x + 1, y + 1), place.x - x), place.y - y);
}

} // namespace burnish
