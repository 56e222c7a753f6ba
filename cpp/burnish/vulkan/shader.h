// A shader module and what its SPIR-V says about itself.
#pragma once

#include "burnish/vulkan/handle.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace burnish::vulkan {

/// Values for `layout(constant_id = n)`, by id. All are 32 bits wide, as in the shader.
class SpecializationConstants {
public:
    SpecializationConstants& set(uint32_t id, uint32_t value);
    SpecializationConstants& set(uint32_t id, int32_t value);
    SpecializationConstants& set(uint32_t id, float value);
    SpecializationConstants& set(uint32_t id, bool value);
    const std::map<uint32_t, uint32_t>& bits() const { return bits_; }
    auto operator<=>(const SpecializationConstants&) const = default;

private:
    std::map<uint32_t, uint32_t> bits_;
};

struct ShaderBinding {
    uint32_t binding = 0; // of set 0, the only one in use
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    uint32_t count = 1; // elements of an array of descriptors
    std::string name;
};

struct ShaderReflection {
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
    std::vector<ShaderBinding> bindings;                  // by rising binding number
    uint32_t push_constant_bytes = 0;                     // 0 = none
    std::map<uint32_t, uint32_t> specialization_defaults; // constant id -> default value's bits
    std::array<uint32_t, 3> local_size{1, 1, 1};          // of a compute shader, with the default constants
    std::array<int64_t, 3> local_size_ids{-1, -1, -1};    // constant id that sets it, or -1
};

/// Reads a module with one entry point called "main". Throws std::invalid_argument on anything else.
ShaderReflection reflect(std::span<const uint32_t> words, const std::string& name);

class Shader {
public:
    Shader() = default;
    /// `name` appears in error messages, e.g. "shade/shade_points.comp".
    Shader(const DevicePointer& device, std::string name, std::span<const uint32_t> words);

    const std::string& name() const { return name_; }
    const ShaderReflection& reflection() const { return reflection_; }
    VkShaderModule handle() const { return module_.get(); }
    const DevicePointer& device() const { return module_.device(); }

private:
    std::string name_;
    ShaderReflection reflection_;
    Handle<VkShaderModule, vkDestroyShaderModule> module_;
};

} // namespace burnish::vulkan
