#include "burnish/vulkan/shader.h"

#include "burnish/vulkan/result.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "burnish/error.h"

namespace burnish::vulkan {

namespace {

/// The environment variable BURNISH_SPIRV_DIR names a folder of modules that stand in for the built-in ones,
/// each named like shade_shade_buffer_comp.spv: shaders are tried, and mutated, without a build. Empty where
/// it has none.
std::vector<uint32_t> stand_in(std::string name) {
    const char* folder = std::getenv("BURNISH_SPIRV_DIR");
    if (!folder) return {};
    std::ranges::replace_if(
        name, [](char c) { return c == '/' || c == '.'; }, '_');
    const std::filesystem::path path = std::filesystem::path(folder) / (name + ".spv");
    std::ifstream file(path, std::ios::binary);
    if (!file) return {};
    std::vector<uint32_t> words(std::filesystem::file_size(path) / sizeof(uint32_t));
    file.read(reinterpret_cast<char*>(words.data()), std::streamsize(words.size() * sizeof(uint32_t)));
    if (!file || words.empty())
        throw std::invalid_argument(message("BURNISH_SPIRV_DIR: expected SPIR-V, got ", path.string()));
    return words;
}

} // namespace

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
    : name_(std::move(name)) {
    const std::vector<uint32_t> other = stand_in(name_);
    if (!other.empty()) words = other;
    reflection_ = reflect(words, name_);
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkShaderModule shader_module = VK_NULL_HANDLE;
    vk_check(vkCreateShaderModule(raw_device(*device), &info, nullptr, &shader_module),
             (name_ + ": vkCreateShaderModule").c_str());
    module_ = {device, shader_module};
}

} // namespace burnish::vulkan
