#include "burnish/plan/map_lookup.h"

#include <cmath>
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
    if (wanted == MapLookup::sampler) return wanted;
    const uint64_t pairs = cube_pair_count(face_size) * cubes;
    if (pairs <= most_texel_pairs) return MapLookup::software;
    return pairs <= most_stored_pairs ? MapLookup::software_stored : MapLookup::sampler;
}

LookupChoice choose_lookup(bool is_software, std::optional<MapLookup> asked, uint64_t most_texel_pairs,
                           uint64_t most_stored_pairs, const std::optional<LookupMeasurement>& measured) {
    LookupChoice choice;
    choice.most_texel_pairs = most_texel_pairs;
    choice.most_stored_pairs = most_stored_pairs;
    if (asked) {
        choice.wanted = *asked;
        choice.reason = "asked for";
    } else if (is_software && measured && measured->failure.empty()) {
        choice.measured = measured;
        choice.wanted = measured->ratio() > MOST_LOOKUP_RATIO ? MapLookup::sampler : MapLookup::software;
        choice.reason = message("the device is a CPU; on its driver lookups of our own take ",
                                std::round(100 * measured->ratio()) / 100,
                                " x the sampler's time, measured on ", measured->date);
    } else if (is_software) {
        choice.wanted = MapLookup::software;
        choice.reason = "the device is a CPU: its sampler would take most of a frame";
        if (measured) choice.reason += "; that could not be measured: " + measured->failure;
    }
    return choice;
}

} // namespace burnish
