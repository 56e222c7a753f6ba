// The part of Renderer that makes environment maps and keeps them for later frames.
#include <algorithm>
#include <optional>

#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"

namespace burnish::render {
namespace {

/// Maps of environments that take turns stay on the device.
constexpr uint64_t MOST_MAP_BYTES = uint64_t{1} << 30;

std::string describe_maps(size_t count, const Environment& first) {
    const uint32_t size = first.face_size();
    return message(count, count == 1 ? " map" : " maps", " with faces of ", size, " x ", size, " texels");
}

std::optional<PrefilterKernel> kernel_of(MapLevels levels) {
    switch (levels) {
    case MapLevels::spherical:
        return PrefilterKernel::spherical;
    case MapLevels::lobe:
        return PrefilterKernel::lobe;
    case MapLevels::none:
    case MapLevels::pyramid:
        return std::nullopt;
    }
    return std::nullopt;
}

} // namespace

bool Renderer::CachedMaps::is_expired() const {
    return std::ranges::any_of(environments, [](const auto& one) { return one.expired(); });
}

std::optional<Renderer::ChangedPlaces> Renderer::CachedMaps::changed_places(const WantedMaps& wanted) const {
    const bool is_alike = !wanted.settings.filter || settings == wanted.settings;
    if (!is_alike || environments.size() != wanted.environments.size() ||
        maps->face_size() != wanted.environments.front()->face_size())
        return std::nullopt;
    ChangedPlaces places;
    for (uint32_t k = 0; k < environments.size(); ++k) {
        if (environments[k].lock() == wanted.environments[k]) continue;
        if (!environments[k].expired()) return std::nullopt;
        places.emplace_back(k, wanted.environments[k]);
    }
    // Nothing would be kept: they are as well made together.
    if (places.size() == environments.size()) return std::nullopt;
    return places;
}

std::vector<std::shared_ptr<EnvironmentMaps>> Renderer::prepare_maps(const Plan& plan,
                                                                     std::vector<vulkan::PassTime>& times) {
    MapSettings wanted;
    if (plan.has_lookups && plan.sampler.levels != MapLevels::none) wanted.filter = plan.settings.filter;
    if (plan.has_lookups) wanted.kernel = kernel_of(plan.sampler.levels);
    std::vector<WantedMaps> sets;
    for (const MapSet& set : plan.map_sets) {
        wanted.lookup = set.lookup;
        sets.push_back({{}, wanted});
        for (const uint32_t k : set.environments)
            sets.back().environments.push_back(plan.environments[k]);
    }
    std::erase_if(maps_, [&](const CachedMaps& cached) {
        const auto takes_over = [&](const WantedMaps& one) { return cached.changed_places(one).has_value(); };
        if (!cached.is_expired() || std::ranges::any_of(sets, takes_over)) return false;
        if (cached.maps.use_count() == 1) map_tools_.keep_room(std::move(*cached.maps).release_room());
        return true;
    });
    std::vector<std::shared_ptr<EnvironmentMaps>> result;
    for (const WantedMaps& set : sets) {
        // Those of which the fewest have changed.
        auto best = maps_.end();
        ChangedPlaces changed;
        for (auto cached = maps_.begin(); cached != maps_.end(); ++cached) {
            std::optional<ChangedPlaces> places = cached->changed_places(set);
            if (!places || (best != maps_.end() && places->size() >= changed.size())) continue;
            best = cached;
            changed = std::move(*places);
        }
        const auto needing_memory = [&](const auto& work) {
            return needing_memory_for(describe_maps(set.environments.size(), *set.environments.front()),
                                      work);
        };
        if (best != maps_.end()) {
            std::rotate(best, best + 1, maps_.end());
            CachedMaps& cached = maps_.back();
            if (!changed.empty()) {
                needing_memory([&] {
                    cached.maps->replace(map_tools_, changed);
                    return 0;
                });
                add_pass_times(times, cached.maps->pass_times());
                cached.environments.assign(set.environments.begin(), set.environments.end());
            }
            result.push_back(cached.maps);
            continue;
        }
        forget_old_maps();
        const auto maps = needing_memory(
            [&] { return std::make_shared<EnvironmentMaps>(map_tools_, set.environments, set.settings); });
        add_pass_times(times, maps->pass_times());
        maps_.push_back({{set.environments.begin(), set.environments.end()}, set.settings, maps});
        result.push_back(maps);
    }
    return result;
}

void Renderer::forget_old_maps() {
    uint64_t bytes = 0;
    size_t kept = 0;
    for (; kept < maps_.size(); ++kept) {
        bytes += maps_[maps_.size() - 1 - kept].maps->memory_bytes();
        if (bytes > MOST_MAP_BYTES) break;
    }
    maps_.erase(maps_.begin(), maps_.end() - std::ptrdiff_t(kept));
}

std::vector<std::vector<float>> Renderer::pyramid(const std::shared_ptr<const Environment>& environment,
                                                  PyramidFilter filter,
                                                  std::vector<vulkan::PassTime>* times) {
    const auto lock = enter();
    return within_memory(describe_maps(1, *environment), [&] {
        EnvironmentMaps maps(map_tools_, std::span(&environment, 1), {.filter = filter, .kernel = {}});
        if (times) *times = maps.pass_times();
        return maps.read_levels(0);
    });
}

std::vector<std::vector<float>> Renderer::prefiltered(PrefilterKernel kernel,
                                                      const std::shared_ptr<const Environment>& environment,
                                                      PyramidFilter filter,
                                                      std::vector<vulkan::PassTime>* times) {
    const auto lock = enter();
    return within_memory(describe_maps(1, *environment), [&] {
        const MapLookup lookup = lookup_.of(environment->face_size(), 1);
        EnvironmentMaps maps(map_tools_, std::span(&environment, 1), {filter, kernel, lookup});
        if (times) *times = maps.pass_times();
        return maps.read_levels(0);
    });
}

} // namespace burnish::render
