#include "burnish/scene/gltf/nodes.h"

#include <algorithm>
#include <set>

#include <glm/gtc/quaternion.hpp>

#include "burnish/check.h"
#include "burnish/error.h"

namespace burnish::gltf {
namespace {

glm::dmat4 transform_of(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale) {
    const double length = glm::length(rotation);
    glm::dmat4 matrix = length > 0.0 ? glm::mat4_cast(rotation / length) : glm::dmat4(1.0);
    for (int column = 0; column < 3; ++column)
        matrix[column] *= scale[column];
    matrix[3] = glm::dvec4(translation, 1.0);
    return matrix;
}

glm::dmat4 local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[i];
        return matrix;
    }
    const auto vector_or = [](const std::vector<double>& v, double fallback) {
        return v.size() == 3 ? glm::dvec3(v[0], v[1], v[2]) : glm::dvec3(fallback);
    };
    const std::vector<double>& r = node.rotation;
    const glm::dquat rotation = r.size() == 4 ? glm::dquat(r[3], r[0], r[1], r[2]) : glm::dquat(1, 0, 0, 0);
    return transform_of(vector_or(node.translation, 0.0), rotation, vector_or(node.scale, 1.0));
}

} // namespace

NodeTree::NodeTree(const Document& document) : document_(document) {
    const std::vector<tinygltf::Node>& nodes = document_.model.nodes;
    const std::vector<int> roots = find_roots();
    // With one parent each, a node belongs to a cycle exactly if no root reaches it.
    std::vector<int> reached = roots;
    world_from_node_.resize(nodes.size());
    for (const int root : roots)
        world_from_node_[root] = local_transform(nodes[root]);
    for (size_t i = 0; i < reached.size(); ++i)
        for (const int child : nodes[reached[i]].children) {
            world_from_node_[child] = world_from_node_[reached[i]] * local_transform(nodes[child]);
            reached.push_back(child);
        }
    if (reached.size() < nodes.size()) {
        const std::set<int> outside(reached.begin(), reached.end());
        for (size_t i = 0; i < nodes.size(); ++i)
            if (!outside.count(static_cast<int>(i)))
                throw FileError(
                    document_.path,
                    message("nodes[", i, "]: expected a tree, got a node among its own descendants"));
    }
    scene_roots_ = scene_roots(roots);
}

std::vector<int> NodeTree::find_roots() const {
    const std::vector<tinygltf::Node>& nodes = document_.model.nodes;
    std::vector<int> parent(nodes.size(), -1), roots;
    for (size_t i = 0; i < nodes.size(); ++i)
        for (const int child : nodes[i].children) {
            if (parent[child] != -1)
                throw FileError(document_.path, message("nodes[", child, "]: expected one parent, got nodes[",
                                                        parent[child], "] and nodes[", i, "]"));
            parent[child] = static_cast<int>(i);
        }
    for (size_t i = 0; i < nodes.size(); ++i)
        if (parent[i] == -1) roots.push_back(static_cast<int>(i));
    return roots;
}

std::vector<int> NodeTree::scene_roots(const std::vector<int>& roots) const {
    const tinygltf::Model& model = document_.model;
    if (model.scenes.empty()) return roots;
    const tinygltf::Scene& chosen = model.scenes[std::max(model.defaultScene, 0)];
    std::set<int> seen;
    for (const int root : chosen.nodes)
        if (!seen.insert(root).second || !std::binary_search(roots.begin(), roots.end(), root))
            throw FileError(document_.path,
                            message("scenes.nodes: expected each root node once, got nodes[", root, "]"));
    return chosen.nodes;
}

std::vector<int> NodeTree::drawn() const {
    // Without recursion: a chain of nodes may be long.
    std::vector<int> order, stack(scene_roots_.rbegin(), scene_roots_.rend());
    while (!stack.empty()) {
        const int node = stack.back();
        stack.pop_back();
        order.push_back(node);
        const std::vector<int>& children = document_.model.nodes[node].children;
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
    return order;
}

std::vector<glm::dmat4> node_from_instances(const Document& document, AccessorReader& reader, int node) {
    const auto& extensions = document.model.nodes[node].extensions;
    const auto extension = extensions.find("EXT_mesh_gpu_instancing");
    if (extension == extensions.end() || !extension->second.Has("attributes")) return {glm::dmat4(1.0)};
    const tinygltf::Value& attributes = extension->second.Get("attributes");
    const std::string where = message("nodes[", node, "].EXT_mesh_gpu_instancing");

    size_t count = 0;
    const char* counted = nullptr;
    const auto accessor_of = [&](const char* name) {
        if (!attributes.Has(name)) return -1;
        const int accessor = attributes.Get(name).GetNumberAsInt();
        const size_t found = reader.count(accessor);
        if (counted && found != count)
            throw FileError(document.path, message(where, ".", name, ": expected as many as ", counted, " (",
                                                   count, "), got ", found));
        counted = name;
        count = found;
        return accessor;
    };
    const int translation = accessor_of("TRANSLATION"), rotation = accessor_of("ROTATION"),
              scale = accessor_of("SCALE");
    if (!counted) return {glm::dmat4(1.0)};
    if (count > MAX_OBJECTS)
        throw FileError(document.path,
                        message(where, ": expected at most ", MAX_OBJECTS, " instances, got ", count));
    std::vector<glm::vec3> translations(count, glm::vec3(0.0f)), scales(count, glm::vec3(1.0f));
    std::vector<glm::vec4> rotations(count, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    if (translation >= 0) translations = reader.read<glm::vec3>(translation, where + ".TRANSLATION");
    if (rotation >= 0) rotations = reader.read<glm::vec4>(rotation, where + ".ROTATION");
    if (scale >= 0) scales = reader.read<glm::vec3>(scale, where + ".SCALE");
    std::vector<glm::dmat4> matrices;
    for (size_t i = 0; i < count; ++i)
        matrices.push_back(transform_of(
            translations[i], glm::dquat(rotations[i].w, rotations[i].x, rotations[i].y, rotations[i].z),
            scales[i]));
    return matrices;
}

void require_affine(const Document& document, const glm::dmat4& matrix, const std::string& where) {
    const glm::mat4 rounded(matrix);
    if (!is_finite(rounded) || rounded[0].w != 0.0f || rounded[1].w != 0.0f || rounded[2].w != 0.0f ||
        rounded[3].w != 1.0f)
        throw FileError(document.path, where + ": expected a finite affine transform, got another");
}

} // namespace burnish::gltf
