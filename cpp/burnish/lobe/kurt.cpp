#include "burnish/lobe/kurt.h"

#include <algorithm>
#include <cmath>

#include "burnish/check.h"
#include "burnish/lobe/albedo_table.h"

namespace burnish {
namespace {

double lit_exponent(const LobeShape& shape) {
    return 1.0 - shape.alpha;
}

/// A half-vector of slope p times the widths mirrors the view.
LobePoint at(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 p) {
    const glm::dvec3 g(shape.width() * p, 1.0);
    const double length2 = glm::dot(g, g), og = glm::dot(omega_o, g);
    const glm::dvec3 omega_i = 2.0 * og / length2 * g - omega_o;
    if (omega_i.z <= 0.0 || og <= 0.0) return {omega_i, 0.0, 0.0};
    const double length = std::sqrt(length2);
    const double cos_power = shape.alpha == 0.0f   ? omega_i.z
                             : shape.alpha == 0.5f ? std::sqrt(omega_i.z)
                                                   : std::pow(omega_i.z, 1.0 - shape.alpha);
    return {omega_i, cos_power * length, schlick_weight(og / length)};
}

/// In the basis of tangents in the plane of o and h and across it the reflection moves by 2 dh and 2 (o.h) dh
/// (maths: section 6).
glm::dmat2 linear_map(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 p) {
    const glm::dvec2 slope = shape.width() * p;
    const double length = std::sqrt(1.0 + glm::dot(slope, slope));
    const glm::dvec3 h = glm::dvec3(slope, 1.0) / length;
    const double o_h = glm::dot(omega_o, h);
    glm::dvec3 t = omega_o - o_h * h;
    t = glm::normalize(glm::length(t) > 1e-9 ? t : glm::cross(glm::dvec3(0.0, 1.0, 0.0), h));
    const glm::dvec3 b = glm::cross(h, t);
    // A change along h has no part along t and b.
    const glm::dvec3 change_x(shape.width_x / length, 0.0, 0.0), change_y(0.0, shape.width_y / length, 0.0);
    return {2.0 * glm::dot(t, change_x), 2.0 * o_h * glm::dot(b, change_x), //
            2.0 * glm::dot(t, change_y), 2.0 * o_h * glm::dot(b, change_y)};
}

/// 4 mx my (o.h) cos_h^3, the lengths of half-vectors those of both places.
double stretch(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 one, glm::dvec2 other) {
    const glm::dvec2 m = shape.width(), slope = m * 0.5 * (one + other);
    const double og = std::max(omega_o.z + glm::dot(glm::dvec2(omega_o), slope), 0.0);
    return 4.0 * m.x * m.y * og /
           ((1.0 + glm::dot(m * one, m * one)) * (1.0 + glm::dot(m * other, m * other)));
}

double moment_share(const LobeShape& shape) {
    return shared::MATCHED_MOMENT_SHARE * std::exp(-shape.width_x * shape.width_y);
}

glm::dvec2 albedo(const LobeShape& shape, glm::dvec3 omega_o, bool is_quick) {
    return directional_albedo(omega_o, shape.width(), shape.alpha, is_quick);
}

constexpr ViewPlane VIEW = {
    .lit_exponent = lit_exponent,
    .at = at,
    .linear_map = linear_map,
    .stretch = stretch,
    .moment_share = moment_share,
};

constexpr LobeModel KURT = {
    .name = "Kurt",
    .id = shared::MODEL_KURT,
    .density = Density::gaussian,
    .has_fixed_half_vectors = true,
    .view = &VIEW,
    .albedo = albedo,
    .albedo_width = plane_width,
};

} // namespace

void validate(const KurtLobe& lobe, const std::string& prefix) {
    validate_shared(prefix, lobe.roughness, lobe.r0, lobe.weight, lobe.rotation);
    require_range(prefix + "alpha", lobe.alpha, 0.0f, 1.0f);
}

LobeFacts facts(const KurtLobe& lobe) {
    LobeFacts facts;
    facts.shape = {
        .model = &KURT, .width_x = lobe.roughness.x, .width_y = lobe.roughness.y, .alpha = lobe.alpha};
    facts.is_brushed = lobe.is_anisotropic();
    facts.scales_energy = lobe.conserve_energy && lobe.alpha > 0.0f; // with alpha = 0 nothing is gained
    facts.alpha_form = lobe.alpha == 0.0f   ? shared::ALPHA_ZERO
                       : lobe.alpha == 0.5f ? shared::ALPHA_HALF
                                            : shared::ALPHA_GENERAL;
    set_fresnel(facts, lobe.weight, lobe.r0, glm::vec3(1.0f));
    return facts;
}

shared::LobeRecord record(const KurtLobe& lobe) {
    shared::LobeRecord record =
        make_record(facts(lobe).shape, lobe.weight, lobe.r0, glm::vec3(1.0f), lobe.rotation);
    record.energy = lobe.conserve_energy ? shared::ENERGY_CONSERVED : shared::ENERGY_AS_IT_IS;
    return record;
}

} // namespace burnish
