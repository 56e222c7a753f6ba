#include "burnish/render/lookup_record.h"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "burnish/error.h"

namespace burnish::render {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string from_environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

json with_key(const LookupKey& key) {
    return {{"device", key.device}, {"driver", key.driver}, {"uuid", key.uuid}, {"engine", key.engine}};
}

/// By FNV-1a of the key, which the file holds as well.
fs::path file_of(const fs::path& folder, const LookupKey& key) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (const unsigned char byte : with_key(key).dump(-1, ' ', true, json::error_handler_t::replace))
        hash = (hash ^ byte) * 0x100000001b3u;
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return folder / (std::string("lookup-") + digits + ".json");
}

} // namespace

std::optional<fs::path> cache_folder() {
    const std::string own = from_environment("BURNISH_CACHE");
    if (own == "off") return std::nullopt;
    if (!own.empty()) return own;
    const fs::path caches = from_environment("XDG_CACHE_HOME"); // the standard ignores one that is relative
    if (caches.is_absolute()) return caches / "burnish";
    const fs::path home = from_environment("HOME");
    if (home.is_absolute()) return home / ".cache" / "burnish";
    return std::nullopt;
}

std::optional<LookupMeasurement> read_measurement(const fs::path& folder, const LookupKey& key) {
    const fs::path path = file_of(folder, key);
    std::ifstream file(path);
    if (!file) return std::nullopt;
    const json kept = json::parse(file, nullptr, false);
    const auto has = [&](const json& wanted) {
        for (const auto& [name, value] : wanted.items())
            if (!kept.contains(name) || kept[name] != value) return false;
        return true;
    };
    if (!kept.is_object() || !has(with_key(key))) return std::nullopt;
    const auto number = [&](const char* name) {
        const auto found = kept.find(name);
        return found != kept.end() && found->is_number() ? found->get<double>() : 0.0;
    };
    LookupMeasurement result;
    result.sampler_ms = number("sampler_ms");
    result.software_ms = number("software_ms");
    const auto date = kept.find("date");
    if (!(result.sampler_ms > 0) || !(result.software_ms > 0) || !std::isfinite(result.ratio()) ||
        date == kept.end() || !date->is_string())
        return std::nullopt;
    result.date = date->get<std::string>();
    result.kept_in = path.string();
    return result;
}

void keep_measurement(const fs::path& folder, const LookupKey& key, LookupMeasurement& measurement) {
    const fs::path path = file_of(folder, key);
    static std::atomic<uint32_t> count = 0; // several threads may be at it
    const fs::path part = message(path.string(), ".", getpid(), "-", ++count, ".part");
    json kept = with_key(key);
    kept["sampler_ms"] = measurement.sampler_ms;
    kept["software_ms"] = measurement.software_ms;
    kept["date"] = measurement.date;
    std::error_code error;
    fs::create_directories(folder, error);
    std::ofstream file(part);
    file << kept.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
    file.close();
    if (file) fs::rename(part, path, error);
    if (file && !error) {
        measurement.kept_in = path.string();
    } else {
        fs::remove(part, error);
    }
}

} // namespace burnish::render
