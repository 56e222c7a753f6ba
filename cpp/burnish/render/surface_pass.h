// Rasterises a scene once into the G-buffer.
#pragma once

#include "burnish/plan/plan.h"
#include "burnish/render/frame_targets.h"
#include "burnish/render/gpu_scene.h"
#include "burnish/render/pipelines.h"
#include "burnish/vulkan/commands.h"
#include "shared/records.h"

namespace burnish::render {

/// Descriptors and pipelines of all draws of a plan; lives while its commands may run.
class SurfacePass {
public:
    /// `eye`: the camera's place, which all draws are relative to.
    SurfacePass(Pipelines& pipelines, GpuScene& gpu_scene, const Scene& scene, const Plan& plan,
                const glm::dvec3& eye, const FrameTargets& targets);
    void record(vulkan::Commands& commands, FrameTargets& targets) const;

    bool has_draws() const { return !draws_.empty(); }
    /// Whether some object may lie in the view: false where the boxes of all are outside of it.
    bool may_show(const glm::mat4& clip_from_world) const;

    /// What no coordinate of a corner in clip space exceeds, as seen by `clip_from_world`.
    double clip_reach(const glm::mat4& clip_from_world) const;

private:
    struct Draw {
        const vulkan::GraphicsPipeline* pipeline;
        const vulkan::DescriptorSet* set;
        shared::DrawRecord record;
        MeshRange range;
    };

    void add_records(const vulkan::DevicePointer& device, const Scene& scene, const Plan& plan);
    const vulkan::GraphicsPipeline& pipeline_for(Pipelines& pipelines, const Material& material,
                                                 bool is_varying, bool is_mirrored) const;
    const vulkan::DescriptorSet& set_for(const vulkan::GraphicsPipeline& pipeline, const Material& material,
                                         uint32_t key, bool is_varying, const FrameTargets& targets);

    GpuScene& gpu_scene_;
    bool has_varying_ = false, has_all_targets_ = false, has_tangent_ = false;
    vulkan::Buffer surface_records_, texture_records_;
    vulkan::TexelView surface_rows_, texture_rows_;
    std::map<std::pair<uint32_t, const void*>, vulkan::DescriptorSet> sets_;
    std::vector<Draw> draws_;
};

} // namespace burnish::render
