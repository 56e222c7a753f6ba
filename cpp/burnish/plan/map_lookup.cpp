#include "burnish/plan/map_lookup.h"

#include <stdexcept>

#include "burnish/error.h"

namespace burnish {

const char* map_lookup_name(MapLookup lookup) {
    return lookup == MapLookup::sampler ? "sampler" : "software";
}

std::optional<MapLookup> map_lookup(const std::string& name) {
    if (name == "auto") return std::nullopt;
    if (name == "sampler") return MapLookup::sampler;
    if (name == "software") return MapLookup::software;
    throw std::invalid_argument(message("lookup: expected auto, sampler or software, got '", name, "'"));
}

uint32_t level_pair_count(uint32_t size) {
    return 6 * (size + 1) * (size + 2);
}

uint64_t cube_pair_count(uint32_t face_size) {
    uint64_t count = 0;
    for (uint32_t size = face_size; size >= 1; size /= 2)
        count += level_pair_count(size);
    return count;
}

MapLookup LookupChoice::of(uint32_t face_size, uint64_t cubes) const {
    return cube_pair_count(face_size) * cubes <= most_pairs ? wanted : MapLookup::sampler;
}

LookupChoice choose_lookup(bool is_software, std::optional<MapLookup> asked, uint64_t most_pairs) {
    if (asked) return {*asked, "asked for", most_pairs};
    if (!is_software) return {MapLookup::sampler, "the device has a sampler in hardware", most_pairs};
    return {MapLookup::software, "the device is a CPU: its sampler would take most of a frame", most_pairs};
}

} // namespace burnish
