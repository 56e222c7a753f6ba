#include "burnish/scene/gltf/accessor.h"

#include <algorithm>
#include <cstring>

#include "burnish/error.h"

namespace burnish::gltf {
namespace {

template <typename Number>
Number load(const uint8_t* from) {
    Number number;
    std::memcpy(&number, from, sizeof number);
    return number;
}

/// glTF 2.0, section 3.6.2.2: normalized integers, signed ones clamped so that both ends are +-1.
template <typename Integer>
float to_float(const uint8_t* from, bool is_normalized) {
    float value = static_cast<float>(load<Integer>(from));
    return is_normalized ? std::max(value / static_cast<float>(std::numeric_limits<Integer>::max()), -1.0f)
                         : value;
}

uint32_t component_size(int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    default:
        return 4;
    }
}

float read_component(const uint8_t* from, int type, bool is_normalized) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return to_float<int8_t>(from, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return to_float<uint8_t>(from, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return to_float<int16_t>(from, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return to_float<uint16_t>(from, is_normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return to_float<uint32_t>(from, is_normalized);
    default:
        return load<float>(from);
    }
}

uint32_t read_index(const uint8_t* from, int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<uint16_t>(from);
    default:
        return load<uint32_t>(from);
    }
}

} // namespace

uint32_t AccessorReader::components(int accessor) const {
    switch (document_.model.accessors[accessor].type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    case TINYGLTF_TYPE_MAT4:
        return 16;
    default:
        return 0; // smaller matrices: nothing that is read has them
    }
}

void AccessorReader::require_room(uint64_t bytes, const std::string& where) const {
    if (bytes > MAX_MESH_BYTES - charged_bytes_)
        throw FileError(document_.path, message(where, ": expected all meshes to take at most ",
                                                MAX_MESH_BYTES, " bytes, got more"));
}

void AccessorReader::charge(uint64_t bytes, const std::string& where) {
    require_room(bytes, where);
    charged_bytes_ += bytes;
}

AccessorReader::Elements AccessorReader::elements(int view_index, uint64_t offset, uint64_t element_count,
                                                  uint64_t element_size, bool is_strided,
                                                  const std::string& where) const {
    if (view_index < 0 || element_count == 0) return {};
    const tinygltf::BufferView& view = document_.model.bufferViews[view_index];
    const std::vector<uint8_t>& buffer = document_.model.buffers[view.buffer].data;
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
        throw FileError(document_.path, message(where, ": expected bufferViews[", view_index,
                                                "] to end within its buffer of ", buffer.size(),
                                                " bytes, got ", view.byteOffset, " + ", view.byteLength));
    uint64_t stride = is_strided && view.byteStride ? view.byteStride : element_size;
    if (stride < element_size)
        throw FileError(document_.path, message(where, ": expected bufferViews[", view_index,
                                                "].byteStride of at least ", element_size, ", got ", stride));
    // No product overflows: counts and offsets stay below 2^31, strides below 2^8.
    uint64_t end = offset + (element_count - 1) * stride + element_size;
    if (end > view.byteLength)
        throw FileError(document_.path, message(where, ": expected data within bufferViews[", view_index,
                                                "] of ", view.byteLength, " bytes, got ", end));
    return {buffer.data() + view.byteOffset + offset, stride};
}

std::vector<uint8_t> AccessorReader::read_view(int view, const std::string& where) const {
    uint64_t length = document_.model.bufferViews[view].byteLength;
    Elements bytes = elements(view, 0, 1, length, false, where);
    return {bytes.data, bytes.data + length};
}

template <typename Visit>
void AccessorReader::visit(int index, const std::string& where, const Visit& visit_element) const {
    const tinygltf::Accessor& accessor = document_.model.accessors[index];
    uint32_t element_size = component_size(accessor.componentType) * components(index);
    Elements source =
        elements(accessor.bufferView, accessor.byteOffset, accessor.count, element_size, true, where);
    if (source.data)
        for (size_t i = 0; i < accessor.count; ++i)
            visit_element(i, source.data + i * source.stride);
    if (!accessor.sparse.isSparse) return;

    const auto& sparse = accessor.sparse;
    uint64_t count = static_cast<uint64_t>(sparse.count);
    Elements at = elements(sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset), count,
                           component_size(sparse.indices.componentType), false, where + " sparse indices");
    Elements replacing = elements(sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset),
                                  count, element_size, false, where + " sparse values");
    for (size_t i = 0; i < count; ++i) {
        uint32_t element = read_index(at.data + i * at.stride, sparse.indices.componentType);
        if (element >= accessor.count)
            throw FileError(document_.path, message(where, " sparse indices: expected each below ",
                                                    accessor.count, ", got ", element));
        visit_element(element, replacing.data + i * replacing.stride);
    }
}

void AccessorReader::read_floats(int index, uint32_t component_count, float* values,
                                 const std::string& where) const {
    const tinygltf::Accessor& accessor = document_.model.accessors[index];
    if (components(index) != component_count)
        throw FileError(document_.path, message(where, ": expected ", component_count, " components, got ",
                                                components(index)));
    uint32_t size = component_size(accessor.componentType);
    visit(index, where, [&](size_t element, const uint8_t* from) {
        for (uint32_t i = 0; i < component_count; ++i)
            values[element * component_count + i] =
                read_component(from + i * size, accessor.componentType, accessor.normalized);
    });
}

std::vector<uint32_t> AccessorReader::read_indices(int index, const std::string& where) {
    int type = component_type(index);
    bool is_unsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                       type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (!is_unsigned || components(index) != 1)
        throw FileError(document_.path, message(where, ": expected unsigned scalars, got component type ",
                                                type, " with ", components(index), " components"));
    charge(count(index) * sizeof(uint32_t), where);
    std::vector<uint32_t> indices(count(index));
    visit(index, where,
          [&](size_t element, const uint8_t* from) { indices[element] = read_index(from, type); });
    return indices;
}

} // namespace burnish::gltf
