// The mean of several pictures.
#pragma once

#include <array>
#include <cstdint>

#include "burnish/render/frame_targets.h"
#include "burnish/render/pipelines.h"
#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/descriptor_set.h"

namespace burnish::render {

class AccumulatePass {
public:
    /// The targets take so many pictures; the last one may be stored for a display, its radiance scaled.
    AccumulatePass(Pipelines& pipelines, const FrameTargets& targets, uint32_t picture_count,
                   uint64_t pixel_count, bool has_display, float display_scale);

    /// Adds the picture that was drawn last, counted from 0.
    void record(vulkan::Commands& commands, uint32_t picture) const;

private:
    uint32_t picture_count_;
    uint64_t pixel_count_;
    bool has_display_;
    float display_scale_;
    // Into the sum, and the last picture of display output.
    std::array<const vulkan::ComputePipeline*, 2> pipelines_ = {};
    std::array<vulkan::DescriptorSet, 2> sets_;
};

} // namespace burnish::render
