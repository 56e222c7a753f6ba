// The view a frame is drawn from, as the shaders read it.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "burnish/scene/camera.h"
#include "shared/records.h"

namespace burnish::render {

/// `jitter_px`: offset of the rays from the pixel centres, x right, y down.
shared::ViewRecord make_view(const Camera& camera, uint32_t width, uint32_t height, glm::vec2 jitter_px);

/// Scales clip space so that no coordinate, of which the largest is `clip_reach`, is beyond 2^40: rasterisers
/// multiply three of them, and SwiftShader drops a triangle where that overflows. By a power of two, the same
/// for all corners: after the division by w nothing differs.
void keep_clip_in_range(shared::ViewRecord& view, double clip_reach);

/// Pixel (x right, y down), depth and 1 to what was drawn there, homogeneous, in the world's axes with the
/// origin at the eye.
glm::dmat4 world_from_picture(const Camera& camera, uint32_t width, uint32_t height);

/// Distance along the camera's axis of a reverse-z depth; infinity for 0, where nothing was drawn.
float view_depth(const Camera& camera, float depth);

} // namespace burnish::render
