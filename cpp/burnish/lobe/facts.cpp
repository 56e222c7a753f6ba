#include "burnish/lobe/facts.h"

#include <algorithm>
#include <cmath>

#include "burnish/check.h"

namespace burnish {
namespace {

float mean(glm::vec3 v) {
    return (v.r + v.g + v.b) / 3.0f;
}

} // namespace

void validate_shared(const std::string& prefix, glm::vec2 roughness, glm::vec3 r0, glm::vec3 weight,
                     float rotation) {
    require_range(prefix + "roughness", roughness.x, MIN_LOBE_ROUGHNESS, 1.0f);
    require_range(prefix + "roughness", roughness.y, MIN_LOBE_ROUGHNESS, 1.0f);
    require_unit(prefix + "r0", r0);
    require_non_negative(prefix + "weight", weight);
    require_finite(prefix + "rotation", rotation);
}

void set_fresnel(LobeFacts& facts, glm::vec3 weight, glm::vec3 r0, glm::vec3 f90) {
    facts.has_fresnel = r0 != f90;
    const float specular = mean(weight * r0), along = mean(weight * f90);
    if (!facts.has_fresnel || along <= 0.0f) return;
    // Some direction must come out even where nothing is reflected.
    facts.shape.specular = std::clamp(specular / along, 1e-3f, 1.0f);
    facts.shape.grazing = 1.0f - facts.shape.specular;
}

shared::LobeRecord make_record(const LobeShape& shape, glm::vec3 weight, glm::vec3 r0, glm::vec3 f90,
                               float rotation) {
    shared::LobeRecord record{};
    record.specular = glm::vec4(weight * r0, shape.width_x);
    record.grazing = glm::vec4(weight * (f90 - r0), shape.width_y);
    record.alpha = shape.alpha;
    record.rotation_cos = std::cos(rotation);
    record.rotation_sin = std::sin(rotation);
    record.albedo_width_nodes = 1;
    record.own = glm::vec4(shape.own[0], shape.own[1], shape.own[2], shape.own[3]);
    return record;
}

} // namespace burnish
