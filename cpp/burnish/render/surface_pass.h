// Rasterises a scene once into the G-buffer.
#pragma once

#include "burnish/plan/plan.h"
#include "burnish/render/gpu_scene.h"
#include "burnish/render/pipelines.h"
#include "burnish/vulkan/commands.h"
#include "shared/records.h"

namespace burnish::render {

/// The pictures one frame is made in; kept while the size stays.
struct FrameTargets {
    uint32_t width = 0, height = 0;
    bool has_varying = false;
    bool has_sum = false;
    bool has_display = false;
    uint32_t class_count = 0; ///< that there is room for
    vulkan::Image surface;    ///< RG32UI: see pack_surface in glsl/lib/frame.glsl
    vulkan::Image depth;      ///< D32, reverse z
    vulkan::Image varying_diffuse, varying_specular, varying_emissive; ///< one texel unless has_varying
    vulkan::Image varying_coat; ///< RG32UI, the same: see coat_out in glsl/surface/surface_varying.frag.glsl
    vulkan::Buffer radiance;    ///< vec4 a pixel and one more; one where display output needs no sum
    vulkan::Buffer sum;         ///< vec4 a pixel, with accumulation; else one
    vulkan::Buffer display;     ///< a byte a channel, a pixel and one more, with display output; else one
    vulkan::Buffer tiles;       ///< per class, room for all tiles
    vulkan::Buffer tile_counts; ///< uvec4 a class
    vulkan::Buffer counters;
    vulkan::Buffer view;
    vulkan::TexelView view_rows;
    uint32_t tile_capacity = 0;

    FrameTargets(const vulkan::DevicePointer& device, uint32_t width, uint32_t height, bool has_varying,
                 bool has_sum, bool has_display, uint32_t class_count);
};

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
    bool has_varying_ = false, has_tangent_ = false;
    vulkan::Buffer surface_records_, texture_records_;
    std::map<std::pair<uint32_t, const void*>, vulkan::DescriptorSet> sets_;
    std::vector<Draw> draws_;
};

} // namespace burnish::render
