// Measured lookups in the user's cache, so that only the first process on a driver measures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "burnish/plan/map_lookup.h"

namespace burnish::render {

/// What a measurement holds for: another driver, device or engine measures anew.
struct LookupKey {
    std::string device, driver, uuid, engine;

    auto operator<=>(const LookupKey&) const = default;
};

/// Where measurements are kept: BURNISH_CACHE, else $XDG_CACHE_HOME/burnish, else ~/.cache/burnish. None
/// where BURNISH_CACHE is "off" or no folder is known.
std::optional<std::filesystem::path> cache_folder();

/// None where nothing was kept for the key, or nothing that can be read.
std::optional<LookupMeasurement> read_measurement(const std::filesystem::path& folder, const LookupKey& key);

/// Writes a file whole or not at all, and says where it is in `kept_in`. A folder that cannot be written to
/// is no error.
void keep_measurement(const std::filesystem::path& folder, const LookupKey& key,
                      LookupMeasurement& measurement);

} // namespace burnish::render
