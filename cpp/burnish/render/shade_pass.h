// Shades surface points: pixels of a G-buffer, or a list of points. One specialised pipeline for each class
// of the plan.
#pragma once

#include <functional>
#include <vector>

#include "burnish/plan/plan.h"
#include "burnish/render/environment_maps.h"
#include "burnish/render/light_table.h"
#include "burnish/render/pipelines.h"
#include "burnish/render/placeholders.h"
#include "burnish/render/shade_tables.h"
#include "burnish/render/shade_variant.h"
#include "burnish/render/surface_pass.h"
#include "burnish/vulkan/commands.h"

namespace burnish::render {

/// What shading reads and writes besides the tables. Without `targets`, points.
struct ShadeInputs {
    FrameTargets* targets = nullptr;
    const vulkan::Buffer* points = nullptr;   ///< SurfacePoint each
    uint32_t point_count = 0;                 ///< or of pixels
    const vulkan::Buffer* radiance = nullptr; ///< vec4 a pixel or point, and one more
    const vulkan::Buffer* counters = nullptr;
    const vulkan::Buffer* display = nullptr; ///< a byte a channel, likewise: then nothing goes to `radiance`
    float display_scale = 1.0f;
    const LightTable* lights = nullptr;
    bool counts_non_finite = false; ///< and blackens; else it is only found out that there was some
};

/// Buffers that only a reference needs.
struct ReferenceBuffers {
    vulkan::Buffer statistics; ///< vec4 a pixel or point
    const vulkan::Buffer* alias =
        nullptr; ///< TexelAlias tables of all maps, one after the other; progressive only
    bool is_quadrature = false;
};

/// Groups of a dispatch in rows of equal length; a few may be left over.
struct GroupRows {
    uint32_t length, count;
};
GroupRows fold_groups(uint64_t groups);

class ShadePass {
public:
    /// `maps`: one for each map set of the plan.
    ShadePass(Pipelines& pipelines, const Plan& plan, const ShadeTables& tables,
              const std::vector<std::shared_ptr<EnvironmentMaps>>& maps, const ShadeInputs& inputs,
              const Placeholders& unused, const ReferenceBuffers* reference);

    /// Lists the tiles of every class; pixels only.
    void record_tiles(vulkan::Commands& commands) const;
    /// Lists the lights that reach each tile or group of points, where the plan says so.
    void record_light_lists(vulkan::Commands& commands) const;
    /// One pass. `push` is completed with what the inputs say.
    void record_class(vulkan::Commands& commands, uint32_t shade_class, shared::ShadeRecord push) const;
    /// Those of all classes.
    void record_shade(vulkan::Commands& commands, shared::ShadeRecord push) const;
    void record_background(vulkan::Commands& commands) const;
    /// Once, before all others: nothing that is not finite was met or counted.
    void record_start(vulkan::Commands& commands) const;
    /// Blackens the picture: what no pass will draw.
    void record_clear(vulkan::Commands& commands) const;
    /// Whether something that is not finite was met and, as it was not to be counted, left out.
    bool left_out_non_finite() const;

private:
    struct Stage {
        const vulkan::ComputePipeline* pipeline;
        vulkan::DescriptorSet set;
        uint32_t tile_list;
    };

    Stage make_stage(Pipelines& pipelines, const std::string& shader,
                     const vulkan::SpecializationConstants& constants, uint32_t tile_list,
                     const EnvironmentMaps* maps, const ReferenceBuffers* reference);
    /// Tiles, or groups of points.
    uint32_t light_list_count() const;
    void dispatch(vulkan::Commands& commands, const Stage& stage, shared::ShadeRecord push) const;
    const vulkan::Buffer& output() const { return inputs_.display ? *inputs_.display : *inputs_.radiance; }
    VkDeviceSize pixel_bytes() const { return inputs_.display ? sizeof(uint32_t) : sizeof(glm::vec4); }
    /// Without the pixel behind its end.
    VkDeviceSize output_bytes() const { return inputs_.point_count * pixel_bytes(); }

    const ShadeTables& tables_;
    ShadeInputs inputs_;
    const Placeholders& unused_;
    vulkan::Sampler sampler_, depth_sampler_;
    bool is_reference_;
    std::vector<std::vector<Stage>> classes_; ///< each for lit tiles, and for those that no light reaches
    std::vector<Stage> background_;
    std::vector<Stage> tile_stages_;
    std::vector<Stage> light_stages_;
    vulkan::Buffer light_lists_;
};

} // namespace burnish::render
