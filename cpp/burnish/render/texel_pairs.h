// Maps as our own lookup reads them: pairs of texels in a buffer (glsl/shared/texel_pairs.h).
#pragma once

#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/element_buffer.h"

#include <map>
#include <memory>

namespace burnish {

/// Packs cube arrays into pairs. Not for several threads at once.
class TexelPairs {
public:
    explicit TexelPairs(std::shared_ptr<const vulkan::Device> device);

    /// Records the packing of every level that `cubes` has; values stay what they are, but the mean of three
    /// texels at a cube's corner is rounded to half. `cubes` is a cube array of RGBA16F in
    /// SHADER_READ_ONLY_OPTIMAL, and is so afterwards. It and this object must live until the commands are
    /// done.
    vulkan::ElementBuffer record(vulkan::Commands& commands, vulkan::Image& cubes,
                                 vulkan::ElementAccess access);

private:
    struct Pipelines {
        vulkan::ComputePipeline inside, border;
    };
    const Pipelines& pipelines(vulkan::ElementAccess access);

    std::shared_ptr<const vulkan::Device> device_;
    vulkan::Shader shader_;
    std::map<vulkan::ElementAccess, Pipelines> pipelines_;
    // Of the last call: the cubes as they lie in memory, level by level.
    vulkan::ElementBuffer texels_;
    vulkan::DescriptorSet set_;
};

} // namespace burnish
