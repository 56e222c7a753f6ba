#include "burnish/sampling/matched_view_table.h"

#include <algorithm>
#include <cmath>

#include "burnish/cores.h"
#include "burnish/sampling/matched_table.h"
#include "burnish/sampling/prefilter_table.h"
#include "shared/constants.h"

namespace burnish {
namespace {

constexpr double LEAST_COS_O = 1e-4;
constexpr double LEAST_LIT = 1e-8;  ///< trace of a cosine that kernels leave below the horizon
constexpr double LEAST_GAIN = 1e-9; ///< a component that reflects less lies below the horizon

/// Where components of one view lie. A slope y1 axis1 + y2 axis2 (y in units of the lobe's principal axes on
/// the map) is a half-vector n + slope.
struct LobeMap {
    glm::dvec2 axis1, axis2;
    double rho;    ///< of the principal axes
    double linear; ///< b^2/c
};

/// Widths of the mirrored lobe on the sphere (maths: section 6): V of the singular value decomposition of
/// L = 2 [ex mx, ey my; -ey mx c, ex my c].
LobeMap map_lobe(glm::dvec2 roughness, glm::dvec3 omega_o, glm::dvec2 e) {
    const glm::dvec2 along = glm::dvec2(omega_o) * roughness, e2 = e * e, m2 = roughness * roughness;
    const double floored = std::max(omega_o.z, 0.03), c2 = floored * floored + glm::dot(along, along);
    const double p = 4.0 * m2.x * (e2.x + e2.y * c2), s = 4.0 * m2.y * (e2.y + e2.x * c2);
    const double area = 4.0 * roughness.x * roughness.y, off = area * e.x * e.y * (1.0 - c2);
    const double half_sum = 0.5 * (p + s), half_difference = 0.5 * (p - s);
    const double radius = std::hypot(half_difference, off), major2 = half_sum + radius;
    const double product = area * std::sqrt(c2);
    // Of equal axes every pair would do: then the first is the plane of view, not what rounding makes of it.
    const bool is_round = radius <= 2e-12 * half_sum;
    const double angle =
        is_round ? std::atan2(e.y * roughness.y, e.x * roughness.x) : 0.5 * std::atan2(off, half_difference);
    const glm::dvec2 v1(std::cos(angle), std::sin(angle));
    return {roughness * v1, roughness * glm::dvec2(-v1.y, v1.x), std::max(major2 / product, 1.0),
            area * product / major2};
}

struct Point {
    double x, y, share;
};
/// Centre and four corners: exact to the third degree, and of the rules of up to nine points the one that
/// errs least on wide lobes.
constexpr double CORNER = 1.0954451150103321; // sqrt(1.2)
constexpr Point POINTS[] = {{0.0, 0.0, 4.0 / 24.0},
                            {CORNER, CORNER, 5.0 / 24.0},
                            {CORNER, -CORNER, 5.0 / 24.0},
                            {-CORNER, CORNER, 5.0 / 24.0},
                            {-CORNER, -CORNER, 5.0 / 24.0}};

struct Mean {
    double base = 0.0, schlick = 0.0, gain = 0.0;
    glm::dvec3 direction{0.0};
};

class Row {
public:
    /// `e`: the plane of view in the lobe's axes.
    Row(const MatchedLobe& lobe, double cos_o, glm::dvec2 e) : lobe_(lobe) {
        const double sine = std::sqrt(1.0 - cos_o * cos_o);
        omega_o_ = glm::dvec3(sine * e, cos_o);
        map_ = map_lobe({lobe.roughness_x, lobe.roughness_y}, omega_o_, e);
        const glm::dvec2 o(omega_o_), change(glm::dot(o, map_.axis1) / map_.rho, glm::dot(o, map_.axis2));
        const double steepness = glm::length(change);
        const glm::dvec2 u = steepness > 1e-7 ? change / steepness : glm::dvec2(0.0, 1.0);
        steepest_ = u.x / map_.rho * map_.axis1 + u.y * map_.axis2;
    }

    double rho() const { return map_.rho; }

    /// Entry and Schlick term of the component at sign * (y1, y2).
    std::pair<glm::vec4, float> entry(glm::dvec4 mixture, double sign) const {
        const glm::dvec2 slope = sign * (mixture.x * map_.axis1 + mixture.y * map_.axis2);
        const Mean mean = mean_of(slope, mixture.z);
        if (mean.gain < LEAST_GAIN) return {glm::vec4(0.0f), 0.0f};
        const double length = glm::length(mean.direction);
        const double variance = std::min(variance_of(slope, mixture.z), 1.0);
        const glm::dvec3 half_vector = mean.direction / length + omega_o_;
        const glm::dvec2 h = glm::dvec2(half_vector) / half_vector.z;
        // The cosine that the kernel puts back in.
        const double lit = (1.0 + glm::dot(h, h)) * mean.direction.z / length;
        const double weight = mixture.w * mean.base / std::pow(std::max(lit, LEAST_LIT), 1.0 - lobe_.alpha);
        return {glm::vec4(h, weight, spherical_level(variance, lobe_.face_size)),
                float(mean.schlick / mean.base)};
    }

private:
    /// MATCHED_VARIANCE_SHARE of what the linear map makes of the component, (s b)^2 (o.h) cos_h^3/c. The
    /// lengths are of the points one deviation to either side along the direction in which cos_i changes
    /// most.
    double variance_of(glm::dvec2 slope, double s) const {
        const glm::dvec2 h = s * steepest_;
        const double og = std::max(omega_o_.z + glm::dot(glm::dvec2(omega_o_), slope), 0.0);
        const glm::dvec2 one = slope + h, other = slope - h;
        return shared::MATCHED_VARIANCE_SHARE * s * s * map_.linear * og /
               ((1.0 + glm::dot(one, one)) * (1.0 + glm::dot(other, other)));
    }

    /// Means over a component of deviation s/rho and s along the principal axes.
    Mean mean_of(glm::dvec2 slope, double s) const {
        Mean mean;
        for (const Point& point : POINTS) {
            const glm::dvec2 offset = point.x / map_.rho * map_.axis1 + point.y * map_.axis2;
            const glm::dvec3 g(slope + s * offset, 1.0);
            const double length2 = glm::dot(g, g), og = glm::dot(omega_o_, g);
            const glm::dvec3 omega_i = 2.0 * og / length2 * g - omega_o_;
            if (omega_i.z <= 0.0 || og <= 0.0) continue;
            const double cos_power = lobe_.alpha == 0.0f ? omega_i.z : std::pow(omega_i.z, 1.0 - lobe_.alpha);
            const double length = std::sqrt(length2), weight = point.share * cos_power * length;
            const double rest = std::clamp(1.0 - og / length, 0.0, 1.0), rest2 = rest * rest;
            const double schlick = rest2 * rest2 * rest;
            const double gain = weight * (lobe_.specular + lobe_.grazing * schlick);
            mean.base += weight;
            mean.schlick += weight * schlick;
            mean.gain += gain;
            mean.direction += gain * omega_i;
        }
        return mean;
    }

    MatchedLobe lobe_;
    glm::dvec3 omega_o_;
    LobeMap map_;
    glm::dvec2 steepest_; ///< slope of one deviation of s = 1 along which cos_i changes most
};

/// The row of view j, see build_matched_view_table.
Row row_of(const MatchedLobe& lobe, uint32_t j) {
    const int columns = int(view_columns(lobe)), last = int(view_count(lobe)) / columns - 1;
    const int middle = columns / 2;
    // Of a round lobe the only column is the plane of view.
    const glm::dvec2 node =
        columns == 1 ? glm::dvec2(j, 0.0) : glm::dvec2(int(j) % columns - middle, int(j) / columns);
    const double radius = std::max(std::abs(node.x), node.y) / last;
    const double root = 0.5 * (std::sqrt(9.0 - 8.0 * radius * radius) - 1.0);
    return {lobe, std::max(root * root, LEAST_COS_O),
            radius > 0.0 ? glm::normalize(node) : glm::dvec2(1.0, 0.0)};
}

} // namespace

bool fits_view_table(glm::vec2 roughness) {
    return std::max(roughness.x, roughness.y) <=
           shared::MATCHED_MOST_VIEW_ASPECT * std::min(roughness.x, roughness.y);
}

uint32_t view_columns(const MatchedLobe& lobe) {
    return lobe.roughness_x == lobe.roughness_y ? 1 : 2 * shared::MATCHED_VIEW_NODES - 1;
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

std::vector<glm::vec4> build_matched_view_table(const MatchedLobe& lobe) {
    const std::vector<glm::vec4> mixtures = matched_mixtures(lobe.samples);
    const uint32_t half = (lobe.samples + 1) / 2, entries = view_row_entries(lobe);
    const uint32_t columns = view_columns(lobe), lines = view_count(lobe) / columns;
    std::vector<glm::vec4> table(view_table_entries(lobe), glm::vec4(0.0f));
    const auto place = [&](uint32_t j) {
        const Row row = row_of(lobe, j);
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
    return table;
}

} // namespace burnish
