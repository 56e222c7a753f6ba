// Which of the two implementations of a lookup (glsl/lookup/map_lookup.glsl) reads the maps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace burnish {

enum class MapLookup {
    sampler,        ///< the device's own
    software,       ///< ours, from pairs of texels in a texel buffer
    software_stored ///< ours, from a storage buffer, several times slower on a CPU: they are more than a
                    ///< texel buffer holds
};

/// "sampler" or "software".
const char* map_lookup_name(MapLookup lookup);
/// None for "auto". Throws std::invalid_argument that lists the names.
std::optional<MapLookup> map_lookup(const std::string& name);

/// Pairs of texels (burnish/render/texel_pairs.h) of one level of a cube, and of all its levels.
uint32_t level_pair_count(uint32_t size);
uint64_t cube_pair_count(uint32_t face_size);

/// Milliseconds that the same lookups take by either, on one driver, of all its threads together.
struct LookupMeasurement {
    double sampler_ms = 0, software_ms = 0;
    std::string date;    ///< 2026-11-30, in UTC
    std::string kept_in; ///< the file that later processes read it from; "" where it could not be kept
    std::string failure; ///< why there are no figures; "" where there are

    /// The time that our lookup takes is divided by the sampler's.
    double ratio() const { return software_ms / sampler_ms; }
};

/// A CPU device reads by ours unless it takes this many times as long as the sampler. Pictures by the two
/// differ in their last digits: which of them is drawn must not hang on a measurement's noise. Lookups alone
/// tell the two farther apart than whole passes do, which shade as well.
constexpr double MOST_LOOKUP_RATIO = 1.1;

/// What a device reads its maps by, and why.
struct LookupChoice {
    MapLookup wanted = MapLookup::sampler;
    std::string reason = "the device has a sampler in hardware";
    std::optional<LookupMeasurement> measured; ///< what decided, where that was it
    uint64_t most_texel_pairs = 0;             ///< that one of its texel buffers holds
    uint64_t most_stored_pairs = 0;            ///< that one of its storage buffers holds

    /// For an array of cubes: the wanted one where buffers can hold them, texel buffers before others.
    MapLookup of(uint32_t face_size, uint64_t cubes) const;
};

/// `asked`: by the user, none for the device's best. `measured`: on a CPU device, none where nothing was.
LookupChoice choose_lookup(bool is_software, std::optional<MapLookup> asked, uint64_t most_texel_pairs,
                           uint64_t most_stored_pairs, const std::optional<LookupMeasurement>& measured = {});

} // namespace burnish
