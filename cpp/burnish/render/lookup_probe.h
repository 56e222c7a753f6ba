// Times of both lookups on a CPU device, whose drivers differ in which is faster.
#pragma once

#include "burnish/plan/map_lookup.h"

namespace burnish::vulkan {
class Device;
}

namespace burnish::render {

/// Makes the same lookups by both, in turn, on a device of its own beside `device`: neither its memory limit
/// nor validation are in the way. Some 50 ms where the driver keeps compiled kernels, 200 ms where it
/// compiles them. Throws VulkanError.
LookupMeasurement measure_lookups(const vulkan::Device& device);

/// What was measured on this driver by this version of the engine: in this process, or else by an earlier one
/// and kept in the user's cache (lookup_record.h), or else now, and kept. What the driver refuses is the
/// measurement's failure.
LookupMeasurement find_lookup_measurement(const vulkan::Device& device);

} // namespace burnish::render
