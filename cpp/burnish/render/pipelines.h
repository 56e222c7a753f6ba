// All shaders of the engine by name, and the pipelines made from them, each once for its specialization
// constants.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "burnish/vulkan/pipeline.h"

namespace burnish::render {

/// Thread-safe. A pipeline lives as long as this object.
class Pipelines {
public:
    explicit Pipelines(vulkan::DevicePointer device) : device_(std::move(device)) {}

    /// `name` is the file under glsl/ without its ending: "shade/shade_buffer.comp". Throws std::logic_error
    /// for one there is not.
    const vulkan::Shader& shader(const std::string& name);
    const vulkan::ComputePipeline& compute(const std::string& name,
                                           const vulkan::SpecializationConstants& constants = {});
    /// `settings.constants` and `key` tell pipelines of the same two shaders apart.
    const vulkan::GraphicsPipeline& graphics(const std::string& vertex, const std::string& fragment,
                                             const std::string& key,
                                             const vulkan::GraphicsSettings& settings);

    /// Milliseconds spent compiling since the last call.
    double take_compile_ms();
    const vulkan::DevicePointer& device() const { return device_; }

private:
    const vulkan::Shader& find_shader(const std::string& name);

    vulkan::DevicePointer device_;
    std::mutex mutex_;
    double compile_ms_ = 0.0;
    std::map<std::string, vulkan::Shader> shaders_;
    std::map<std::pair<std::string, vulkan::SpecializationConstants>, vulkan::ComputePipeline> compute_;
    std::map<std::pair<std::string, vulkan::SpecializationConstants>, vulkan::GraphicsPipeline> graphics_;
};

} // namespace burnish::render
