// Maps whose levels are no pyramid (glsl/shared/prefilter.h): every level the map as one lobe sees it, or
// under a Gaussian that is round on the sphere.
#pragma once

#include "burnish/light/pyramid_filter.h"
#include "burnish/plan/map_lookup.h"
#include "burnish/render/level_texels.h"
#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/element_buffer.h"

#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace burnish {

enum class PrefilterKernel { lobe, spherical };

/// Makes prefiltered maps from pyramids. Texels are summed in float32 and rounded to the nearest half, ties
/// to even. Not for several threads at once.
class Prefilter {
public:
    explicit Prefilter(std::shared_ptr<const vulkan::Device> device);

    /// Records the work, between begin_pass and end_pass of the caller if it is to be timed. `cubes` is a
    /// cube array of RGBA16F that holds a pyramid made by `filter`, in SHADER_READ_ONLY_OPTIMAL; levels from
    /// 1 on of `cube_count` cubes from `first_cube` on become the prefiltered ones. This object must live,
    /// and record nothing else, until the commands are done. The pyramid is read by `lookup`; `pairs`: the
    /// pyramid packed, or any where the device's sampler reads it.
    void record(vulkan::Commands& commands, vulkan::Image& cubes, uint32_t first_cube, uint32_t cube_count,
                MapLookup lookup, const vulkan::ElementBuffer& pairs, PrefilterKernel kernel,
                PyramidFilter filter);

    /// The levels from 1 on of the cube recorded last, once that is done and until the next call. Empty where
    /// the host does not read the device's memory as fast as its own.
    std::vector<LevelTexels> levels_on_host() const;
    /// Of the room that is kept for the next maps; 0 where it is for maps of one size and kind.
    uint64_t scratch_bytes() const;
    /// Gives it back.
    void free_scratches() {
        scratches_.clear();
        last_ = nullptr;
    }

private:
    struct Level {
        uint32_t size;         // texels along an edge
        uint32_t texel_begin;  // in the buffer of texels
        uint32_t sample_begin; // in the buffer of samples
        uint32_t sample_count;
    };
    /// What all maps of one face size share: levels 1 and on, their samples, and room for those of one cube.
    struct Scratch {
        std::vector<Level> levels;
        vulkan::Buffer samples, texels;
        vulkan::TexelView samples_view;
    };

    using Key = std::tuple<uint32_t, PrefilterKernel, PyramidFilter>; ///< face size first

    const Scratch& scratch(const Key& key);
    const vulkan::ComputePipeline& pipeline(PrefilterKernel kernel, uint32_t face_size, MapLookup lookup);

    std::shared_ptr<const vulkan::Device> device_;
    vulkan::Shader shader_;
    std::map<std::tuple<PrefilterKernel, uint32_t, MapLookup>, vulkan::ComputePipeline> pipelines_;
    vulkan::Sampler sampler_;
    vulkan::DescriptorSet set_; // of the commands recorded last
    const Scratch* last_ = nullptr;
    std::map<Key, Scratch> scratches_;
};

} // namespace burnish
