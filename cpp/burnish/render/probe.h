// Runs single functions of glsl/lib on the device, for tests that compare them with a float64 twin.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "burnish/vulkan/device.h"

namespace burnish::render {

/// Runs function number `function` (glsl/shared/probe.h) of glsl/lib/<library>.glsl once per item.
/// `arguments` holds `argument_count` vec4 an item; the result PROBE_RESULTS vec4 an item, unwritten ones 0.
/// The pipeline is made anew each time. Throws std::invalid_argument for a library there is not and for sizes
/// that do not fit.
std::vector<float> run_probe(const std::shared_ptr<vulkan::Device>& device, const std::string& library,
                             uint32_t function, std::span<const float> arguments, uint32_t argument_count);

} // namespace burnish::render
