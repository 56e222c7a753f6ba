// Reading numbers through accessor -> bufferView -> buffer, every range checked in 64 bits before memory is
// touched.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/scene/gltf/document.h"

namespace burnish::gltf {

class AccessorReader {
public:
    explicit AccessorReader(const Document& document) : document_(document) {}

    size_t count(int accessor) const { return document_.model.accessors[accessor].count; }
    int component_type(int accessor) const { return document_.model.accessors[accessor].componentType; }
    bool is_normalized(int accessor) const { return document_.model.accessors[accessor].normalized; }
    uint32_t components(int accessor) const;

    /// Numbers as floats, integers normalized where the accessor says so. `where` names the use in messages.
    template <typename Vector>
    std::vector<Vector> read(int accessor, const std::string& where) {
        constexpr uint32_t COMPONENTS = sizeof(Vector) / sizeof(float);
        charge(count(accessor) * sizeof(Vector), where);
        std::vector<Vector> values(count(accessor));
        read_floats(accessor, COMPONENTS, reinterpret_cast<float*>(values.data()), where);
        return values;
    }

    std::vector<uint32_t> read_indices(int accessor, const std::string& where);

    /// The bytes of a buffer view, for pictures.
    std::vector<uint8_t> read_view(int view, const std::string& where) const;

    /// Counts memory against the limit for all meshes; throws FileError beyond it.
    void charge(uint64_t bytes, const std::string& where);
    /// Throws FileError where so much more would be beyond the limit.
    void require_room(uint64_t bytes, const std::string& where) const;

private:
    struct Elements {
        const uint8_t* data = nullptr; ///< null: all zero
        size_t stride = 0;
    };
    Elements elements(int view, uint64_t offset, uint64_t element_count, uint64_t element_size,
                      bool is_strided, const std::string& where) const;
    /// Calls visit_element(index, bytes) for every element of the buffer view, then for every sparse
    /// replacement.
    template <typename Visit>
    void visit(int accessor, const std::string& where, const Visit& visit_element) const;
    void read_floats(int accessor, uint32_t component_count, float* values, const std::string& where) const;

    const Document& document_;
    uint64_t charged_bytes_ = 0;
};

} // namespace burnish::gltf
