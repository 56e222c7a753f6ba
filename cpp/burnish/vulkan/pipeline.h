// Compute and graphics pipelines; their layouts come from the shaders' own SPIR-V.
#pragma once

#include "burnish/vulkan/shader.h"

namespace burnish::vulkan {

/// What a pipeline expects to be bound: the union of its shaders' bindings and push constants.
struct PipelineInterface {
    std::string name;
    VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
    std::vector<ShaderBinding> bindings; // by rising binding number
    VkShaderStageFlags stages = 0;
    uint32_t push_constant_bytes = 0;
    Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> set_layout;
    Handle<VkPipelineLayout, vkDestroyPipelineLayout> layout;
};

/// True if a descriptor set made for one can be used with the other.
bool is_same_layout(const PipelineInterface& a, const PipelineInterface& b);

class ComputePipeline {
public:
    ComputePipeline() = default;
    /// Throws std::invalid_argument if `constants` holds an id the shader does not have.
    ComputePipeline(const DevicePointer& device, const Shader& shader,
                    const SpecializationConstants& constants = {});

    const PipelineInterface& interface() const { return *interface_; }
    std::shared_ptr<const PipelineInterface> shared_interface() const { return interface_; }
    VkPipeline handle() const { return pipeline_.get(); }
    const std::array<uint32_t, 3>& local_size() const { return local_size_; }
    double compile_ms() const { return compile_ms_; }

private:
    std::shared_ptr<const PipelineInterface> interface_;
    Handle<VkPipeline, vkDestroyPipeline> pipeline_;
    std::array<uint32_t, 3> local_size_{1, 1, 1};
    double compile_ms_ = 0;
};

/// Viewport and scissor are dynamic. Blending is off.
struct GraphicsSettings {
    std::vector<VkVertexInputBindingDescription> vertex_bindings{};
    std::vector<VkVertexInputAttributeDescription> vertex_attributes{};
    std::vector<VkFormat> color_formats{};
    VkFormat depth_format = VK_FORMAT_UNDEFINED;       // undefined = no depth test
    VkCompareOp depth_compare = VK_COMPARE_OP_GREATER; // reverse z: near = 1, far = 0
    bool depth_write = true;
    VkCullModeFlags cull_mode = VK_CULL_MODE_NONE;
    VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    uint32_t view_mask = 0;              // multiview: bit i renders layer i
    SpecializationConstants constants{}; // ids either shader has
};

class GraphicsPipeline {
public:
    GraphicsPipeline() = default;
    GraphicsPipeline(const DevicePointer& device, const Shader& vertex, const Shader& fragment,
                     const GraphicsSettings& settings);

    const PipelineInterface& interface() const { return *interface_; }
    std::shared_ptr<const PipelineInterface> shared_interface() const { return interface_; }
    VkPipeline handle() const { return pipeline_.get(); }
    double compile_ms() const { return compile_ms_; }

private:
    std::shared_ptr<const PipelineInterface> interface_;
    Handle<VkPipeline, vkDestroyPipeline> pipeline_;
    double compile_ms_ = 0;
};

} // namespace burnish::vulkan
