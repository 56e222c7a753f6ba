// A set of environments on the device: one cube array with all levels.
#pragma once

#include "burnish/light/environment.h"
#include "burnish/render/prefilter.h"
#include "burnish/render/pyramid.h"
#include "burnish/vulkan/element_buffer.h"

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace burnish {

/// Where maps lie on the device.
struct MapRoom {
    vulkan::Image image;
    vulkan::ElementBuffer pairs; ///< a single one where maps are not packed

    uint64_t memory_bytes() const;
};

/// What maps are made with, kept for the next ones. Not for several threads at once.
class MapTools {
public:
    explicit MapTools(std::shared_ptr<const vulkan::Device> device)
        : device_(std::move(device)), pyramid_(device_) {}

    const std::shared_ptr<const vulkan::Device>& device() const { return device_; }
    Pyramid& pyramid() { return pyramid_; }
    Prefilter& prefilter();
    /// Room for maps of such faces: what was kept, if it is just that. Fresh memory takes longer to be had
    /// than to be filled.
    MapRoom take_room(const vulkan::ImageSettings& settings, MapLookup lookup);
    /// Keeps the room of maps that are no longer wanted for the next ones, unless it is large.
    void keep_room(MapRoom room);
    /// Gives back what is only kept for the next maps.
    void free();
    /// Gives back room for maps of other sizes, where there is much. To be called before a map is begun.
    void free_surplus();

private:
    std::shared_ptr<const vulkan::Device> device_;
    Pyramid pyramid_;
    std::unique_ptr<Prefilter> prefilter_; // once a map calls for it
    std::optional<MapRoom> spare_;
};

struct MapSettings {
    std::optional<PyramidFilter> filter;   ///< of the pyramid; none: level 0 alone
    std::optional<PrefilterKernel> kernel; ///< levels prefiltered from the pyramid; none: the pyramid itself
    /// Of the software lookups: packed for it, too, and what is prefiltered is read by it.
    MapLookup lookup = MapLookup::sampler;

    bool operator==(const MapSettings&) const = default;
};

class EnvironmentMaps {
public:
    /// Uploads the environments, all of one face size, as RGBA16F, each over the unit of its HalfRange and
    /// rounded to nearest even, and makes their levels. Rotation, exposure and unit are applied when a map is
    /// looked up. Throws std::invalid_argument if there is none, if one is null or of another size, if
    /// prefiltered maps are to come without a filter, or if the device's images have too few layers.
    EnvironmentMaps(MapTools& tools, std::span<const std::shared_ptr<const Environment>> environments,
                    const MapSettings& settings);

    /// Puts other environments of the same face size in the place of some and makes their levels alone; what
    /// was read before must be done. Of each, the place and what comes there.
    void replace(MapTools& tools,
                 std::span<const std::pair<uint32_t, std::shared_ptr<const Environment>>> changed);

    /// Makes room for more cubes, which hold nothing yet; those there are stay what they are. What was read
    /// before must be done.
    void grow(MapTools& tools, uint32_t cube_count);

    /// The packed maps; a single pair where they were not packed.
    const vulkan::ElementBuffer& pairs() const { return room_.pairs; }

    /// In SHADER_READ_ONLY_OPTIMAL; view() is the cube array, or the cube where there is one only.
    const vulkan::Image& image() const { return room_.image; }
    uint32_t face_size() const { return image().settings().width; }
    uint32_t count() const { return image().settings().layers / 6; }
    uint32_t level_count() const { return image().settings().levels; }
    uint64_t memory_bytes() const { return room_.memory_bytes(); }
    /// Of what was made last: "upload" and "pack", as the host sees them, "pyramid" and "prefilter", as the
    /// device does.
    const std::vector<vulkan::PassTime>& pass_times() const { return pass_times_; }

    /// One cube's levels as lookups see them, finest first: 6 n n 3 floats each (face, row, column, channel).
    std::vector<std::vector<float>> read_levels(uint32_t cube);

    /// For MapTools::keep_room; nothing else may be asked of the maps then.
    MapRoom release_room() && { return std::move(room_); }

private:
    /// Uploads cubes from `first_cube` on and makes their levels.
    void make(MapTools& tools, uint32_t first_cube,
              std::span<const std::shared_ptr<const Environment>> environments);

    MapSettings settings_;
    MapRoom room_;
    std::vector<int> half_exponents_; // by cube
    std::vector<vulkan::PassTime> pass_times_;
};

} // namespace burnish
