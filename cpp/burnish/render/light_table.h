// The direct lights of a plan, as kernels read them.
#pragma once

#include "burnish/plan/plan.h"
#include "burnish/vulkan/buffer.h"

namespace burnish::render {

struct LightTable {
    vulkan::Buffer lights; ///< LightRecord each
    vulkan::TexelView rows;
    uint32_t count = 0;
};

/// `origin`: what positions are relative to.
LightTable make_light_table(const vulkan::DevicePointer& device, const Plan& plan, const glm::dvec3& origin);

} // namespace burnish::render
