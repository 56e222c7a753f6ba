#include "burnish/scene/gltf/skin.h"

#include <algorithm>

#include "burnish/check.h"
#include "burnish/error.h"

namespace burnish::gltf {
namespace {

/// Inverse matrices come out of a computation: a last row that is 0 0 0 1 but for rounding is that.
void tidy_last_row(glm::mat4& matrix) {
    const glm::vec4 row(matrix[0].w, matrix[1].w, matrix[2].w, matrix[3].w - 1.0f);
    if (!(glm::length(row) < 1e-3f)) return;
    for (int column = 0; column < 4; ++column)
        matrix[column].w = column == 3 ? 1.0f : 0.0f;
}

} // namespace

Skin::Skin(const Document& document, AccessorReader& reader, const NodeTree& nodes, int skin) {
    const tinygltf::Skin& from = document.model.skins[skin];
    const std::string where = message("skins[", skin, "]");
    std::vector<glm::mat4> joint_from_bind(from.joints.size(), glm::mat4(1.0f));
    if (from.inverseBindMatrices >= 0) {
        const size_t count = reader.count(from.inverseBindMatrices);
        if (count < from.joints.size())
            throw FileError(document.path,
                            message(where, ".inverseBindMatrices: expected as many as joints (",
                                    from.joints.size(), "), got ", count));
        joint_from_bind = reader.read<glm::mat4>(from.inverseBindMatrices, where + ".inverseBindMatrices");
    }
    for (size_t i = 0; i < from.joints.size(); ++i) {
        tidy_last_row(joint_from_bind[i]);
        world_from_bind_.push_back(nodes.world_from_node(from.joints[i]) * glm::dmat4(joint_from_bind[i]));
        require_affine(document, world_from_bind_.back(), message(where, ".joints[", i, "]"));
    }
    if (!from.joints.empty()) origin_ = nodes.world_from_node(from.joints[0])[3];
}

SkinnedVertices::SkinnedVertices(const Document& document, AccessorReader& reader, const Skin& skin,
                                 const tinygltf::Primitive& primitive, size_t vertex_count,
                                 const std::string& where, std::vector<std::string>& warnings)
    : skin_(skin) {
    const auto read = [&](const std::string& name, bool is_weight) {
        const int accessor = primitive.attributes.at(name);
        const int type = reader.component_type(accessor);
        const bool is_small =
            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        const bool is_float = type == TINYGLTF_COMPONENT_TYPE_FLOAT;
        if (is_weight ? !(is_float || (is_small && reader.is_normalized(accessor)))
                      : !(is_small && !reader.is_normalized(accessor)))
            throw FileError(document.path, message(where, ".", name, ": expected ",
                                                   is_weight ? "32-bit floats or normalized " : "",
                                                   "unsigned bytes or shorts, got component type ", type));
        if (reader.count(accessor) != vertex_count)
            throw FileError(document.path, message(where, ".", name, ": expected as many as POSITION (",
                                                   vertex_count, "), got ", reader.count(accessor)));
        return reader.read<glm::vec4>(accessor, where + "." + name);
    };
    for (int set = 0; primitive.attributes.count(message("JOINTS_", set)); ++set) {
        if (!primitive.attributes.count(message("WEIGHTS_", set)))
            throw FileError(document.path, message(where, ".JOINTS_", set, ": expected WEIGHTS_", set,
                                                   " beside it, got none"));
        joints_.push_back(read(message("JOINTS_", set), false));
        weights_.push_back(read(message("WEIGHTS_", set), true));
        for (glm::vec4& weight : weights_.back())
            weight = is_finite(weight) ? glm::max(weight, 0.0f) : glm::vec4(0.0f);
    }
    const size_t joint_count = skin.world_from_bind().size();
    size_t without_weight = 0;
    for (size_t vertex = 0; vertex < vertex_count; ++vertex) {
        double sum = 0.0;
        for (size_t set = 0; set < joints_.size(); ++set)
            for (int i = 0; i < 4; ++i) {
                sum += weights_[set][vertex][i];
                if (joints_[set][vertex][i] >= static_cast<float>(joint_count))
                    throw FileError(document.path,
                                    message(where, ".JOINTS_", set, ": expected each below the skin's ",
                                            joint_count, " joints, got ", joints_[set][vertex][i]));
            }
        if (sum > 0.0) continue;
        ++without_weight;
        weights_[0][vertex] = glm::vec4(1.0f, 0.0f, 0.0f, 0.0f);
    }
    if (without_weight > 0)
        warnings.push_back(
            message(where, ": ", without_weight, " vertices without weight are placed by their first joint"));
}

glm::dmat4 SkinnedVertices::matrix(size_t vertex) const {
    glm::dmat4 sum(0.0);
    double total = 0.0;
    for (size_t set = 0; set < joints_.size(); ++set)
        for (int i = 0; i < 4; ++i)
            if (weights_[set][vertex][i] > 0.0f) {
                glm::dmat4 joint = skin_.world_from_bind()[static_cast<size_t>(joints_[set][vertex][i])];
                joint[3] -= glm::dvec4(skin_.origin(), 0.0);
                const double weight = weights_[set][vertex][i];
                sum += weight * joint;
                total += weight;
            }
    return sum / total;
}

bool has_joints(const tinygltf::Primitive& primitive) {
    return primitive.attributes.count("JOINTS_0") > 0;
}

void place_by_joints(Mesh& mesh, const SkinnedVertices& skinned) {
    std::vector<bool> is_mirrored(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dmat4 matrix = skinned.matrix(i);
        const glm::dmat3 linear(matrix);
        mesh.positions[i] = glm::vec3(matrix * glm::dvec4(mesh.positions[i], 1.0));
        is_mirrored[i] = glm::determinant(linear) < 0.0;
        if (mesh.normals.empty()) continue;
        const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                   glm::cross(linear[0], linear[1]));
        const double sign = is_mirrored[i] ? -1.0 : 1.0;
        const glm::dvec3 normal = sign * (cofactors * glm::dvec3(mesh.normals[i]));
        // Joints that flatten a vertex's surroundings leave it the direction it had.
        const double length = glm::length(normal);
        if (length > 0.0) mesh.normals[i] = glm::vec3(normal / length);
        if (mesh.tangents.empty()) continue;
        const glm::dvec3 unit(mesh.normals[i]);
        glm::dvec3 tangent = linear * glm::dvec3(mesh.tangents[i]);
        tangent -= unit * glm::dot(unit, tangent);
        const double size = glm::length(tangent);
        if (size > 0.0)
            mesh.tangents[i] =
                glm::vec4(glm::vec3(tangent / size), static_cast<float>(sign) * mesh.tangents[i].w);
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        if (is_mirrored[mesh.indices[i]] && is_mirrored[mesh.indices[i + 1]] &&
            is_mirrored[mesh.indices[i + 2]])
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

} // namespace burnish::gltf
