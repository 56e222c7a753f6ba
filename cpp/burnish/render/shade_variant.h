// Which shade kernel a class of the plan gets, and what it is specialised by.
#pragma once

#include "burnish/plan/plan.h"
#include "burnish/sampling/sample_table.h"
#include "burnish/vulkan/shader.h"

namespace burnish::render {

/// Entry point for a form of table.
const char* shader_of(TableForm form);

/// What kernels of the plan's samplers and of the reference share.
vulkan::SpecializationConstants common_constants(const ShadeTraits& traits, uint32_t shade_class,
                                                 bool is_points);

/// `table`: of constant form; `buffer_count`: samples of each lobe in buffer or scaled form, 0 for a loop.
void add_pattern_constants(vulkan::SpecializationConstants& constants, const ShadeTraits& traits,
                           const PlanSettings& settings, const SampleTable& table, uint32_t buffer_count);

/// Which lookup the kernel compiles, and for which size of faces.
void add_lookup_constants(vulkan::SpecializationConstants& constants, const MapSet& set);

} // namespace burnish::render
