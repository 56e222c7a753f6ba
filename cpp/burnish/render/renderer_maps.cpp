// The part of Renderer that makes environment maps and keeps them for later frames.
#include <algorithm>
#include <optional>

#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"

namespace burnish::render {
namespace {

std::string describe_maps(size_t count, const Environment& first) {
    const uint32_t size = first.face_size();
    return message(count, count == 1 ? " map" : " maps", " with faces of ", size, " x ", size, " texels");
}

} // namespace

std::vector<std::shared_ptr<EnvironmentMaps>> Renderer::prepare_maps(const Plan& plan,
                                                                     std::vector<vulkan::PassTime>& times) {
    std::erase_if(maps_, [](const CachedMaps& cached) {
        return std::any_of(cached.environments.begin(), cached.environments.end(),
                           [](const auto& one) { return one.expired(); });
    });
    const auto has_pass = [&](const char* name) {
        return std::any_of(plan.passes.begin(), plan.passes.end(),
                           [&](const PassLine& line) { return line.name == name; });
    };
    const std::optional<PyramidFilter> filter =
        has_pass("pyramid") ? std::optional(plan.settings.filter) : std::nullopt;
    std::optional<PrefilterKernel> kernel;
    if (has_pass("prefilter"))
        kernel = std::holds_alternative<Matched>(plan.settings.sampler) ? PrefilterKernel::spherical
                                                                        : PrefilterKernel::lobe;
    std::vector<std::shared_ptr<EnvironmentMaps>> result;
    for (const MapSet& set : plan.map_sets) {
        std::vector<std::shared_ptr<const Environment>> environments;
        for (const uint32_t k : set.environments)
            environments.push_back(plan.environments[k]);
        const auto found = std::find_if(maps_.begin(), maps_.end(), [&](const CachedMaps& cached) {
            return (!filter || (cached.filter == filter && cached.kernel == kernel)) &&
                   std::equal(cached.environments.begin(), cached.environments.end(), environments.begin(),
                              environments.end(),
                              [](const auto& one, const auto& other) { return one.lock() == other; });
        });
        if (found != maps_.end()) {
            result.push_back(found->maps);
            continue;
        }
        const auto maps = needing_memory_for(describe_maps(environments.size(), *environments.front()), [&] {
            return std::make_shared<EnvironmentMaps>(
                device_, pyramid_, environments, filter, kernel ? &prefilter() : nullptr,
                kernel.value_or(PrefilterKernel::lobe),
                set.lookup == MapLookup::software ? &texel_pairs() : nullptr);
        });
        add_pass_times(times, maps->pass_times());
        maps_.push_back({{environments.begin(), environments.end()}, filter, kernel, maps});
        result.push_back(maps);
    }
    return result;
}

Prefilter& Renderer::prefilter() {
    if (!prefilter_) prefilter_ = std::make_unique<Prefilter>(device_);
    return *prefilter_;
}

TexelPairs& Renderer::texel_pairs() {
    if (!texel_pairs_) texel_pairs_ = std::make_unique<TexelPairs>(device_);
    return *texel_pairs_;
}

std::vector<std::vector<float>> Renderer::pyramid(const std::shared_ptr<const Environment>& environment,
                                                  PyramidFilter filter,
                                                  std::vector<vulkan::PassTime>* times) {
    const auto lock = enter();
    return within_memory(describe_maps(1, *environment), [&] {
        EnvironmentMaps maps(device_, pyramid_, std::span(&environment, 1), filter);
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
        const bool is_packed = lookup_.of(environment->face_size(), 1) == MapLookup::software;
        EnvironmentMaps maps(device_, pyramid_, std::span(&environment, 1), filter, &prefilter(), kernel,
                             is_packed ? &texel_pairs() : nullptr);
        if (times) *times = maps.pass_times();
        return maps.read_levels(0);
    });
}

} // namespace burnish::render
