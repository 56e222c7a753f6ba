// Everything small that shading reads: materials, lobes, map records, sample and albedo tables, in buffers.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "burnish/plan/plan.h"
#include "burnish/sampling/albedo_table.h"
#include "burnish/sampling/matched_view_table.h"
#include "burnish/sampling/sample_table.h"
#include "burnish/vulkan/buffer.h"
#include "shared/records.h"

namespace burnish::render {

using IrradianceCoefficients = std::array<glm::dvec3, 9>;

/// Results that take long enough to be worth keeping from frame to frame.
class TableCache {
public:
    const AlbedoTable& albedo(glm::vec2 roughness, float alpha);
    /// One row for each of ALBEDO_ROUGHNESS_NODES roughnesses.
    const std::vector<glm::vec2>& varying_albedo(float alpha);
    const std::vector<glm::vec4>& mixtures(uint32_t count);
    const std::vector<glm::vec4>& view_table(const MatchedLobe& lobe);
    const IrradianceCoefficients& irradiance(const std::shared_ptr<const Environment>& environment);

private:
    std::map<std::array<float, 3>, AlbedoTable> albedo_;
    std::map<float, std::vector<glm::vec2>> varying_albedo_;
    std::map<uint32_t, std::vector<glm::vec4>> mixtures_;
    std::map<MatchedLobe, std::vector<glm::vec4>> view_tables_;
    struct Irradiance {
        std::weak_ptr<const Environment> environment; // a new one may take an old one's address
        IrradianceCoefficients coefficients;
    };
    std::map<const Environment*, Irradiance> irradiance_;
};

/// The buffers of one plan, and the sample table of each class of constant form.
struct ShadeTables {
    vulkan::Buffer materials, lobes, map_records, samples, albedo;
    vulkan::TexelView material_rows, lobe_rows, map_rows, sample_texels, albedo_texels;
    std::vector<SampleTable> class_tables; ///< by class; of other forms empty
    /// By class: entries of every table that it reads from the buffer; 0 where each has its own count.
    std::vector<uint32_t> class_counts;
    std::vector<std::string> samples_used; ///< by class: "19 (budget 20)", one text for each lobe, joined
};

ShadeTables make_shade_tables(const vulkan::DevicePointer& device, const Scene& scene, const Plan& plan,
                              TableCache& cache);

} // namespace burnish::render
