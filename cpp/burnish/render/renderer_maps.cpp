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

std::vector<std::shared_ptr<EnvironmentMaps>> Renderer::prepare_maps(const Plan& plan,
                                                                     std::vector<vulkan::PassTime>& times) {
    std::erase_if(maps_, [&](const CachedMaps& cached) {
        const bool is_expired = std::any_of(cached.environments.begin(), cached.environments.end(),
                                            [](const auto& one) { return one.expired(); });
        if (is_expired && cached.maps.use_count() == 1)
            map_tools_.keep_room(std::move(*cached.maps).release_room());
        return is_expired;
    });
    MapSettings wanted;
    if (plan.has_lookups && plan.sampler.levels != MapLevels::none) wanted.filter = plan.settings.filter;
    if (plan.has_lookups) wanted.kernel = kernel_of(plan.sampler.levels);
    std::vector<std::shared_ptr<EnvironmentMaps>> result;
    for (const MapSet& set : plan.map_sets) {
        std::vector<std::shared_ptr<const Environment>> environments;
        for (const uint32_t k : set.environments)
            environments.push_back(plan.environments[k]);
        wanted.lookup = set.lookup;
        const auto found = std::find_if(maps_.begin(), maps_.end(), [&](const CachedMaps& cached) {
            return (!wanted.filter || cached.settings == wanted) &&
                   std::equal(cached.environments.begin(), cached.environments.end(), environments.begin(),
                              environments.end(),
                              [](const auto& one, const auto& other) { return one.lock() == other; });
        });
        if (found != maps_.end()) {
            std::rotate(found, found + 1, maps_.end());
            result.push_back(maps_.back().maps);
            continue;
        }
        forget_old_maps();
        const auto maps = needing_memory_for(describe_maps(environments.size(), *environments.front()), [&] {
            return std::make_shared<EnvironmentMaps>(map_tools_, environments, wanted);
        });
        add_pass_times(times, maps->pass_times());
        maps_.push_back({{environments.begin(), environments.end()}, wanted, maps});
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
