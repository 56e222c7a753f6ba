// The part of Renderer that makes environment maps and keeps them for later frames.
#include <optional>

#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"

namespace burnish::render {
namespace {

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

Renderer::PreparedMaps Renderer::prepare_maps(const Plan& plan, std::vector<vulkan::PassTime>& times) {
    MapSettings wanted;
    if (plan.has_lookups && plan.sampler.levels != MapLevels::none) wanted.filter = plan.settings.filter;
    if (plan.has_lookups) wanted.kernel = kernel_of(plan.sampler.levels);
    std::vector<WantedMaps> sets;
    std::string what;
    for (const MapSet& set : plan.map_sets) {
        wanted.lookup = set.lookup;
        sets.push_back({{}, wanted});
        for (const uint32_t k : set.environments)
            sets.back().environments.push_back(plan.environments[k]);
        const auto& environments = sets.back().environments;
        what += (what.empty() ? "" : ", ") + describe_maps(environments.size(), *environments.front());
    }
    std::vector<StoredMaps> stored =
        needing_memory_for(what, [&] { return maps_.prepare(map_tools_, lookup_, sets); });
    PreparedMaps result;
    result.layers.resize(plan.environments.size());
    for (size_t s = 0; s < stored.size(); ++s) {
        for (size_t k = 0; k < stored[s].layers.size(); ++k)
            result.layers[plan.map_sets[s].environments[k]] = stored[s].layers[k];
        uploads_.maps += stored[s].made;
        add_pass_times(times, stored[s].pass_times);
        result.sets.push_back(std::move(stored[s].maps));
    }
    return result;
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
