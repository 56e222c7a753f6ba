#include "burnish/lobe/lafortune.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/check.h"
#include "burnish/lobe/quadrature.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;
constexpr int NODES = 64, FEW_NODES = 24;

/// Mean of the cosine to the normal, 0 below the horizon, around a circle at the angle of `cosine` about an
/// axis that has the cosine c.
double mean_cosine(double c, double cosine) {
    const double middle = c * cosine, reach = std::sqrt((1.0 - c * c) * (1.0 - cosine * cosine));
    if (middle >= reach) return middle;
    if (middle <= -reach) return 0.0;
    const double end = std::acos(-middle / reach);
    return (middle * end + reach * std::sin(end)) / PI;
}

/// 2 pi/(n+1) H, the albedo over |p|^n: H is the mean of the cosine over exp(-r^2) = cos^(n+1), uniform in
/// 0..1.
template <int nodes>
glm::dvec2 integrate(const LobeShape& shape, glm::dvec3 omega_o) {
    static const Quadrature<nodes> shares = graded<nodes>();
    const auto& [x, y, z, exponent] = shape.own;
    const glm::dvec3 p = glm::dvec3(x, y, z) * omega_o;
    const double length = glm::length(p);
    if (length < 1e-15) return glm::dvec2(0.0);
    double sum = 0.0;
    for (int k = 0; k < nodes; ++k) {
        const double cosine = std::pow(1.0 - shares.x[k], 1.0 / (exponent + 1.0));
        sum += shares.weight[k] * mean_cosine(std::clamp(p.z / length, -1.0, 1.0), cosine);
    }
    return {2.0 * PI / (exponent + 1.0) * sum, 0.0};
}

glm::dvec2 albedo(const LobeShape& shape, glm::dvec3 omega_o, bool is_quick) {
    return is_quick ? integrate<FEW_NODES>(shape, omega_o) : integrate<NODES>(shape, omega_o);
}

/// |p| and p_z depend on the azimuth as a width does.
glm::dvec2 albedo_width(const LobeShape& shape) {
    return {std::abs(shape.own[0]), std::abs(shape.own[1])};
}

constexpr LobeModel LAFORTUNE = {
    .name = "Lafortune",
    .id = shared::MODEL_LAFORTUNE,
    .density = Density::gaussian,
    .has_fixed_half_vectors = false,
    .view = nullptr,
    .albedo = albedo,
    .albedo_width = albedo_width,
};

} // namespace

void validate(const LafortuneLobe& lobe, const std::string& prefix) {
    for (int axis = 0; axis < 3; ++axis)
        require_range(prefix + "c", lobe.c[axis], -1e3f, 1e3f);
    require_range(prefix + "exponent", lobe.exponent, 0.0f, MOST_LAFORTUNE_EXPONENT);
    require_non_negative(prefix + "weight", lobe.weight);
    require_finite(prefix + "rotation", lobe.rotation);
}

LobeFacts facts(const LafortuneLobe& lobe) {
    LobeFacts facts;
    const float width = 0.5f * std::sqrt(2.0f / (lobe.exponent + 1.0f));
    facts.shape = {.model = &LAFORTUNE,
                   .width_x = width,
                   .width_y = width,
                   .own = {lobe.c.x, lobe.c.y, lobe.c.z, lobe.exponent}};
    facts.is_brushed = lobe.is_anisotropic();
    return facts;
}

shared::LobeRecord record(const LafortuneLobe& lobe) {
    return make_record(facts(lobe).shape, lobe.weight, glm::vec3(1.0f), glm::vec3(1.0f), lobe.rotation);
}

} // namespace burnish
