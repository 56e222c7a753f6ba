// Which shade kernel a class of the plan gets, and what it is specialised by.
#pragma once

#include "burnish/plan/plan.h"
#include "burnish/render/pipelines.h"
#include "burnish/render/shade_tables.h"

namespace burnish::render {

/// Where a kernel finds its surface points and leaves what they show.
struct ShadeTarget {
    bool is_points = false;         ///< a list of points, else pixels of a G-buffer
    bool is_display = false;        ///< 8-bit sRGB, else linear radiance
    bool counts_non_finite = false; ///< see ShadeInputs
    bool is_dark = false;           ///< no direct light reaches it
};

/// Lists of tiles by class and of the background; then, where some lights end, those that none reaches.
uint32_t first_dark_list(const Plan& plan);
uint32_t tile_list_count(const Plan& plan);

/// The pipeline that shades a class of the plan by the plan's sampler.
ComputeKey shade_key(const Plan& plan, const ShadeTables& tables, uint32_t shade_class, ShadeTarget target);

/// The pipeline that shades it by the reference.
ComputeKey reference_key(const Plan& plan, uint32_t shade_class, ShadeTarget target, bool is_quadrature);

/// Which lookup the kernel compiles, and for which size of faces.
void add_lookup_constants(vulkan::SpecializationConstants& constants, const MapSet& set);

} // namespace burnish::render
