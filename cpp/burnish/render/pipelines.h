// All shaders of the engine by name, and the pipelines made from them, each once for its specialization
// constants, while the caller waits or by a thread of their own.
#pragma once

#include <map>
#include <mutex>
#include <span>
#include <string>

#include "burnish/render/compile_worker.h"
#include "burnish/vulkan/pipeline.h"

namespace burnish::render {

/// Thread-safe. A pipeline lives as long as this object and keeps its address.
class Pipelines {
public:
    explicit Pipelines(vulkan::DevicePointer device);

    /// `name` is the file under glsl/ without its ending: "shade/shade_buffer.comp". Throws std::logic_error
    /// for one there is not.
    const vulkan::Shader& shader(const std::string& name);
    const vulkan::ComputePipeline& compute(const std::string& name,
                                           const vulkan::SpecializationConstants& constants = {});
    /// Whether all of them are there. Those that are not are compiled meanwhile, the newest call's first.
    /// Throws, once, what a compilation since the last call threw; it is tried again when it is asked for
    /// again.
    bool request(std::span<const ComputeKey> keys);
    /// Waits until nothing asked for is left to compile.
    void finish_compiling() { worker_.wait(); }
    /// Compiles nothing more meanwhile; waits for what is being compiled.
    void stop_compiling() { worker_.close(); }
    /// `settings.constants` and `key` tell pipelines of the same two shaders apart.
    const vulkan::GraphicsPipeline& graphics(const std::string& vertex, const std::string& fragment,
                                             const std::string& key,
                                             const vulkan::GraphicsSettings& settings);

    /// Milliseconds that callers waited for compilation since the last call.
    double take_compile_ms();
    const vulkan::DevicePointer& device() const { return device_; }

private:
    const vulkan::Shader& find_shader(const std::string& name);
    void compile_meanwhile(const ComputeKey& key);

    vulkan::DevicePointer device_;
    std::mutex mutex_;
    double compile_ms_ = 0.0;
    std::map<std::string, vulkan::Shader> shaders_;
    std::map<ComputeKey, vulkan::ComputePipeline> compute_;
    std::map<std::pair<std::string, vulkan::SpecializationConstants>, vulkan::GraphicsPipeline> graphics_;
    CompileWorker worker_; // last: its thread ends before what it uses
};

} // namespace burnish::render
