#include "burnish/vulkan/shader.h"

#include "burnish/vulkan/result.h"

#include <bit>

namespace burnish::vulkan {

SpecializationConstants& SpecializationConstants::set(uint32_t id, uint32_t value) {
    bits_[id] = value;
    return *this;
}

SpecializationConstants& SpecializationConstants::set(uint32_t id, int32_t value) {
    return set(id, std::bit_cast<uint32_t>(value));
}

SpecializationConstants& SpecializationConstants::set(uint32_t id, float value) {
    return set(id, std::bit_cast<uint32_t>(value));
}

SpecializationConstants& SpecializationConstants::set(uint32_t id, bool value) {
    return set(id, value ? 1u : 0u);
}

Shader::Shader(const DevicePointer& device, std::string name, std::span<const uint32_t> words)
    : name_(std::move(name)), reflection_(reflect(words, name_)) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkShaderModule shader_module = VK_NULL_HANDLE;
    vk_check(vkCreateShaderModule(raw_device(*device), &info, nullptr, &shader_module),
             (name_ + ": vkCreateShaderModule").c_str());
    module_ = {device, shader_module};
}

} // namespace burnish::vulkan
