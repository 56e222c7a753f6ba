// Reads bindings, push constants, specialization constants and the local size from SPIR-V (specification 1.6,
// section 3).
#include "burnish/error.h"
#include "burnish/vulkan/shader.h"
#include "burnish/vulkan/spirv_numbers.h"

#include <algorithm>
#include <cstring>

namespace burnish::vulkan {

namespace {

using namespace spirv;

/// An instruction that makes an id; `words` are its operands without the result id (and type).
struct Definition {
    uint32_t op = 0;
    uint32_t type = 0;
    std::vector<uint32_t> words;
};

class Module {
public:
    Module(std::span<const uint32_t> words, const std::string& name) : name_(name) { read(words); }

    ShaderReflection reflect() {
        ShaderReflection result;
        result.stage = stage_;
        for (const auto& [id, definition] : definitions_) {
            if (definition.op == op_variable) add_variable(result, id, definition);
            if (const uint32_t* constant = decoration(id, spec_id)) {
                result.specialization_defaults[*constant] = constant_value(definition);
            }
        }
        std::sort(result.bindings.begin(), result.bindings.end(),
                  [](const auto& a, const auto& b) { return a.binding < b.binding; });
        read_local_size(result);
        return result;
    }

private:
    [[noreturn]] void fail(const std::string& text) const {
        throw std::invalid_argument(message(name_, ": expected ", text));
    }

    static std::string text_at(std::span<const uint32_t> words) {
        const char* begin = reinterpret_cast<const char*>(words.data());
        return {begin, strnlen(begin, words.size_bytes())};
    }

    void read(std::span<const uint32_t> words) {
        constexpr uint32_t magic = 0x07230203, header_words = 5;
        if (words.size() < header_words || words[0] != magic) fail("SPIR-V words, got something else");
        for (std::size_t at = header_words; at < words.size();) {
            const uint32_t length = words[at] >> 16, op = words[at] & 0xffff;
            if (length == 0 || at + length > words.size()) fail("whole SPIR-V instructions, got a cut one");
            read_instruction(op, words.subspan(at + 1, length - 1));
            at += length;
        }
        if (entry_points_ != 1) fail(message("one entry point, got ", entry_points_));
    }

    void read_instruction(uint32_t op, std::span<const uint32_t> words) {
        const auto rest = [&](std::size_t skip) {
            return std::vector<uint32_t>(words.begin() + static_cast<std::ptrdiff_t>(skip), words.end());
        };
        switch (op) {
        case op_name:
            names_[words[0]] = text_at(words.subspan(1));
            break;
        case op_entry_point:
            read_entry_point(words);
            break;
        case op_execution_mode:
        case op_execution_mode_id:
            if (words[1] == mode_local_size || words[1] == mode_local_size_id) {
                local_size_ = rest(2);
                local_size_is_ids_ = words[1] == mode_local_size_id;
            }
            break;
        case op_decorate:
            decorations_[{words[0], words[1]}] = words.size() > 2 ? words[2] : 0;
            break;
        case op_member_decorate:
            member_decorations_[{words[0], words[1], words[2]}] = words.size() > 3 ? words[3] : 0;
            break;
        case op_type_int:
        case op_type_float:
        case op_type_vector:
        case op_type_matrix:
        case op_type_image:
        case op_type_sampler:
        case op_type_sampled_image:
        case op_type_array:
        case op_type_runtime_array:
        case op_type_struct:
        case op_type_pointer:
            definitions_[words[0]] = {op, 0, rest(1)};
            break;
        case op_constant:
        case op_constant_composite:
        case op_spec_constant_true:
        case op_spec_constant_false:
        case op_spec_constant:
        case op_spec_constant_composite:
        case op_variable:
            definitions_[words[1]] = {op, words[0], rest(2)};
            break;
        default:
            break;
        }
    }

    void read_entry_point(std::span<const uint32_t> words) {
        constexpr std::pair<uint32_t, VkShaderStageFlagBits> stages[] = {{0, VK_SHADER_STAGE_VERTEX_BIT},
                                                                         {4, VK_SHADER_STAGE_FRAGMENT_BIT},
                                                                         {5, VK_SHADER_STAGE_COMPUTE_BIT}};
        const auto known = std::find_if(std::begin(stages), std::end(stages),
                                        [&](const auto& s) { return s.first == words[0]; });
        if (known == std::end(stages)) fail("a vertex, fragment or compute shader, got another stage");
        if (text_at(words.subspan(2)) != "main") fail("an entry point called main, got another");
        stage_ = known->second;
        entry_points_ += 1;
    }

    const uint32_t* decoration(uint32_t id, uint32_t kind) const {
        const auto found = decorations_.find({id, kind});
        return found == decorations_.end() ? nullptr : &found->second;
    }

    const Definition& definition(uint32_t id) const {
        const auto found = definitions_.find(id);
        if (found == definitions_.end()) fail(message("a type or constant with id %", id, ", got none"));
        return found->second;
    }

    uint32_t constant_value(const Definition& constant) const {
        if (constant.op == op_spec_constant_true) return 1;
        if (constant.op == op_spec_constant_false) return 0;
        if (constant.words.size() != 1) fail("constants of 32 bits, got a wider one");
        return constant.words[0];
    }

    void add_variable(ShaderReflection& result, uint32_t id, const Definition& variable) const {
        const uint32_t storage = variable.words[0];
        uint32_t type_id = definition(variable.type).words[1]; // the pointer's target
        if (storage == push_constant) result.push_constant_bytes = size_of(type_id);
        if (storage != uniform_constant && storage != uniform && storage != storage_buffer) return;

        ShaderBinding binding;
        const uint32_t* number = decoration(id, binding_number);
        const uint32_t* set = decoration(id, descriptor_set);
        if (!number || !set || *set != 0) fail("every resource in set 0 with a binding number, got another");
        binding.binding = *number;
        if (definition(type_id).op == op_type_array) {
            binding.count = constant_value(definition(definition(type_id).words[1]));
            type_id = definition(type_id).words[0];
        }
        binding.type = descriptor_type(storage, type_id);
        // A block's variable is nameless when its members are global; then the block's own name serves.
        const auto given = names_.find(id);
        const auto block = names_.find(type_id);
        if (given != names_.end() && !given->second.empty()) {
            binding.name = given->second;
        } else if (block != names_.end()) {
            binding.name = block->second;
        }

        for (const ShaderBinding& other : result.bindings) {
            if (other.binding != binding.binding) continue;
            if (other.type == binding.type && other.count == binding.count) return; // two names for one thing
            fail(message("one kind of resource at binding ", binding.binding, ", got two"));
        }
        result.bindings.push_back(binding);
    }

    VkDescriptorType descriptor_type(uint32_t storage, uint32_t type_id) const {
        if (storage == storage_buffer) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        if (storage == uniform) {
            return decoration(type_id, buffer_block) ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                                     : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        }
        const Definition& type = definition(type_id);
        const bool has_sampler = type.op == op_type_sampled_image;
        const Definition& image = has_sampler ? definition(type.words[0]) : type;
        if (image.op == op_type_image) {
            const bool is_buffer = image.words[1] == dimension_buffer;
            const bool is_storage = image.words[5] == image_is_storage;
            if (is_buffer) {
                return is_storage ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                  : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
            }
            if (is_storage) return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            if (has_sampler) return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        }
        fail("buffers, storage images, texel buffers and images with samplers, got another kind of resource");
    }

    /// Bytes from a type's first to its last, without the padding after it.
    uint32_t size_of(uint32_t type_id, uint32_t stride_of_columns = 0) const {
        const Definition& type = definition(type_id);
        switch (type.op) {
        case op_type_int:
        case op_type_float:
            return type.words[0] / 8;
        case op_type_vector:
            return type.words[1] * size_of(type.words[0]);
        case op_type_matrix:
            return type.words[1] * stride_of_columns;
        case op_type_array:
            return constant_value(definition(type.words[1])) * *decoration(type_id, array_stride);
        case op_type_struct:
            break;
        default:
            fail("numbers, vectors, matrices, arrays and structs as push constants, got another type");
        }
        uint32_t end = 0;
        for (uint32_t member = 0; member < type.words.size(); ++member) {
            const auto value = [&](uint32_t kind) {
                const auto found = member_decorations_.find({type_id, member, kind});
                return found == member_decorations_.end() ? 0u : found->second;
            };
            end = std::max(end, value(offset_bytes) + size_of(type.words[member], value(matrix_stride)));
        }
        return end;
    }

    void read_local_size(ShaderReflection& result) const {
        std::vector<uint32_t> ids = local_size_is_ids_ ? local_size_ : std::vector<uint32_t>{};
        for (const auto& [key, value] : decorations_) { // the built-in overrides the execution mode
            if (key[1] == built_in && value == built_in_workgroup_size) ids = definition(key[0]).words;
        }
        for (std::size_t axis = 0; axis < 3 && axis < std::max(ids.size(), local_size_.size()); ++axis) {
            if (ids.empty()) {
                result.local_size[axis] = local_size_[axis];
                continue;
            }
            result.local_size[axis] = constant_value(definition(ids[axis]));
            if (const uint32_t* constant = decoration(ids[axis], spec_id))
                result.local_size_ids[axis] = *constant;
        }
    }

    std::string name_;
    VkShaderStageFlagBits stage_ = VK_SHADER_STAGE_COMPUTE_BIT;
    uint32_t entry_points_ = 0;
    std::vector<uint32_t> local_size_;
    bool local_size_is_ids_ = false;
    std::map<uint32_t, Definition> definitions_;
    std::map<uint32_t, std::string> names_;
    std::map<std::array<uint32_t, 2>, uint32_t> decorations_;        // id, decoration
    std::map<std::array<uint32_t, 3>, uint32_t> member_decorations_; // struct id, member, decoration
};

} // namespace

ShaderReflection reflect(std::span<const uint32_t> words, const std::string& name) {
    return Module(words, name).reflect();
}

} // namespace burnish::vulkan
