#include "burnish/render/pipelines.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "spirv/resolve_accumulate_comp.h"
#include "spirv/shade_background_comp.h"
#include "spirv/shade_classify_tiles_comp.h"
#include "spirv/shade_finish_tiles_comp.h"
#include "spirv/shade_lookups_alone_comp.h"
#include "spirv/shade_reference_comp.h"
#include "spirv/shade_shade_buffer_comp.h"
#include "spirv/shade_shade_constant_comp.h"
#include "spirv/shade_shade_matched_by_view_comp.h"
#include "spirv/shade_shade_matched_comp.h"
#include "spirv/shade_shade_prefiltered_comp.h"
#include "spirv/surface_surface_frag.h"
#include "spirv/surface_surface_varying_frag.h"
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
        {"shade/reference.comp", shade_reference_comp_spv},
        {"shade/shade_buffer.comp", shade_shade_buffer_comp_spv},
        {"shade/shade_constant.comp", shade_shade_constant_comp_spv},
        {"shade/shade_matched.comp", shade_shade_matched_comp_spv},
        {"shade/shade_matched_by_view.comp", shade_shade_matched_by_view_comp_spv},
        {"shade/shade_prefiltered.comp", shade_shade_prefiltered_comp_spv},
        {"surface/surface.frag", surface_surface_frag_spv},
        {"surface/surface_varying.frag", surface_surface_varying_frag_spv},
        {"surface/surface.vert", surface_surface_vert_spv},
        {"surface/surface_varying.vert", surface_surface_varying_vert_spv},
    };
    return words;
}

} // namespace

Pipelines::Pipelines(vulkan::DevicePointer device)
    : device_(std::move(device)), worker_([this](const ComputeKey& key) { compile_meanwhile(key); }) {}

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
    const auto key = std::make_pair(name, constants);
    auto found = compute_.find(key);
    if (found == compute_.end()) {
        found = compute_.emplace(key, vulkan::ComputePipeline(device_, find_shader(name), constants)).first;
        compile_ms_ += found->second.compile_ms();
    }
    return found->second;
}

bool Pipelines::request(std::span<const ComputeKey> keys) {
    worker_.raise_error();
    std::vector<ComputeKey> missing;
    {
        const std::lock_guard lock(mutex_);
        std::copy_if(keys.begin(), keys.end(), std::back_inserter(missing),
                     [&](const ComputeKey& key) { return !compute_.contains(key); });
    }
    if (!missing.empty()) worker_.want(missing);
    return missing.empty();
}

/// Callers may use and compile other pipelines at the same time.
void Pipelines::compile_meanwhile(const ComputeKey& key) {
    const vulkan::Shader* shader = nullptr;
    {
        const std::lock_guard lock(mutex_);
        if (compute_.contains(key)) return;
        shader = &find_shader(key.first);
    }
    vulkan::ComputePipeline pipeline(device_, *shader, key.second);
    const std::lock_guard lock(mutex_);
    compute_.emplace(key, std::move(pipeline));
}

const vulkan::GraphicsPipeline& Pipelines::graphics(const std::string& vertex, const std::string& fragment,
                                                    const std::string& key_text,
                                                    const vulkan::GraphicsSettings& settings) {
    const std::lock_guard lock(mutex_);
    const auto key = std::make_pair(vertex + "+" + fragment + "+" + key_text, settings.constants);
    auto found = graphics_.find(key);
    if (found == graphics_.end()) {
        vulkan::GraphicsPipeline pipeline(device_, find_shader(vertex), find_shader(fragment), settings);
        found = graphics_.emplace(key, std::move(pipeline)).first;
        compile_ms_ += found->second.compile_ms();
    }
    return found->second;
}

double Pipelines::take_compile_ms() {
    const std::lock_guard lock(mutex_);
    return std::exchange(compile_ms_, 0.0);
}

} // namespace burnish::render
