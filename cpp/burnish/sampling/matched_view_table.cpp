#include "burnish/sampling/matched_view_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/sampling/matched_table.h"
#include "burnish/sampling/prefilter_table.h"
#include "shared/constants.h"

namespace burnish {
namespace {

constexpr double LEAST_COS_O = 1e-4;
constexpr double LEAST_GAIN = 1e-9; ///< a component that reflects less lies below the horizon

struct Mean {
    double base = 0.0, schlick = 0.0, gain = 0.0;
    glm::dvec3 direction{0.0};
};

struct Point {
    double x, y, share;
};
/// Centre and four corners: exact to the third degree, and of the rules of up to nine points the one that
/// errs least on wide lobes.
constexpr double CORNER = 1.0954451150103321; // sqrt(1.2)
constexpr std::array<Point, 5> POINTS = {{{0.0, 0.0, 4.0 / 24.0},
                                          {CORNER, CORNER, 5.0 / 24.0},
                                          {CORNER, -CORNER, 5.0 / 24.0},
                                          {-CORNER, CORNER, 5.0 / 24.0},
                                          {-CORNER, -CORNER, 5.0 / 24.0}}};

/// Means of the component at `slope` with a `deviation` along each axis.
Mean component_mean(const MatchedLobe& lobe, glm::dvec3 omega_o, glm::dvec2 slope, glm::dvec2 deviation) {
    Mean mean;
    for (const Point& point : POINTS) {
        const glm::dvec3 g(slope.x + point.x * deviation.x, slope.y + point.y * deviation.y, 1.0);
        const double length2 = glm::dot(g, g), og = glm::dot(omega_o, g);
        const glm::dvec3 omega_i = 2.0 * og / length2 * g - omega_o;
        if (omega_i.z <= 0.0 || og <= 0.0) continue;
        const double cos_power = lobe.alpha == 0.0f ? omega_i.z : std::pow(omega_i.z, 1.0 - lobe.alpha);
        const double weight = point.share * cos_power * std::sqrt(length2);
        const double schlick = std::pow(std::clamp(1.0 - og / std::sqrt(length2), 0.0, 1.0), 5.0);
        const double gain = weight * (lobe.specular + lobe.grazing * schlick);
        mean.base += weight;
        mean.schlick += weight * schlick;
        mean.gain += gain;
        mean.direction += gain * omega_i;
    }
    return mean;
}

/// Levels that a lookup gains where centres lie far apart against their widths (maths: section 6).
double level_shift(const MatchedLobe& lobe, double rho) {
    const double t = std::min(3.0, rho / lobe.samples);
    const double wide = std::clamp(lobe.roughness - 0.15, 0.0, 0.45);
    return -0.08 + 0.22 * t + 0.3 * std::max(0.0, t - 1.0) + 0.36 * wide;
}

class Row {
public:
    Row(const MatchedLobe& lobe, double cos_o) : lobe_(lobe) {
        omega_o_ = {std::sqrt(1.0 - cos_o * cos_o), 0.0, cos_o};
        const double floored = std::max(cos_o, 0.03), along = omega_o_.x * lobe.roughness;
        foreshortening_ = std::sqrt(floored * floored + along * along);
        // Slopes are 1 at most, so the lobe is never longer across the plane of view than in it.
        rho_ = 1.0 / foreshortening_;
        minor_ = 2.0 * lobe.roughness * foreshortening_;
        shift_ = level_shift(lobe, rho_);
    }

    double rho() const { return rho_; }

    /// Entry and Schlick term of the component at sign * (y1, y2).
    std::pair<glm::vec4, float> entry(glm::dvec4 mixture, double sign) const {
        const glm::dvec2 slope = sign * double(lobe_.roughness) * glm::dvec2(mixture);
        const glm::dvec2 deviation = double(lobe_.roughness) * mixture.z * glm::dvec2(1.0 / rho_, 1.0);
        const Mean mean = component_mean(lobe_, omega_o_, slope, deviation);
        if (mean.gain < LEAST_GAIN) return {glm::vec4(0.0f), 0.0f};
        const double length = glm::length(mean.direction);
        const glm::dvec3 g(slope, 1.0);
        const double linear = std::pow(mixture.z * minor_, 2.0) * std::max(glm::dot(omega_o_, g), 0.0) /
                              (std::pow(glm::dot(g, g), 2.0) * foreshortening_);
        const double variance = std::clamp(-std::log(std::min(length / mean.gain, 1.0)), 0.5 * linear, 1.0);
        const glm::dvec3 direction = mean.direction / length;
        const glm::dvec3 mirror(-omega_o_.x, 0.0, omega_o_.z), t1(omega_o_.z, 0.0, omega_o_.x);
        const double near = 1.0 + glm::dot(direction, mirror);
        return {glm::vec4(glm::dot(direction, t1) / near, direction.y / near, mixture.w * mean.base,
                          spherical_level(variance * std::exp2(2.0 * shift_), lobe_.face_size)),
                float(mean.schlick / mean.base)};
    }

private:
    MatchedLobe lobe_;
    glm::dvec3 omega_o_;
    double foreshortening_, rho_, minor_, shift_;
};

} // namespace

uint32_t view_row_entries(const MatchedLobe& lobe) {
    return lobe.samples + (lobe.has_schlick ? (lobe.samples + 3) / 4 : 0);
}

std::vector<glm::vec4> build_matched_view_table(const MatchedLobe& lobe) {
    const std::vector<glm::vec4> mixtures = matched_mixtures(lobe.samples);
    const uint32_t half = (lobe.samples + 1) / 2, entries = view_row_entries(lobe);
    std::vector<glm::vec4> table(size_t(shared::MATCHED_ROWS) * entries, glm::vec4(0.0f));
    for (uint32_t j = 0; j < shared::MATCHED_ROWS; ++j) {
        const double root = double(j) / (shared::MATCHED_ROWS - 1);
        const Row row(lobe, std::max(root * root, LEAST_COS_O));
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
    }
    return table;
}

} // namespace burnish
