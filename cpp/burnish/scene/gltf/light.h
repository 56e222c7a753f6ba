// Lights of a glTF file (KHR_lights_punctual); used by the gltf_*.cpp files only.
#pragma once

#include <optional>

#include "burnish/light/direct_light.h"
#include "burnish/scene/gltf/document.h"

namespace burnish::gltf {

/// The light of a node, none where it has none. It shines along the node's -z and is not scaled; candela and
/// lux are taken for W/sr and W/m^2. One that makes no sense is left out, with a warning.
std::optional<DirectLight> light_of(const Document& document, int node, const glm::dmat4& world_from_node,
                                    std::vector<std::string>& warnings);

} // namespace burnish::gltf
