// Maps that stay on the device for later frames, each in a slot of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "burnish/plan/map_lookup.h"
#include "burnish/render/environment_maps.h"

namespace burnish::render {

struct WantedMaps {
    std::vector<std::shared_ptr<const Environment>> environments; ///< of one face size, each once
    MapSettings settings;
};

struct StoredMaps {
    std::shared_ptr<EnvironmentMaps> maps;
    std::vector<uint32_t> layers; ///< by environment that was wanted
    uint32_t made = 0;            ///< maps that were not there
    std::vector<vulkan::PassTime> pass_times;
};

/// Makes maps that are missing and nothing else: others keep their slots, in arrays that grow when they are
/// full. Slots of environments that live no more are given to new ones.
class MapStore {
public:
    /// The maps of all sets, which are of different face sizes; in the order given.
    std::vector<StoredMaps> prepare(MapTools& tools, const LookupChoice& lookup,
                                    const std::vector<WantedMaps>& sets);
    void clear() { arrays_.clear(); }

private:
    struct Slot {
        std::weak_ptr<const Environment> environment;
        uint64_t last_used = 0; ///< 0: never
    };
    struct Array {
        std::vector<Slot> slots; ///< by cube
        MapSettings settings;
        std::shared_ptr<EnvironmentMaps> maps;

        bool has_expired() const;
    };
    /// Where wanted maps would lie in an array.
    struct Placement {
        std::vector<uint32_t> layers;
        std::vector<std::pair<uint32_t, std::shared_ptr<const Environment>>> missing; ///< layer and map
        uint32_t slot_count = 0; ///< that the array then has
    };

    /// None where the array keeps nothing that is wanted, was made otherwise, or would be too large.
    static std::optional<Placement> place(const Array& array, const WantedMaps& wanted,
                                          const LookupChoice& lookup, uint32_t most_layers);
    StoredMaps prepare_one(MapTools& tools, const LookupChoice& lookup, const WantedMaps& wanted);
    /// Gives back arrays, those used longest ago first, while all are large.
    void forget_old();

    std::vector<Array> arrays_; // the last used last
    uint64_t now_ = 0;
};

} // namespace burnish::render
