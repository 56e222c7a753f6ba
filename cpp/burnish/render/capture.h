// The surroundings of a point as an environment of their own.
#pragma once

#include <memory>
#include <optional>

#include "burnish/render/renderer.h"

namespace burnish::render {

/// Renders the six faces around `point` (world space): diffuse light by the scene's environment, emission
/// and, where no object is, the far environment. Lobes are left out. `without_object` is not drawn. Throws
/// std::invalid_argument unless face_size is a power of two in 1..2048 and the point finite.
std::shared_ptr<Environment> capture(Renderer& renderer, const Scene& scene, glm::dvec3 point,
                                     uint32_t face_size, std::optional<uint32_t> without_object);

} // namespace burnish::render
