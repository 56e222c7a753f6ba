// The SPIR-V instructions, decorations and storage classes that reflection reads, by their numbers in the
// specification.
#pragma once

#include <cstdint>

namespace burnish::vulkan::spirv {

enum Op : uint32_t {
    op_name = 5,
    op_entry_point = 15,
    op_execution_mode = 16,
    op_type_int = 21,
    op_type_float = 22,
    op_type_vector = 23,
    op_type_matrix = 24,
    op_type_image = 25,
    op_type_sampler = 26,
    op_type_sampled_image = 27,
    op_type_array = 28,
    op_type_runtime_array = 29,
    op_type_struct = 30,
    op_type_pointer = 32,
    op_constant = 43,
    op_constant_composite = 44,
    op_spec_constant_true = 48,
    op_spec_constant_false = 49,
    op_spec_constant = 50,
    op_spec_constant_composite = 51,
    op_variable = 59,
    op_decorate = 71,
    op_member_decorate = 72,
    op_execution_mode_id = 331,
};
enum Decoration : uint32_t {
    spec_id = 1,
    buffer_block = 3,
    array_stride = 6,
    matrix_stride = 7,
    built_in = 11,
    binding_number = 33,
    descriptor_set = 34,
    offset_bytes = 35,
};
enum StorageClass : uint32_t { uniform_constant = 0, uniform = 2, push_constant = 9, storage_buffer = 12 };
inline constexpr uint32_t mode_local_size = 17, mode_local_size_id = 38, built_in_workgroup_size = 25;
inline constexpr uint32_t dimension_buffer = 5, image_is_storage = 2;

} // namespace burnish::vulkan::spirv
