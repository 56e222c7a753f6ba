// Everything small that shading reads: materials, lobes, map records, sample and albedo tables, in buffers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "burnish/plan/plan.h"
#include "burnish/render/diffuse_light.h"
#include "burnish/render/table_cache.h"
#include "burnish/vulkan/buffer.h"
#include "burnish/vulkan/commands.h"
#include "shared/records.h"

namespace burnish::render {

/// The buffers of one plan.
struct ShadeTables {
    vulkan::Buffer materials, lobes, map_records, albedo;
    vulkan::TexelView material_rows, lobe_rows, map_rows, albedo_texels;
    std::shared_ptr<const SampleBuffer> samples;
    /// By class: entries of every table that it reads; 0 where each has its own count.
    std::vector<uint32_t> class_counts;
    std::vector<std::string> samples_used; ///< by class: "19 (budget 20)", one text for each lobe, joined
    std::shared_ptr<const IrradianceBuffer> irradiance; ///< by environment
    double diffuse_error = 0.0;               ///< relative, of the light on diffuse surfaces: the worst map's
    std::vector<vulkan::PassTime> pass_times; ///< "irradiance", as the host sees it, where it was made
};

/// Of the unit in which the wide G-buffer's halves hold a material's emission where a texture varies it.
int emissive_exponent(const Material& material);

/// `layers`: by environment of the plan, its place among the maps of its size.
ShadeTables make_shade_tables(const vulkan::DevicePointer& device, const Scene& scene, const Plan& plan,
                              const std::vector<uint32_t>& layers, TableCache& cache, DiffuseLights& diffuse);

} // namespace burnish::render
