// Charlie sheen: plain data, and what the engine asks of it.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"

namespace burnish {

/// f = weight D V of KHR_materials_sheen (Estevez and Kulla 2017), alpha = roughness^2: the glow of cloth
/// toward grazing. Divided by its albedo where that exceeds 1: the published fit gains energy where smooth
/// cloth grazes, 1.6 times at a cosine of .02 and an alpha of .01.
struct SheenLobe {
    float roughness = 0.3f; ///< perceptual, as glTF's, in [0, 1]; alpha is MIN_SHEEN_ALPHA at least
    glm::vec3 weight{1.0f}; ///< colour, >= 0
};

constexpr float MIN_SHEEN_ALPHA = 1e-3f;

/// Throws std::invalid_argument, naming field, range and value; `prefix` goes before the field's name.
void validate(const SheenLobe& lobe, const std::string& prefix = "");
LobeFacts facts(const SheenLobe& lobe);
shared::LobeRecord record(const SheenLobe& lobe);

} // namespace burnish
