#include "burnish/render/pipelines.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "spirv/resolve_accumulate_comp.h"
#include "spirv/shade_background_comp.h"
#include "spirv/shade_classify_tiles_comp.h"
#include "spirv/shade_finish_tiles_comp.h"
#include "spirv/shade_list_lights_comp.h"
#include "spirv/shade_lookups_alone_comp.h"
#include "spirv/shade_reference_comp.h"
#include "spirv/shade_shade_matched_by_view_comp.h"
#include "spirv/shade_shade_matched_comp.h"
#include "spirv/shade_shade_pattern_comp.h"
#include "spirv/shade_shade_prefiltered_comp.h"
#include "spirv/surface_surface_frag.h"
#include "spirv/surface_surface_varying_frag.h"
#include "spirv/surface_surface_varying_plain_frag.h"
#include "spirv/surface_surface_varying_vert.h"
#include "spirv/surface_surface_vert.h"

namespace burnish::render {
namespace {

const std::map<std::string, std::span<const uint32_t>>& spirv() {
    static const std::map<std::string, std::span<const uint32_t>> words = {
        {"shade/lookups_alone.comp", shade_lookups_alone_comp_spv},
        {"resolve/accumulate.comp", resolve_accumulate_comp_spv},
        {"shade/background.comp", shade_background_comp_spv},
        {"shade/classify_tiles.comp", shade_classify_tiles_comp_spv},
        {"shade/finish_tiles.comp", shade_finish_tiles_comp_spv},
        {"shade/list_lights.comp", shade_list_lights_comp_spv},
        {"shade/reference.comp", shade_reference_comp_spv},
        {"shade/shade_matched.comp", shade_shade_matched_comp_spv},
        {"shade/shade_matched_by_view.comp", shade_shade_matched_by_view_comp_spv},
        {"shade/shade_pattern.comp", shade_shade_pattern_comp_spv},
        {"shade/shade_prefiltered.comp", shade_shade_prefiltered_comp_spv},
        {"surface/surface.frag", surface_surface_frag_spv},
        {"surface/surface_varying.frag", surface_surface_varying_frag_spv},
        {"surface/surface_varying_plain.frag", surface_surface_varying_plain_frag_spv},
        {"surface/surface.vert", surface_surface_vert_spv},
        {"surface/surface_varying.vert", surface_surface_varying_vert_spv},
    };
    return words;
}

} // namespace

Pipelines::Pipelines(vulkan::DevicePointer device, size_t budget)
    : device_(std::move(device)), budget_(budget) {}

void Pipelines::begin_picture() {
    const std::lock_guard lock(mutex_);
    const auto oldest = [&](auto& cache) {
        return std::min_element(cache.begin(), cache.end(), [](const auto& one, const auto& other) {
            return one.second.last_picture < other.second.last_picture;
        });
    };
    const auto age = [&](const auto& cache, const auto& found) {
        return found == cache.end() ? 0 : picture_ - found->second.last_picture;
    };
    while (compute_.size() + graphics_.size() > budget_) {
        const auto compute = oldest(compute_);
        const auto graphics = oldest(graphics_);
        const uint64_t compute_age = age(compute_, compute), graphics_age = age(graphics_, graphics);
        if (compute_age == 0 && graphics_age == 0) break;
        if (compute_age >= graphics_age)
            compute_.erase(compute);
        else
            graphics_.erase(graphics);
    }
    ++picture_;
}

size_t Pipelines::count() const {
    const std::lock_guard lock(mutex_);
    return compute_.size() + graphics_.size();
}

template <typename Pipeline>
const Pipeline& Pipelines::keep(Cache<Pipeline>& cache, const ComputeKey& key, Pipeline pipeline) {
    return cache.emplace(key, Kept<Pipeline>{std::move(pipeline), picture_}).first->second.pipeline;
}

const vulkan::Shader& Pipelines::find_shader(const std::string& name) {
    const auto found = shaders_.find(name);
    if (found != shaders_.end()) return found->second;
    const auto words = spirv().find(name);
    if (words == spirv().end()) throw std::logic_error("no shader is called " + name);
    return shaders_.emplace(name, vulkan::Shader(device_, name, words->second)).first->second;
}

const vulkan::Shader& Pipelines::shader(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return find_shader(name);
}

const vulkan::ComputePipeline& Pipelines::compute(const std::string& name,
                                                  const vulkan::SpecializationConstants& constants) {
    const std::lock_guard lock(mutex_);
    const ComputeKey key(name, constants);
    const auto found = compute_.find(key);
    if (found != compute_.end()) {
        found->second.last_picture = picture_;
        return found->second.pipeline;
    }
    vulkan::ComputePipeline pipeline(device_, find_shader(name), constants);
    compile_ms_ += pipeline.compile_ms();
    return keep(compute_, key, std::move(pipeline));
}

const vulkan::GraphicsPipeline& Pipelines::graphics(const std::string& vertex, const std::string& fragment,
                                                    const std::string& key_text,
                                                    const vulkan::GraphicsSettings& settings) {
    const std::lock_guard lock(mutex_);
    const ComputeKey key(vertex + "+" + fragment + "+" + key_text, settings.constants);
    const auto found = graphics_.find(key);
    if (found != graphics_.end()) {
        found->second.last_picture = picture_;
        return found->second.pipeline;
    }
    vulkan::GraphicsPipeline pipeline(device_, find_shader(vertex), find_shader(fragment), settings);
    compile_ms_ += pipeline.compile_ms();
    return keep(graphics_, key, std::move(pipeline));
}

double Pipelines::take_compile_ms() {
    const std::lock_guard lock(mutex_);
    return std::exchange(compile_ms_, 0.0);
}

} // namespace burnish::render
