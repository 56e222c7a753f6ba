// What lies behind bindings that a kernel declares and a plan does not use.
#pragma once

#include "burnish/vulkan/buffer.h"
#include "burnish/vulkan/image.h"

namespace burnish::render {

/// Made once for a device.
struct Placeholders {
    vulkan::Buffer buffer;
    vulkan::TexelView rows;
    vulkan::Image surface, varying, depth;

    explicit Placeholders(const vulkan::DevicePointer& device);
};

} // namespace burnish::render
