#include "burnish/lobe/kurt.h"

#include <algorithm>
#include <cmath>

#include "burnish/check.h"

namespace burnish {
namespace {

float mean(glm::vec3 v) {
    return (v.r + v.g + v.b) / 3.0f;
}

} // namespace

void validate(const KurtLobe& lobe, const std::string& prefix) {
    require_range(prefix + "roughness", lobe.roughness.x, MIN_LOBE_ROUGHNESS, 1.0f);
    require_range(prefix + "roughness", lobe.roughness.y, MIN_LOBE_ROUGHNESS, 1.0f);
    require_unit(prefix + "r0", lobe.r0);
    require_range(prefix + "alpha", lobe.alpha, 0.0f, 1.0f);
    require_non_negative(prefix + "weight", lobe.weight);
    if (!std::isfinite(lobe.rotation))
        throw std::invalid_argument(
            message(prefix, "rotation: expected a finite number, got ", lobe.rotation));
}

LobeFacts facts(const KurtLobe& lobe) {
    LobeFacts facts;
    facts.width = lobe.roughness;
    facts.is_brushed = lobe.is_anisotropic();
    facts.has_fresnel = lobe.has_fresnel();
    facts.gains_energy = lobe.conserve_energy && lobe.alpha > 0.0f; // with alpha = 0 nothing is gained
    facts.alpha = lobe.alpha;
    facts.alpha_form = lobe.alpha == 0.0f   ? shared::ALPHA_ZERO
                       : lobe.alpha == 0.5f ? shared::ALPHA_HALF
                                            : shared::ALPHA_GENERAL;
    const float specular = mean(lobe.weight * lobe.r0), total = mean(lobe.weight);
    if (lobe.has_fresnel() && total > 0.0f) {
        // Some direction must come out even where nothing is reflected.
        facts.specular = std::clamp(specular / total, 1e-3f, 1.0f);
        facts.grazing = 1.0f - facts.specular;
    }
    return facts;
}

shared::LobeRecord record(const KurtLobe& lobe) {
    shared::LobeRecord record{};
    record.specular = glm::vec4(lobe.weight * lobe.r0, lobe.roughness.x);
    record.grazing = glm::vec4(lobe.weight * (1.0f - lobe.r0), lobe.roughness.y);
    record.alpha = lobe.alpha;
    record.rotation_cos = std::cos(lobe.rotation);
    record.rotation_sin = std::sin(lobe.rotation);
    record.albedo_width_nodes = 1;
    record.conserves_energy = lobe.conserve_energy ? 1 : 0;
    return record;
}

} // namespace burnish
