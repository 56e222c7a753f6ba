#include "burnish/render/map_store.h"

#include <algorithm>
#include <unordered_map>

#include "burnish/error.h"
#include "burnish/render/frame.h"
#include "burnish/vulkan/device.h"

namespace burnish::render {
namespace {

/// Maps of environments that take turns stay on the device.
constexpr uint64_t MOST_MAP_BYTES = uint64_t{1} << 30;

/// Whether one array may have so many cubes: as large as the device and the lookup allow, and as may be kept.
bool may_have(const EnvironmentMaps& maps, uint32_t slots, MapLookup by, const LookupChoice& lookup,
              uint32_t most_layers) {
    return slots <= most_layers / 6 && lookup.of(maps.face_size(), slots) == by &&
           maps.memory_bytes() / maps.count() * slots <= MOST_MAP_BYTES;
}

} // namespace

bool MapStore::Array::has_expired() const {
    return std::ranges::any_of(
        slots, [](const Slot& slot) { return slot.last_used > 0 && slot.environment.expired(); });
}

std::optional<MapStore::Placement> MapStore::place(const Array& array, const WantedMaps& wanted,
                                                   const LookupChoice& lookup, uint32_t most_layers) {
    const MapLookup by = wanted.settings.lookup;
    const bool is_alike =
        wanted.settings.filter ? array.settings == wanted.settings : array.settings.lookup == by;
    if (!is_alike || array.maps->face_size() != wanted.environments.front()->face_size()) return std::nullopt;
    const size_t count = array.slots.size();
    Placement result;
    result.layers.assign(wanted.environments.size(), uint32_t(count));
    std::vector<bool> is_kept(count, false);
    std::unordered_map<const Environment*, uint32_t> slot_of; // every frame asks, of hundreds of maps too
    for (uint32_t slot = 0; slot < count; ++slot)
        if (const auto environment = array.slots[slot].environment.lock())
            slot_of.emplace(environment.get(), slot);
    for (size_t k = 0; k < wanted.environments.size(); ++k) {
        const auto slot = slot_of.find(wanted.environments[k].get());
        if (slot == slot_of.end()) continue;
        result.layers[k] = slot->second;
        is_kept[slot->second] = true;
    }
    // Nothing would be kept: they are as well made together.
    if (std::ranges::none_of(is_kept, [](bool kept) { return kept; })) return std::nullopt;

    // Slots that nothing lives in, then new ones, then those used longest ago.
    std::vector<uint32_t> free, lived_in;
    for (uint32_t slot = 0; slot < count; ++slot)
        if (!is_kept[slot]) (array.slots[slot].environment.expired() ? free : lived_in).push_back(slot);
    const auto missing = size_t(std::ranges::count(result.layers, uint32_t(count)));
    result.slot_count = uint32_t(count);
    if (missing > free.size()) {
        const auto needed = uint32_t(count + missing - free.size());
        for (const uint32_t slots : {std::max(needed, uint32_t(count + count / 2)), needed}) {
            if (!may_have(*array.maps, slots, by, lookup, most_layers)) continue;
            result.slot_count = slots;
            for (auto slot = uint32_t(count); slot < slots; ++slot)
                free.push_back(slot);
            break;
        }
    }
    if (missing > free.size()) {
        std::ranges::stable_sort(lived_in, {}, [&](uint32_t slot) { return array.slots[slot].last_used; });
        free.insert(free.end(), lived_in.begin(), lived_in.end());
    }
    if (missing > free.size()) return std::nullopt;
    auto next = free.begin();
    for (size_t k = 0; k < wanted.environments.size(); ++k) {
        if (result.layers[k] != count) continue;
        result.layers[k] = *next++;
        result.missing.emplace_back(result.layers[k], wanted.environments[k]);
    }
    return result;
}

std::vector<StoredMaps> MapStore::prepare(MapTools& tools, const LookupChoice& lookup,
                                          const std::vector<WantedMaps>& sets) {
    const uint32_t most_layers = tools.device()->limits().maxImageArrayLayers;
    std::erase_if(arrays_, [&](Array& array) {
        const auto serves = [&](const WantedMaps& one) {
            return place(array, one, lookup, most_layers).has_value();
        };
        if (!array.has_expired() || std::ranges::any_of(sets, serves)) return false;
        if (array.maps.use_count() == 1) tools.keep_room(std::move(*array.maps).release_room());
        return true;
    });
    ++now_;
    std::vector<StoredMaps> result;
    for (const WantedMaps& wanted : sets)
        result.push_back(prepare_one(tools, lookup, wanted));
    return result;
}

StoredMaps MapStore::prepare_one(MapTools& tools, const LookupChoice& lookup, const WantedMaps& wanted) {
    const uint32_t most_layers = tools.device()->limits().maxImageArrayLayers;
    auto best = arrays_.end();
    Placement placement;
    for (auto array = arrays_.begin(); array != arrays_.end(); ++array) {
        std::optional<Placement> one = place(*array, wanted, lookup, most_layers);
        if (!one || (best != arrays_.end() && one->missing.size() >= placement.missing.size())) continue;
        best = array;
        placement = std::move(*one);
    }
    StoredMaps result;
    if (best != arrays_.end()) {
        std::rotate(best, best + 1, arrays_.end());
        Array& array = arrays_.back();
        // What the slots hold is not known until all is made: an error may leave it half done.
        for (const auto& [slot, environment] : placement.missing)
            if (slot < array.slots.size()) array.slots[slot] = {};
        if (placement.slot_count > array.slots.size()) {
            array.maps->grow(tools, placement.slot_count);
            array.slots.resize(placement.slot_count);
            result.pass_times = array.maps->pass_times();
        }
        if (!placement.missing.empty()) {
            array.maps->replace(tools, placement.missing);
            add_pass_times(result.pass_times, array.maps->pass_times());
        }
        result.made = uint32_t(placement.missing.size());
        result.layers = std::move(placement.layers);
    } else {
        forget_old();
        const auto maps = std::make_shared<EnvironmentMaps>(tools, wanted.environments, wanted.settings);
        arrays_.push_back({std::vector<Slot>(wanted.environments.size()), wanted.settings, maps});
        result.pass_times = maps->pass_times();
        result.made = uint32_t(wanted.environments.size());
        for (uint32_t k = 0; k < wanted.environments.size(); ++k)
            result.layers.push_back(k);
    }
    Array& array = arrays_.back();
    for (size_t k = 0; k < wanted.environments.size(); ++k)
        array.slots[result.layers[k]] = {wanted.environments[k], now_};
    result.maps = array.maps;
    return result;
}

void MapStore::forget_old() {
    uint64_t bytes = 0;
    size_t kept = 0;
    for (; kept < arrays_.size(); ++kept) {
        bytes += arrays_[arrays_.size() - 1 - kept].maps->memory_bytes();
        if (bytes > MOST_MAP_BYTES) break;
    }
    arrays_.erase(arrays_.begin(), arrays_.end() - std::ptrdiff_t(kept));
}

} // namespace burnish::render
