#include "burnish/scene/gltf/mesh.h"

#include <algorithm>
#include <limits>

#include "burnish/check.h"
#include "burnish/error.h"
#include "burnish/scene/texture_kinds.h"

namespace burnish::gltf {
namespace {

class PrimitiveLoader {
public:
    PrimitiveLoader(const Document& document, AccessorReader& reader, const tinygltf::Primitive& primitive,
                    const Skin* skin, const std::string& where, std::vector<std::string>& warnings)
        : document_(document), reader_(reader), primitive_(primitive), skin_(skin), where_(where),
          warnings_(warnings) {}

    std::optional<Mesh> load() {
        if (primitive_.mode < TINYGLTF_MODE_TRIANGLES) {
            warn("points and lines are not drawn");
            return std::nullopt;
        }
        if (!primitive_.attributes.count("POSITION")) {
            warn("has no POSITION and is not drawn");
            return std::nullopt;
        }
        if (!primitive_.targets.empty()) warn("morph targets are not applied: drawn in its base pose");
        mesh_.positions = read<glm::vec3>("POSITION");
        require_finite(mesh_.positions, "POSITION");
        warn_of_lost_digits();
        read_triangles();
        if (mesh_.indices.empty()) {
            warn("has no triangles and is not drawn");
            return std::nullopt;
        }
        if (primitive_.attributes.count("TEXCOORD_0")) mesh_.uv0 = read_uv("TEXCOORD_0");
        if (primitive_.attributes.count("TEXCOORD_1")) mesh_.uv1 = read_uv("TEXCOORD_1");
        if (primitive_.attributes.count("COLOR_0")) read_colors();
        read_frames();
        return std::move(mesh_);
    }

private:
    void warn(const std::string& sentence) { warnings_.push_back(where_ + ": " + sentence); }
    [[noreturn]] void fail(const std::string& name, const std::string& text) const {
        throw FileError(document_.path, where_ + "." + name + ": " + text);
    }

    bool has_extension(const char* name) const {
        const auto& used = document_.model.extensionsUsed;
        return std::count(used.begin(), used.end(), name) > 0;
    }

    /// The component types glTF 2.0 allows; KHR_mesh_quantization adds all other 8 and 16-bit integers.
    void require_type(int accessor, const std::string& name) const {
        int type = reader_.component_type(accessor);
        bool is_unsigned_normalized =
            reader_.is_normalized(accessor) &&
            (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
        bool takes_normalized = name.rfind("TEXCOORD", 0) == 0 || name.rfind("COLOR", 0) == 0;
        bool is_plain = type == TINYGLTF_COMPONENT_TYPE_FLOAT || (takes_normalized && is_unsigned_normalized);
        bool is_quantized =
            has_extension("KHR_mesh_quantization") && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        if (!is_plain && !is_quantized)
            fail(name,
                 message("expected 32-bit floats", takes_normalized ? " or normalized unsigned integers" : "",
                         ", got component type ", type));
    }

    template <typename Vector>
    std::vector<Vector> read(const std::string& name) {
        int accessor = primitive_.attributes.at(name);
        require_type(accessor, name);
        size_t count = name == "POSITION" ? reader_.count(accessor) : mesh_.positions.size();
        if (reader_.count(accessor) != count)
            fail(name, message("expected as many as POSITION (", count, "), got ", reader_.count(accessor)));
        return reader_.read<Vector>(accessor, where_ + "." + name);
    }

    template <typename Vector>
    void require_finite(const std::vector<Vector>& values, const std::string& name) const {
        for (size_t i = 0; i < values.size(); ++i)
            if (!is_finite(values[i]))
                fail(name, message("expected finite numbers, got a non-finite one at ", i));
    }

    /// Far from its origin 32-bit floats hold a mesh's shape with few digits, which no reader can bring back.
    void warn_of_lost_digits() {
        if (reader_.component_type(primitive_.attributes.at("POSITION")) != TINYGLTF_COMPONENT_TYPE_FLOAT)
            return;
        glm::vec3 low(mesh_.positions[0]), high(mesh_.positions[0]);
        for (const glm::vec3& position : mesh_.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        const glm::vec3 reach = glm::max(glm::abs(low), glm::abs(high));
        const double size = glm::length(glm::dvec3(high) - glm::dvec3(low));
        const float farthest = std::max({reach.x, reach.y, reach.z});
        const double step =
            static_cast<double>(std::nextafter(farthest, std::numeric_limits<float>::infinity())) - farthest;
        constexpr double VISIBLE_STEP = 1e-3; // of the mesh's size: a pixel of a picture that it fills
        if (size > 0.0 && step > VISIBLE_STEP * size)
            warn(message("POSITION: ", farthest, " from the mesh's origin 32-bit floats are ", step,
                         " apart, and the mesh is ", size,
                         " across: ", std::min(std::floor(std::log10(farthest / size)), 7.0),
                         " of their 7 decimal digits are lost"));
    }

    std::vector<glm::vec2> read_uv(const std::string& name) {
        std::vector<glm::vec2> uv = read<glm::vec2>(name);
        size_t repaired = 0;
        for (glm::vec2& entry : uv)
            if (!is_finite(entry)) entry = glm::vec2(0.0f), ++repaired;
        if (repaired) warn(message(name, ": ", repaired, " non-finite texture coordinates set to 0"));
        return uv;
    }

    void read_colors() {
        int accessor = primitive_.attributes.at("COLOR_0");
        if (reader_.components(accessor) == 4) {
            mesh_.colors = read<glm::vec4>("COLOR_0");
        } else {
            reader_.charge(sizeof(float) * mesh_.positions.size(), where_);
            for (const glm::vec3& color : read<glm::vec3>("COLOR_0"))
                mesh_.colors.emplace_back(color, 1.0f);
        }
        for (glm::vec4& color : mesh_.colors)
            color = is_finite(color) ? glm::clamp(color, 0.0f, 1.0f) : glm::vec4(1.0f);
    }

    void read_triangles() {
        size_t vertex_count = mesh_.positions.size();
        std::vector<uint32_t> order;
        if (primitive_.indices >= 0) {
            order = reader_.read_indices(primitive_.indices, where_ + ".indices");
            for (uint32_t index : order)
                if (index >= vertex_count)
                    fail("indices",
                         message("expected each below the vertex count ", vertex_count, ", got ", index));
        } else {
            reader_.charge(vertex_count * sizeof(uint32_t), where_);
            order.resize(vertex_count);
            for (size_t i = 0; i < vertex_count; ++i)
                order[i] = static_cast<uint32_t>(i);
        }
        if (primitive_.mode == TINYGLTF_MODE_TRIANGLES) {
            if (order.size() % 3 != 0)
                warn(message("expected three indices per triangle, got ", order.size(),
                             ": the last are left out"));
            order.resize(order.size() / 3 * 3);
            mesh_.indices = std::move(order);
            return;
        }
        // Strips and fans, glTF 2.0 section 3.7.2.1; every second triangle of a strip is turned to face as
        // the others.
        if (order.size() < 3) return;
        reader_.charge((order.size() - 2) * 3 * sizeof(uint32_t), where_);
        bool is_strip = primitive_.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        for (size_t i = 0; i + 2 < order.size(); ++i) {
            std::array<uint32_t, 3> triangle = {order[i + 1], order[i + 2], order[0]};
            if (is_strip) triangle = {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]};
            if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
                continue;
            mesh_.indices.insert(mesh_.indices.end(), triangle.begin(), triangle.end());
        }
    }

    void read_frames() {
        const bool has_normals = primitive_.attributes.count("NORMAL") > 0;
        if (has_normals) {
            mesh_.normals = read<glm::vec3>("NORMAL");
            repair_normals();
        }
        if (has_normals && primitive_.attributes.count("TANGENT")) {
            mesh_.tangents = read<glm::vec4>("TANGENT");
            repair_tangents();
        }
        if (skin_ && has_joints(primitive_))
            place_by_joints(mesh_, SkinnedVertices(document_, reader_, *skin_, primitive_,
                                                   mesh_.positions.size(), where_, warnings_));
        if (has_normals) return;
        // Flat shading; glTF has given tangents ignored then.
        constexpr uint64_t BYTES_PER_CORNER =
            sizeof(glm::vec3) * 2 + sizeof(glm::vec2) * 2 + sizeof(glm::vec4) + 8;
        reader_.charge(mesh_.indices.size() * BYTES_PER_CORNER, where_);
        compute_flat_normals(mesh_);
    }

    void repair_normals() {
        std::vector<size_t> broken;
        for (size_t i = 0; i < mesh_.normals.size(); ++i) {
            glm::dvec3 normal = mesh_.normals[i];
            double length = glm::length(normal);
            if (length > 1e-12 && std::isfinite(length))
                mesh_.normals[i] = glm::vec3(normal / length);
            else
                broken.push_back(i);
        }
        if (broken.empty()) return;
        warn(message(broken.size(), " normals without direction replaced by the mean of their faces"));
        Mesh averaged;
        averaged.positions = mesh_.positions;
        averaged.indices = mesh_.indices;
        compute_normals(averaged);
        for (size_t i : broken)
            mesh_.normals[i] = averaged.normals[i];
    }

    /// Makes tangents unit and across the normal; drops them all where one has no direction.
    void repair_tangents() {
        for (size_t i = 0; i < mesh_.tangents.size(); ++i) {
            glm::dvec3 normal = mesh_.normals[i], tangent = glm::vec3(mesh_.tangents[i]);
            tangent -= normal * glm::dot(normal, tangent);
            double length = glm::length(tangent);
            if (!(length > 1e-6) || !std::isfinite(length) || !std::isfinite(mesh_.tangents[i].w)) {
                warn(message("the tangent at ", i, " has no direction: given tangents are left out"));
                mesh_.tangents.clear();
                return;
            }
            mesh_.tangents[i] =
                glm::vec4(glm::vec3(tangent / length), mesh_.tangents[i].w < 0.0f ? -1.0f : 1.0f);
        }
    }

    const Document& document_;
    AccessorReader& reader_;
    const tinygltf::Primitive& primitive_;
    const Skin* skin_;
    const std::string& where_;
    std::vector<std::string>& warnings_;
    Mesh mesh_;
};

} // namespace

std::optional<Mesh> load_primitive(const Document& document, AccessorReader& reader,
                                   const tinygltf::Primitive& primitive, const Skin* skin,
                                   const std::string& where, std::vector<std::string>& warnings) {
    return PrimitiveLoader(document, reader, primitive, skin, where, warnings).load();
}

void complete_mesh(Mesh& mesh, const Material& material, AccessorReader& reader, const std::string& where,
                   std::vector<std::string>& warnings) {
    if (!material.source) return;
    const MetallicRoughness& source = *material.source;
    bool needs_uv[2] = {};
    for (const TextureKind& kind : TEXTURE_KINDS)
        if ((source.*kind.use).is_used()) needs_uv[(source.*kind.use).uv_set] = true;
    bool has_uv[2] = {!mesh.uv0.empty(), !mesh.uv1.empty()};

    bool has_normal_map = source.normal_texture.is_used() || source.clearcoat_normal_texture.is_used();
    bool is_anisotropic = source.anisotropy > 0.0f;
    if ((has_normal_map || is_anisotropic) && mesh.tangents.empty()) {
        // There is one frame for all textures of directions: that of the coordinates by which the normal map
        // is read, as KHR_materials_anisotropy asks, else the anisotropy texture, else the coat's normal map,
        // else of the first coordinates there are.
        TextureUse use;
        use.uv_set = has_uv[0] || !has_uv[1] ? 0u : 1u;
        for (const TextureUse* first :
             {&source.normal_texture, &source.anisotropy_texture, &source.clearcoat_normal_texture}) {
            if (!first->is_used()) continue;
            use = *first;
            break;
        }
        if (has_uv[use.uv_set]) {
            constexpr uint64_t BYTES_PER_CORNER = 208; // while they are derived
            reader.require_room(mesh.indices.size() * BYTES_PER_CORNER, where);
            compute_tangents(mesh, use.uv_set, use.uv_scale_rotation);
            reader.charge(mesh.positions.size() * sizeof(glm::vec4), where);
        } else {
            compute_tangents_around_y(mesh);
            reader.charge(mesh.positions.size() * sizeof(glm::vec4), where);
            warnings.push_back(
                where + ": no tangents and no texture coordinates to derive them from: they follow the "
                        "longitude around the object's y axis");
        }
    }
    for (int set = 0; set < 2; ++set) {
        if (!needs_uv[set] || has_uv[set]) continue;
        warnings.push_back(
            message(where, ": its material reads TEXCOORD_", set, ", which it lacks: taken as 0"));
        reader.charge(mesh.positions.size() * sizeof(glm::vec2), where);
        (set == 0 ? mesh.uv0 : mesh.uv1).assign(mesh.positions.size(), glm::vec2(0.0f));
    }
}

} // namespace burnish::gltf
