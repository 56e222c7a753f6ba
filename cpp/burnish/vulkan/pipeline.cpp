#include "burnish/vulkan/pipeline.h"

#include "burnish/vulkan/device.h"
#include "burnish/vulkan/result.h"

#include <algorithm>
#include <chrono>

namespace burnish::vulkan {

namespace {

/// Adds a shader's bindings to those of the earlier stages.
void merge(std::vector<ShaderBinding>& bindings, const Shader& shader) {
    for (const ShaderBinding& one : shader.reflection().bindings) {
        const auto same = std::find_if(bindings.begin(), bindings.end(),
                                       [&](const auto& other) { return other.binding == one.binding; });
        if (same == bindings.end()) {
            bindings.push_back(one);
        } else if (same->type != one.type || same->count != one.count) {
            throw std::invalid_argument(message(shader.name(), ": expected binding ", one.binding,
                                                " to be the same in every stage, got two kinds"));
        }
    }
    std::sort(bindings.begin(), bindings.end(),
              [](const auto& a, const auto& b) { return a.binding < b.binding; });
}

std::shared_ptr<const PipelineInterface> make_interface(const DevicePointer& device,
                                                        VkPipelineBindPoint point,
                                                        std::initializer_list<const Shader*> shaders) {
    auto made = std::make_shared<PipelineInterface>();
    made->bind_point = point;
    for (const Shader* shader : shaders) {
        made->name += (made->name.empty() ? "" : " + ") + shader->name();
        made->stages |= shader->reflection().stage;
        made->push_constant_bytes =
            std::max(made->push_constant_bytes, shader->reflection().push_constant_bytes);
        merge(made->bindings, *shader);
    }
    const uint32_t most = device->limits().maxPushConstantsSize;
    if (made->push_constant_bytes > most) {
        throw VulkanError(message(made->name, ": expected at most ", most, " bytes of push constants, got ",
                                  made->push_constant_bytes));
    }

    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const ShaderBinding& one : made->bindings) {
        bindings.push_back({one.binding, one.type, one.count, made->stages, nullptr});
    }
    VkDescriptorSetLayoutCreateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set_info.bindingCount = static_cast<uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorSetLayout(device->handle(), &set_info, nullptr, &set_layout),
             "vkCreateDescriptorSetLayout");
    made->set_layout = {device, set_layout};

    const VkPushConstantRange range{made->stages, 0, made->push_constant_bytes};
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = made->push_constant_bytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    vk_check(vkCreatePipelineLayout(device->handle(), &info, nullptr, &layout), "vkCreatePipelineLayout");
    made->layout = {device, layout};
    return made;
}

/// The constants that one shader has, as Vulkan wants them. Must outlive the pipeline's creation where it
/// stands.
struct Specialization {
    Specialization(const Shader& shader, const SpecializationConstants& constants) {
        for (const auto& [id, bits] : constants.bits()) {
            if (!shader.reflection().specialization_defaults.contains(id)) continue;
            entries.push_back(
                {id, static_cast<uint32_t>(values.size() * sizeof(uint32_t)), sizeof(uint32_t)});
            values.push_back(bits);
        }
        info = {static_cast<uint32_t>(entries.size()), entries.data(), values.size() * sizeof(uint32_t),
                values.data()};
    }
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;

    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    VkSpecializationInfo info{};
};

void require_known(const SpecializationConstants& constants, const std::string& name,
                   std::initializer_list<const Shader*> shaders) {
    for (const auto& [id, bits] : constants.bits()) {
        const bool is_known = std::any_of(shaders.begin(), shaders.end(), [id = id](const Shader* shader) {
            return shader->reflection().specialization_defaults.contains(id);
        });
        if (is_known) continue;
        throw std::invalid_argument(
            message(name, ": expected specialization constants that the shader has, got constant_id ", id));
    }
}

void require_stage(const Shader& shader, VkShaderStageFlagBits stage, const char* what) {
    if (shader.reflection().stage == stage) return;
    throw std::invalid_argument(message(shader.name(), ": expected a ", what, " shader, got another stage"));
}

VkPipelineShaderStageCreateInfo stage_info(const Shader& shader, const Specialization& constants) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = shader.reflection().stage;
    info.module = shader.handle();
    info.pName = "main";
    info.pSpecializationInfo = &constants.info;
    return info;
}

/// Drivers return lack of memory for shaders that they cannot compile, so that is told as any other failure.
void require_compiled(VkResult result, const PipelineInterface& interface, const char* call) {
    if (result == VK_SUCCESS) return;
    throw VulkanError(message(interface.name, ": expected the driver to compile it, ", call, " returned ",
                              result_name(result), " (", static_cast<int>(result), ")"));
}

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

} // namespace

bool is_same_layout(const PipelineInterface& a, const PipelineInterface& b) {
    return a.stages == b.stages && std::equal(a.bindings.begin(), a.bindings.end(), b.bindings.begin(),
                                              b.bindings.end(), [](const auto& x, const auto& y) {
                                                  return x.binding == y.binding && x.type == y.type &&
                                                         x.count == y.count;
                                              });
}

ComputePipeline::ComputePipeline(const DevicePointer& device, const Shader& shader,
                                 const SpecializationConstants& constants) {
    require_stage(shader, VK_SHADER_STAGE_COMPUTE_BIT, "compute");
    require_known(constants, shader.name(), {&shader});
    const ShaderReflection& reflection = shader.reflection();
    local_size_ = reflection.local_size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (reflection.local_size_ids[axis] < 0) continue;
        const auto given = constants.bits().find(static_cast<uint32_t>(reflection.local_size_ids[axis]));
        if (given != constants.bits().end()) local_size_[axis] = given->second;
    }
    const uint64_t invocations = uint64_t{local_size_[0]} * local_size_[1] * local_size_[2];
    const uint32_t most = device->limits().maxComputeWorkGroupInvocations;
    if (invocations == 0 || invocations > most) {
        throw std::invalid_argument(message(shader.name(), ": expected a local size of 1..", most,
                                            " invocations, got ", local_size_[0], " x ", local_size_[1],
                                            " x ", local_size_[2]));
    }

    interface_ = make_interface(device, VK_PIPELINE_BIND_POINT_COMPUTE, {&shader});
    const Specialization specialization(shader, constants);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stage_info(shader, specialization);
    info.layout = interface_->layout.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    const Clock::time_point begin = Clock::now();
    VkResult result = device->take_fault("vkCreateComputePipelines");
    if (result == VK_SUCCESS) {
        result = vkCreateComputePipelines(device->handle(), device->pipeline_cache(), 1, &info, nullptr,
                                          &pipeline);
    }
    require_compiled(result, *interface_, "vkCreateComputePipelines");
    compile_ms_ = milliseconds_since(begin);
    pipeline_ = {device, pipeline};
}

GraphicsPipeline::GraphicsPipeline(const DevicePointer& device, const Shader& vertex, const Shader& fragment,
                                   const GraphicsSettings& settings) {
    require_stage(vertex, VK_SHADER_STAGE_VERTEX_BIT, "vertex");
    require_stage(fragment, VK_SHADER_STAGE_FRAGMENT_BIT, "fragment");
    interface_ = make_interface(device, VK_PIPELINE_BIND_POINT_GRAPHICS, {&vertex, &fragment});
    require_known(settings.constants, interface_->name, {&vertex, &fragment});

    const Specialization vertex_constants(vertex, settings.constants);
    const Specialization fragment_constants(fragment, settings.constants);
    const VkPipelineShaderStageCreateInfo stages[] = {stage_info(vertex, vertex_constants),
                                                      stage_info(fragment, fragment_constants)};

    VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = static_cast<uint32_t>(settings.vertex_bindings.size());
    input.pVertexBindingDescriptions = settings.vertex_bindings.data();
    input.vertexAttributeDescriptionCount = static_cast<uint32_t>(settings.vertex_attributes.size());
    input.pVertexAttributeDescriptions = settings.vertex_attributes.data();

    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = settings.topology;

    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;

    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = settings.cull_mode;
    raster.frontFace = settings.front_face;
    raster.lineWidth = 1;

    VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = settings.samples;

    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = settings.depth_format != VK_FORMAT_UNDEFINED;
    depth.depthWriteEnable = depth.depthTestEnable && settings.depth_write;
    depth.depthCompareOp = settings.depth_compare;

    VkPipelineColorBlendAttachmentState no_blend{};
    no_blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                              VK_COLOR_COMPONENT_A_BIT;
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(settings.color_formats.size(),
                                                                       no_blend);
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = static_cast<uint32_t>(attachments.size());
    blend.pAttachments = attachments.data();

    constexpr VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = static_cast<uint32_t>(std::size(dynamic_states));
    dynamic.pDynamicStates = dynamic_states;

    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.viewMask = settings.view_mask;
    rendering.colorAttachmentCount = static_cast<uint32_t>(settings.color_formats.size());
    rendering.pColorAttachmentFormats = settings.color_formats.data();
    rendering.depthAttachmentFormat = settings.depth_format;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = static_cast<uint32_t>(std::size(stages));
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = interface_->layout.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    const Clock::time_point begin = Clock::now();
    VkResult result = device->take_fault("vkCreateGraphicsPipelines");
    if (result == VK_SUCCESS) {
        result = vkCreateGraphicsPipelines(device->handle(), device->pipeline_cache(), 1, &info, nullptr,
                                           &pipeline);
    }
    require_compiled(result, *interface_, "vkCreateGraphicsPipelines");
    compile_ms_ = milliseconds_since(begin);
    pipeline_ = {device, pipeline};
}

} // namespace burnish::vulkan
