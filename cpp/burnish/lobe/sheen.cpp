#include "burnish/lobe/sheen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/check.h"
#include "burnish/lobe/quadrature.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double LEAST_COS_O = 1e-4, LEAST_COS_I = 1e-3;
/// The plane is that of a cosine about the normal, so wide as a slope of half-vectors.
constexpr float WIDTH = 0.5f;
constexpr int HEIGHTS = 48, FEW_HEIGHTS = 24;
constexpr int AZIMUTHS = 48, FEW_AZIMUTHS = 24; ///< around half of the hemisphere

double mix(double one, double other, double share) {
    return one + (other - one) * share;
}

double curve(double x, double alpha) {
    const double t = (1.0 - alpha) * (1.0 - alpha);
    return mix(21.5473, 25.3245, t) /
               (1.0 + mix(3.82987, 3.32435, t) * std::pow(x, mix(0.19823, 0.16801, t))) +
           mix(-1.97760, -1.27393, t) * x + mix(-4.32054, -4.85967, t);
}

double lambda(double cosine, double alpha) {
    return std::exp(cosine < 0.5 ? curve(cosine, alpha)
                                 : 2.0 * curve(0.5, alpha) - curve(1.0 - cosine, alpha));
}

/// int D V ci over the hemisphere. Nodes crowd toward the horizon, and toward the azimuths of the view.
template <int heights, int azimuths>
glm::dvec2 integrate(const LobeShape& shape, glm::dvec3 omega_o) {
    static const Quadrature<heights> height = graded<heights>();
    static const Quadrature<azimuths> around = gauss_legendre<azimuths>();
    const double alpha = shape.own[0];
    const double co = std::clamp(omega_o.z, LEAST_COS_O, 1.0), sine_o = std::sqrt(1.0 - co * co);
    const double lambda_o = lambda(co, alpha);
    double sum = 0.0;
    for (int j = 0; j < heights; ++j) {
        const double cos_i = height.x[j], ci = std::max(cos_i, LEAST_COS_I);
        const double sine_i = std::sqrt(1.0 - cos_i * cos_i);
        double ring = 0.0;
        for (int k = 0; k < azimuths; ++k) {
            const double phi = PI * around.x[k];
            const glm::dvec3 h = glm::normalize(
                glm::dvec3(sine_i * std::cos(phi) + sine_o, sine_i * std::sin(phi), cos_i + co));
            const double sine2 = std::max(h.x * h.x + h.y * h.y, 1e-30);
            ring += around.weight[k] * std::exp(0.5 / alpha * std::log(sine2));
        }
        sum += height.weight[j] * ring * cos_i / ((1.0 + lambda_o + lambda(ci, alpha)) * 4.0 * co * ci);
    }
    return {(2.0 + 1.0 / alpha) * sum, 0.0}; // 2 pi of azimuths over 2 pi of D
}

glm::dvec2 albedo(const LobeShape& shape, glm::dvec3 omega_o, bool is_quick) {
    return is_quick ? integrate<FEW_HEIGHTS, FEW_AZIMUTHS>(shape, omega_o)
                    : integrate<HEIGHTS, AZIMUTHS>(shape, omega_o);
}

constexpr LobeModel SHEEN = {
    .name = "sheen",
    .id = shared::MODEL_SHEEN,
    .density = Density::gaussian,
    .has_fixed_half_vectors = false,
    .view = nullptr,
    .albedo = albedo,
    .albedo_width = plane_width,
};

} // namespace

void validate(const SheenLobe& lobe, const std::string& prefix) {
    require_range(prefix + "roughness", lobe.roughness, 0.0f, 1.0f);
    require_non_negative(prefix + "weight", lobe.weight);
}

LobeFacts facts(const SheenLobe& lobe) {
    LobeFacts facts;
    const float alpha = std::max(lobe.roughness * lobe.roughness, MIN_SHEEN_ALPHA);
    facts.shape = {.model = &SHEEN, .width_x = WIDTH, .width_y = WIDTH, .own = {alpha, 0.0f, 0.0f, 0.0f}};
    facts.scales_energy = true;
    return facts;
}

shared::LobeRecord record(const SheenLobe& lobe) {
    shared::LobeRecord record =
        make_record(facts(lobe).shape, lobe.weight, glm::vec3(1.0f), glm::vec3(1.0f), 0.0f);
    record.energy = shared::ENERGY_CONSERVED;
    return record;
}

} // namespace burnish
