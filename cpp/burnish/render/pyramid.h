// Mip pyramids of cube maps: every level filtered from the one above it, across the edges of the faces.
#pragma once

#include "burnish/light/environment.h"
#include "burnish/light/pyramid_filter.h"
#include "burnish/render/level_texels.h"
#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/element_buffer.h"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace burnish {

/// Makes all levels below 0 of cubes of a RGBA16F cube array from their level 0.
///
/// A level is filtered from the level above as that is stored, summed in float32 and rounded to the nearest
/// half, ties to even. A tap beyond one edge of a face reads the neighbouring face folded over that edge: as
/// deep inside it as the tap is outside, at the same place along the edge. A tap beyond two edges, (-1-i,
/// -1-j) seen from a corner, has two such folds, over the one edge and then the other: it reads the mean of
/// what lies at (-1-j, i) and at (j, -1-i). Reach is two texels, and the last level that is filtered has two
/// along an edge, so no fold ends outside a face.
///
/// Works in a buffer of its own, kept for the next call: faces of half RGBA with a border, 1.4 times the
/// bytes of the cubes that are done at once (at most about 64 MB, or one cube). Not for several threads at
/// once.
class Pyramid {
public:
    /// Where level 0 is found.
    enum class Finest { in_image, staged };

    explicit Pyramid(std::shared_ptr<const vulkan::Device> device);

    /// Records the work, between begin_pass and end_pass of the caller if it is to be timed. `cubes` is a
    /// cube array of RGBA16F with full levels and a level 0 that is not undefined; layers 6 first_cube and on
    /// are done. Afterwards it is in SHADER_READ_ONLY_OPTIMAL, or still in GENERAL if it was, and all its
    /// levels are visible to later commands. The pyramid must live until the commands are done. Throws
    /// std::invalid_argument naming what does not fit, and VulkanError where the device's buffers are too
    /// small for one such cube.
    void record(vulkan::Commands& commands, vulkan::Image& cubes, uint32_t first_cube, uint32_t cube_count,
                PyramidFilter filter, Finest finest = Finest::in_image);

    /// Where the host sees the device's memory and all cubes of such an image can be done at once: writes
    /// level 0 of the environments, a cube each from `first_cube` on, into the buffer and from there into the
    /// image, so that `record` need not copy it back. Submits and waits. False where that cannot be: upload
    /// the image then.
    bool stage(vulkan::Image& cubes, uint32_t first_cube,
               std::span<const std::shared_ptr<const Environment>> environments, PyramidFilter filter);
    /// All levels of the cubes recorded last, once that is done and until the next call. Empty where they
    /// were not done at once, or where the host does not read the device's memory as fast as its own.
    std::vector<LevelTexels> levels_on_host() const;
    /// Of the room that is kept for the next maps; 0 where it is for maps of one size.
    uint64_t scratch_bytes() const;
    /// Gives it back.
    void free_scratches() {
        scratches_.clear();
        last_ = nullptr;
    }

private:
    /// Invocations of a workgroup of the reduction.
    struct Group {
        uint32_t x, y;
        auto operator<=>(const Group&) const = default;
    };
    static Group best_group(uint32_t size);

    struct Level {
        uint32_t size;  // texels along an edge
        uint32_t begin; // in the buffer, in pairs of texels
    };
    /// Room for all levels of some cubes.
    struct Scratch {
        std::vector<Level> levels;
        vulkan::ElementBuffer pairs;
        vulkan::DescriptorSet border_set, reduce_set;
    };

    const vulkan::ComputePipeline& border(vulkan::ElementAccess access);
    const vulkan::ComputePipeline& reduction(PyramidFilter filter, const Group& group,
                                             vulkan::ElementAccess access);
    /// Cubes that are done at once.
    uint32_t batch_size(uint32_t face_size, uint32_t cube_count) const;
    const Scratch& scratch(uint32_t face_size, uint32_t cube_count, PyramidFilter filter);
    void record_levels(vulkan::Commands& commands, const Scratch& scratch, uint32_t cube_count,
                       PyramidFilter filter);

    std::shared_ptr<const vulkan::Device> device_;
    vulkan::Shader reduce_shader_, border_shader_;
    std::map<vulkan::ElementAccess, vulkan::ComputePipeline> borders_;
    std::map<std::tuple<PyramidFilter, Group, vulkan::ElementAccess>, vulkan::ComputePipeline> reductions_;
    std::map<std::pair<uint32_t, uint32_t>, Scratch> scratches_; // by face size and cubes
    const Scratch* last_ = nullptr; // of the last call, if it did all cubes at once
};

} // namespace burnish
