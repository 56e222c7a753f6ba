// All shaders of the engine by name, and the pipelines made from them, each once for its specialization
// constants. Those used longest ago are given back.
#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "burnish/vulkan/pipeline.h"

namespace burnish::render {

/// Tells compute pipelines apart: name of the shader and what it is specialised by.
using ComputeKey = std::pair<std::string, vulkan::SpecializationConstants>;

/// Pipelines that a device keeps, where nobody asks for more or fewer. On lavapipe one of Regular(14) holds 7
/// MB, one of Matched about 35 MB.
constexpr size_t DEFAULT_PIPELINE_BUDGET = 16;

/// Thread-safe. A pipeline keeps its address until the next call of begin_picture at the earliest.
class Pipelines {
public:
    explicit Pipelines(vulkan::DevicePointer device, size_t budget = DEFAULT_PIPELINE_BUDGET);

    /// Gives back pipelines used longest ago until the budget holds, but none that the last picture used.
    /// Nobody may use one meanwhile.
    void begin_picture();
    /// How many are kept; what one picture uses is kept even where that is more. Holds from the next picture
    /// on.
    void set_budget(size_t budget) { budget_ = budget; }
    size_t budget() const { return budget_; }
    /// How many are kept now.
    size_t count() const;

    /// `name` is the file under glsl/ without its ending: "shade/shade_pattern.comp". Throws std::logic_error
    /// for one there is not.
    const vulkan::Shader& shader(const std::string& name);
    const vulkan::ComputePipeline& compute(const std::string& name,
                                           const vulkan::SpecializationConstants& constants = {});
    /// `settings.constants` and `key` tell pipelines of the same two shaders apart.
    const vulkan::GraphicsPipeline& graphics(const std::string& vertex, const std::string& fragment,
                                             const std::string& key,
                                             const vulkan::GraphicsSettings& settings);

    /// Milliseconds that callers waited for compilation since the last call.
    double take_compile_ms();
    const vulkan::DevicePointer& device() const { return device_; }

private:
    template <typename Pipeline>
    struct Kept {
        Pipeline pipeline;
        uint64_t last_picture; // that used it
    };
    template <typename Pipeline>
    using Cache = std::map<ComputeKey, Kept<Pipeline>>;

    const vulkan::Shader& find_shader(const std::string& name);
    template <typename Pipeline>
    const Pipeline& keep(Cache<Pipeline>& cache, const ComputeKey& key, Pipeline pipeline);

    vulkan::DevicePointer device_;
    std::atomic<size_t> budget_;
    mutable std::mutex mutex_;
    double compile_ms_ = 0.0;
    uint64_t picture_ = 0;
    std::map<std::string, vulkan::Shader> shaders_;
    Cache<vulkan::ComputePipeline> compute_;
    Cache<vulkan::GraphicsPipeline> graphics_; // named by both shaders
};

} // namespace burnish::render
