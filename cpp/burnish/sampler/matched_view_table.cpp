#include "burnish/sampler/matched_view_table.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <glm/gtc/packing.hpp>

#include "burnish/cores.h"
#include "burnish/sampler/matched_table.h"
#include "burnish/sampler/prefilter_table.h"
#include "burnish/sampler/weighted_lobe.h"
#include "shared/constants.h"

namespace burnish {
namespace {

constexpr double LEAST_LIT = 1e-8;  ///< trace of a cosine that kernels leave below the horizon
constexpr double LEAST_GAIN = 1e-9; ///< a component that reflects less lies below the horizon

/// Components of one view lie here: center + y1 axis1 + y2 axis2 is a place in the lobe's plane.
struct Place {
    glm::dvec2 center, axis1, axis2;
    double rho; ///< aspect of the axes once they are reflected
};

/// Over what is reflected of the lobe, a share of the way there. (2 S)^1/2 carries the lobe to
/// where it lies, S its covariance; principal axes of the reflection there are those of V of the singular
/// value decomposition. Of round lobes they are the plane of view and across it, whichever is longer: around
/// the normal of a wide one that changes, and a step would show.
Place place_over(const LobeShape& shape, const SquareView& view, const Moments& moments, double share) {
    const glm::dvec3 doubled = 2.0 * share * moments.covariance + (1.0 - share) * glm::dvec3(1.0, 0.0, 1.0);
    const double determinant = std::sqrt(doubled.x * doubled.z - doubled.y * doubled.y);
    const double scale = 1.0 / std::sqrt(doubled.x + doubled.z + 2.0 * determinant);
    const glm::dmat2 root(scale * glm::dvec2(doubled.x + determinant, doubled.y),
                          scale * glm::dvec2(doubled.y, doubled.z + determinant));
    Place place;
    place.center = share * moments.mean;
    const glm::dmat2 map = shape.model->view->linear_map(shape, view.omega_o, place.center) * root;
    const glm::dvec2 e = view.e;
    glm::dvec2 v1 = e;
    if (shape.is_round()) {
        place.rho = std::max(glm::length(map * e) / glm::length(map * glm::dvec2(-e.y, e.x)), 1.0);
    } else {
        const double p = glm::dot(map[0], map[0]), s = glm::dot(map[1], map[1]);
        const double off = glm::dot(map[0], map[1]), radius = std::hypot(0.5 * (p - s), off);
        // Any pair of axes would do where they are equal.
        if (radius > 1e-12 * (p + s)) {
            const double angle = 0.5 * std::atan2(2.0 * off, p - s);
            v1 = {std::cos(angle), std::sin(angle)};
        }
        place.rho = std::max((0.5 * (p + s) + radius) / std::abs(glm::determinant(map)), 1.0);
    }
    place.axis1 = root * v1;
    place.axis2 = root * glm::dvec2(-v1.y, v1.x);
    return place;
}

struct Point {
    double x, y, share;
};

/// Points of a hexagonal grid within a reach, each with the share of the normal density there, of variance 1.
std::vector<Point> hexagon_points(double step, double reach) {
    std::vector<Point> points;
    double shares = 0.0, second = 0.0;
    const int most = int(2.0 * reach / step);
    for (int j = -most; j <= most; ++j)
        for (int i = -most; i <= most; ++i) {
            const double x = step * (i + 0.5 * j), y = step * std::sqrt(0.75) * j;
            if (x * x + y * y > reach * reach + 1e-9) continue;
            const double share = std::exp(-0.5 * (x * x + y * y));
            points.push_back({x, y, share});
            shares += share;
            second += share * x * x;
        }
    for (Point& point : points)
        point = {point.x * std::sqrt(shares / second), point.y * std::sqrt(shares / second),
                 point.share / shares};
    return points;
}

/// Points of a mean over a component, in its deviations. Six around the centre are exact to the fifth degree.
/// Wide lobes have 37: each that the horizon passes from one view to the next would be a step.
std::span<const Point> points_of(const LobeShape& shape) {
    static const double step_of_seven = std::sqrt(2.0 * std::log(6.0));
    static const std::vector<Point> seven = hexagon_points(step_of_seven, step_of_seven);
    static const std::vector<Point> many = hexagon_points(0.95, 2.9);
    return std::max(shape.width_x, shape.width_y) > shared::MATCHED_WIDE_SLOPE ? many : seven;
}

struct Mean {
    double base = 0.0, schlick = 0.0, gain = 0.0;
    glm::dvec3 direction{0.0};
};

class Row {
public:
    Row(const MatchedLobe& lobe, const WeightedLobe& weighted, MixtureTable table, glm::vec2 drift,
        glm::dvec2 square)
        : shape_(lobe.shape), face_size_(lobe.face_size), table_(table), points_(points_of(lobe.shape)),
          lit_exponent_(shape_.model->view->lit_exponent(shape_)) {
        const SquareView view = view_of_square(square);
        omega_o_ = view.omega_o;
        place_ = place_over(shape_, view, weighted.at(square), weighted.share());
        const glm::dvec2 o(omega_o_), narrow = place_.axis1 / place_.rho, m = shape_.width();
        const glm::dvec2 change(glm::dot(o, m * narrow), glm::dot(o, m * place_.axis2));
        const double steepness = glm::length(change);
        const glm::dvec2 u = steepness > 1e-7 ? change / steepness : glm::dvec2(0.0, 1.0);
        steepest_ = u.x * narrow + u.y * place_.axis2;
        offset_ = glm::dvec2(drift) * o;
        const double less =
            shared::MATCHED_NARROW_LESS - shared::MATCHED_NARROW_LESS_OF_ONE / float(lobe.samples);
        const double fall = std::exp(-shared::MATCHED_NARROW_DECAY * m.x * m.y);
        variance_share_ = shared::MATCHED_VARIANCE_SHARE * (1.0 - less * fall / place_.rho);
        area_ = std::abs(place_.axis1.x * place_.axis2.y - place_.axis1.y * place_.axis2.x);
    }

    double rho() const { return place_.rho; }

    /// Entry and Schlick term of the component at sign * (y1, y2).
    std::pair<glm::vec4, float> entry(glm::dvec4 mixture, double sign) const {
        const glm::dvec2 y = sign * glm::dvec2(mixture);
        const Mean mean = mean_of(y, mixture.z);
        if (mean.gain < LEAST_GAIN) return {glm::vec4(0.0f), 0.0f};
        const double length = glm::length(mean.direction);
        const double variance = std::clamp(shared::MATCHED_LEAST_SPREAD_SHARE * (1.0 - length / mean.gain),
                                           linear_variance(y, mixture.z), 1.0);
        const glm::dvec3 half_vector = mean.direction / length + omega_o_;
        const glm::dvec2 h = glm::dvec2(half_vector) / half_vector.z;
        // The cosine that the kernel puts back in.
        const double lit = (1.0 + glm::dot(h, h)) * mean.direction.z / length;
        const double weight = mixture.w * mean.base / std::pow(std::max(lit, LEAST_LIT), lit_exponent_);
        return {glm::vec4(h - offset_, weight, spherical_level(variance, face_size_)),
                float(mean.schlick / mean.base)};
    }

private:
    glm::dvec2 place_of(glm::dvec2 y) const {
        return place_.center + y.x * place_.axis1 + y.y * place_.axis2;
    }

    /// A share of what the linear map makes of the component, s^2 |axis1 x axis2|/rho times the stretch
    /// between the points one deviation to either side along the direction in which cos_i changes most; at
    /// most 1, what the sphere holds.
    double linear_variance(glm::dvec2 y, double s) const {
        const glm::dvec2 p = place_of(y), h = s * steepest_;
        const double stretch = shape_.model->view->stretch(shape_, omega_o_, p + h, p - h);
        return std::min(variance_share_ * s * s * area_ / place_.rho * stretch, 1.0);
    }

    /// Means over a component of deviation s/rho and s along the axes. A point weighs the lobe's density over
    /// the mixture's.
    Mean mean_of(glm::dvec2 y, double s) const {
        Mean mean;
        for (const Point& point : points_) {
            const glm::dvec2 at = y + s * glm::dvec2(point.x / place_.rho, point.y), p = place_of(at);
            const LobePoint light = shape_.model->view->at(shape_, omega_o_, p);
            if (light.base <= 0.0) continue;
            const double share = point.share * area_ * table_.ratio(glm::dot(p, p), glm::dot(at, at));
            const double grey = share * grey_of(shape_, light);
            mean.base += share * light.base;
            mean.schlick += share * light.base * light.schlick;
            mean.gain += grey;
            mean.direction += grey * light.omega_i;
        }
        return mean;
    }

    LobeShape shape_;
    uint32_t face_size_;
    MixtureTable table_;
    glm::dvec3 omega_o_;
    std::span<const Point> points_;
    double lit_exponent_;
    Place place_;
    glm::dvec2 offset_;     ///< that kernels add to slopes
    glm::dvec2 steepest_;   ///< place of one deviation of s = 1 along which cos_i changes most
    double area_;           ///< |axis1 x axis2|
    double variance_share_; ///< of the linear map's variance, what a component has
};

/// Place on the square of row j, see build_matched_view_table.
glm::dvec2 square_of(const MatchedLobe& lobe, uint32_t j) {
    const int columns = int(view_columns(lobe)), last = int(view_count(lobe)) / columns - 1;
    const int middle = columns / 2;
    // Of a round lobe the only column is the plane of view.
    const glm::dvec2 node =
        columns == 1 ? glm::dvec2(j, 0.0) : glm::dvec2(int(j) % columns - middle, int(j) / columns);
    return node / double(last);
}

} // namespace

bool fits_view_table(glm::vec2 roughness) {
    return std::max(roughness.x, roughness.y) <=
           shared::MATCHED_MOST_VIEW_ASPECT * std::min(roughness.x, roughness.y);
}

uint32_t view_columns(const MatchedLobe& lobe) {
    return lobe.shape.is_round() ? 1 : 2 * shared::MATCHED_VIEW_NODES - 1;
}

uint32_t view_count(const MatchedLobe& lobe) {
    const uint32_t columns = view_columns(lobe);
    return columns == 1 ? shared::MATCHED_ROWS : shared::MATCHED_VIEW_NODES * columns;
}

uint32_t view_row_entries(const MatchedLobe& lobe) {
    return lobe.samples + (lobe.has_schlick ? (lobe.samples + 3) / 4 : 0);
}

uint64_t view_table_entries(const MatchedLobe& lobe) {
    return uint64_t(view_count(lobe)) * view_row_entries(lobe);
}

ViewTable build_matched_view_table(const MatchedLobe& lobe) {
    const double width = std::max(lobe.shape.width_x, lobe.shape.width_y);
    const MixtureTable mixture_table = MixtureTable::of(lobe.shape.model->density, width);
    const std::vector<glm::vec4> mixtures = matched_mixtures(lobe.samples, mixture_table);
    const uint32_t half = (lobe.samples + 1) / 2, entries = view_row_entries(lobe);
    const uint32_t columns = view_columns(lobe), lines = view_count(lobe) / columns;
    std::vector<glm::vec4> table(view_table_entries(lobe), glm::vec4(0.0f));
    const WeightedLobe weighted(lobe.shape);
    const glm::vec2 drift = lobe_drift(lobe.shape);
    const auto place = [&](uint32_t j) {
        const Row row(lobe, weighted, mixture_table, drift, square_of(lobe, j));
        const glm::vec4* mixture = &mixtures[size_t(matched_row(row.rho())) * half];
        glm::vec4* const out = &table[size_t(j) * entries];
        for (uint32_t k = 0; k < lobe.samples; ++k) {
            // Of an odd count the centre comes first and once.
            const uint32_t pair = lobe.samples % 2 ? (k + 1) / 2 : k / 2;
            const bool is_other = lobe.samples % 2 ? k > 0 && k % 2 == 0 : k % 2 == 1;
            const auto [entry, schlick] = row.entry(mixture[pair], is_other ? -1.0 : 1.0);
            out[k] = entry;
            if (lobe.has_schlick) out[lobe.samples + k / 4][int(k % 4)] = schlick;
        }
    };
    for_each_on_cores(lines, columns > 1, [&](size_t line) {
        for (uint32_t column = 0; column < columns; ++column)
            place(uint32_t(line) * columns + column);
    });
    return {std::move(table), glm::packHalf2x16(drift)};
}

} // namespace burnish
