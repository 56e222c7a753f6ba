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

/// A lobe lies so where nothing weighs it.
const Moments UNWEIGHTED = {glm::dvec2(0.0), glm::dvec3(0.5, 0.0, 0.5)};

Moments sum_moments(const LobeShape& shape, glm::dvec3 omega_o) {
    double sum = 0.0;
    glm::dvec2 first(0.0);
    glm::dvec3 second(0.0);
    for (int j = -SUM_REACH; j <= SUM_REACH; ++j)
        for (int i = -SUM_REACH; i <= SUM_REACH; ++i) {
            const glm::dvec2 p = SUM_STEP * glm::dvec2(i, j);
            const double value =
                grey_of(shape, shape.model->view->at(shape, omega_o, p)) * std::exp(-glm::dot(p, p));
            sum += value;
            first += value * p;
            second += value * glm::dvec3(p.x * p.x, p.x * p.y, p.y * p.y);
        }
    if (sum <= 0.0) return UNWEIGHTED;
    const glm::dvec2 mean = first / sum;
    return {mean, second / sum - glm::dvec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y)};
}

/// Slope of the half-vector in the middle of mixtures.
glm::dvec2 middle_slope(const LobeShape& shape, glm::dvec3 omega_o) {
    const double share = shape.model->view->moment_share(shape);
    const glm::dvec2 middle = share > 0.0 ? share * sum_moments(shape, omega_o).mean : glm::dvec2(0.0);
    const glm::dvec3 h = shape.model->view->at(shape, omega_o, middle).omega_i + omega_o;
    return glm::dvec2(h) / h.z;
}

Moments mix(const Moments& one, const Moments& other, double share) {
    return {glm::mix(one.mean, other.mean, share), glm::mix(one.covariance, other.covariance, share)};
}

} // namespace

double grey_of(const LobeShape& shape, const LobePoint& point) {
    return point.base * (shape.specular + shape.grazing * point.schlick);
}

SquareView view_of_square(glm::dvec2 square) {
    const double radius = std::max(std::abs(square.x), std::abs(square.y));
    const double root = 0.5 * (std::sqrt(9.0 - 8.0 * radius * radius) - 1.0);
    // Along the normal there is no plane of view: the first axis serves.
    const glm::dvec2 e = radius > 0.0 ? glm::normalize(square) : glm::dvec2(1.0, 0.0);
    const double cos_o = std::max(root * root, LEAST_COS_O);
    return {glm::dvec3(std::sqrt(1.0 - cos_o * cos_o) * e, cos_o), e};
}

glm::vec2 lobe_drift(const LobeShape& shape) {
    const glm::dvec3 along = view_of_square({DRIFT_RADIUS, 0.0}).omega_o;
    const glm::dvec3 across = view_of_square({0.0, DRIFT_RADIUS}).omega_o;
    const double x = middle_slope(shape, along).x / along.x;
    const double y = shape.is_round() ? x : middle_slope(shape, across).y / across.y;
    return glm::unpackHalf2x16(glm::packHalf2x16(glm::vec2(x, y)));
}

WeightedLobe::WeightedLobe(const LobeShape& shape)
    : is_round_(shape.is_round()), share_(shape.model->view->moment_share(shape)) {
    if (share_ <= 0.0) return;
    const size_t columns = is_round_ ? 1 : 2 * LAST + 1;
    nodes_.resize(columns * (LAST + 1));
    for_each_on_cores(LAST + 1, !is_round_, [&](size_t line) {
        for (size_t column = 0; column < columns; ++column) {
            const glm::dvec2 place =
                is_round_ ? glm::dvec2(line, 0.0) : glm::dvec2(double(column) - LAST, line);
            nodes_[line * columns + column] =
                sum_moments(shape, view_of_square(place / double(LAST)).omega_o);
        }
    });
}

Moments WeightedLobe::node(int x, int y) const {
    return nodes_[size_t(y * (2 * LAST + 1) + x + LAST)];
}

Moments WeightedLobe::at(glm::dvec2 square) const {
    if (nodes_.empty()) return UNWEIGHTED;
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
