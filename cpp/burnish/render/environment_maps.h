// A set of environments on the device: one cube array with all levels.
#pragma once

#include "burnish/render/prefilter.h"
#include "burnish/render/pyramid.h"
#include "burnish/render/texel_pairs.h"
#include "burnish/scene/environment.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace burnish {

class EnvironmentMaps {
public:
    /// Uploads the environments, all of one face size, as RGBA16F rounded to nearest even, and makes their
    /// pyramids; without a filter level 0 alone. With `prefilter` the levels are prefiltered from the
    /// pyramids instead. With `packer` the maps are packed for the software lookup too, and what is
    /// prefiltered is read by it. Rotation and exposure stay with the environments: they are applied when a
    /// map is looked up. Throws std::invalid_argument if there is none, if one is null or of another size, if
    /// prefiltered maps are to come without a filter, or if the device's images have too few layers.
    EnvironmentMaps(std::shared_ptr<const vulkan::Device> device, Pyramid& pyramid,
                    std::span<const std::shared_ptr<const Environment>> environments,
                    std::optional<PyramidFilter> filter, Prefilter* prefilter = nullptr,
                    PrefilterKernel kernel = PrefilterKernel::lobe, TexelPairs* packer = nullptr);

    /// The packed maps; a null handle where they were not packed.
    const vulkan::TexelView& pairs() const { return pairs_.view; }

    /// In SHADER_READ_ONLY_OPTIMAL; view() is the cube array, or the cube where there is one only.
    const vulkan::Image& image() const { return image_; }
    uint32_t face_size() const { return image_.settings().width; }
    uint32_t count() const { return image_.settings().layers / 6; }
    uint32_t level_count() const { return image_.settings().levels; }
    /// "upload", as the host sees it, "pyramid", "prefilter" and "pack", as the device does, where they were
    /// made.
    const std::vector<vulkan::PassTime>& pass_times() const { return pass_times_; }

    /// One cube's levels as stored, finest first: 6 n n 3 floats each (face, row, column, channel).
    std::vector<std::vector<float>> read_levels(uint32_t cube);

private:
    vulkan::Image image_;
    PairBuffer pairs_;
    std::vector<vulkan::PassTime> pass_times_;
};

} // namespace burnish
