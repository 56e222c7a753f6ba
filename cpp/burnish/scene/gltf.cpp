// load_gltf: from a checked document to a scene. Nodes become objects and cameras with world transforms.
#include <algorithm>
#include <set>

#include <glm/gtc/quaternion.hpp>

#include "burnish/error.h"
#include "burnish/scene/check.h"
#include "burnish/scene/gltf_material.h"
#include "burnish/scene/gltf_mesh.h"

namespace burnish {
namespace gltf {
namespace {

constexpr size_t MAX_WARNINGS = 200;

glm::dmat4 local_transform(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[i];
        return matrix;
    }
    if (node.rotation.size() == 4) {
        glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        double length = glm::length(rotation);
        if (length > 0.0) matrix = glm::mat4_cast(rotation / length);
    }
    if (node.scale.size() == 3)
        for (int column = 0; column < 3; ++column)
            matrix[column] *= node.scale[column];
    if (node.translation.size() == 3)
        matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
    return matrix;
}

class SceneBuilder {
public:
    SceneBuilder(const Document& document, Scene& scene)
        : document_(document), scene_(scene), reader_(document), materials_(document, reader_, scene) {}

    void build() {
        materials_.load();
        check_tree();
        for (int root : roots())
            visit(root);
        make_names_unique();
    }

private:
    struct Part {
        uint32_t mesh, material;
    };

    std::string node_name(int index) const {
        const std::string& name = document_.model.nodes[index].name;
        return name.empty() ? message("node.", index) : name;
    }

    /// glTF demands a forest: every node at most once a child, no cycle.
    void check_tree() {
        const std::vector<tinygltf::Node>& nodes = document_.model.nodes;
        std::vector<int> parent(nodes.size(), -1);
        for (size_t i = 0; i < nodes.size(); ++i) {
            for (int child : nodes[i].children) {
                if (parent[child] != -1)
                    throw FileError(document_.path,
                                    message("nodes[", child, "]: expected one parent, got nodes[",
                                            parent[child], "] and nodes[", i, "]"));
                parent[child] = static_cast<int>(i);
            }
        }
        // With one parent each, a node belongs to a cycle exactly if no root reaches it.
        std::vector<int> reached;
        for (size_t i = 0; i < nodes.size(); ++i)
            if (parent[i] == -1) reached.push_back(static_cast<int>(i));
        roots_ = reached;
        for (size_t i = 0; i < reached.size(); ++i)
            reached.insert(reached.end(), nodes[reached[i]].children.begin(),
                           nodes[reached[i]].children.end());
        if (reached.size() == nodes.size()) return;
        std::set<int> outside(reached.begin(), reached.end());
        for (size_t i = 0; i < nodes.size(); ++i)
            if (!outside.count(static_cast<int>(i)))
                throw FileError(
                    document_.path,
                    message("nodes[", i, "]: expected a tree, got a node among its own descendants"));
    }

    std::vector<int> roots() {
        const tinygltf::Model& model = document_.model;
        if (model.scenes.empty()) return roots_;
        const tinygltf::Scene& chosen = model.scenes[std::max(model.defaultScene, 0)];
        scene_.name = chosen.name;
        std::set<int> seen;
        for (int root : chosen.nodes)
            if (!seen.insert(root).second || !std::count(roots_.begin(), roots_.end(), root))
                throw FileError(document_.path,
                                message("scenes.nodes: expected each root node once, got nodes[", root, "]"));
        return chosen.nodes;
    }

    /// Depth first without recursion: a chain of nodes may be long.
    void visit(int root) {
        std::vector<std::pair<int, glm::dmat4>> stack = {{root, glm::dmat4(1.0)}};
        while (!stack.empty()) {
            auto [index, world_from_parent] = stack.back();
            stack.pop_back();
            const tinygltf::Node& node = document_.model.nodes[index];
            glm::dmat4 world_from_node = world_from_parent * local_transform(node);
            glm::mat4 rounded(world_from_node);
            if (!is_finite(rounded) || rounded[0].w != 0.0f || rounded[1].w != 0.0f || rounded[2].w != 0.0f ||
                rounded[3].w != 1.0f)
                throw FileError(
                    document_.path,
                    message("nodes[", index, "]: expected a finite affine transform, got another"));
            if (node.mesh >= 0) add_objects(index, rounded);
            if (node.camera >= 0) add_camera(index, world_from_node);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                stack.emplace_back(*child, world_from_node);
        }
    }

    void add_objects(int index, const glm::mat4& world_from_object) {
        const std::vector<Part>& parts = parts_of(document_.model.nodes[index].mesh);
        std::string name = node_name(index);
        for (size_t i = 0; i < parts.size(); ++i) {
            if (scene_.objects.size() >= MAX_OBJECTS)
                throw FileError(document_.path,
                                message("nodes: expected at most ", MAX_OBJECTS, " objects, got more"));
            scene_.objects.push_back({.name = parts.size() == 1 ? name : message(name, ".", i),
                                      .mesh = parts[i].mesh,
                                      .material = parts[i].material,
                                      .world_from_object = world_from_object});
        }
    }

    /// The meshes of a file's mesh, loaded on first use and shared by all nodes that place it.
    const std::vector<Part>& parts_of(int mesh_index) {
        auto known = parts_.find(mesh_index);
        if (known != parts_.end()) return known->second;
        std::vector<Part>& parts = parts_[mesh_index];
        const tinygltf::Mesh& from = document_.model.meshes[mesh_index];
        for (size_t i = 0; i < from.primitives.size(); ++i) {
            std::string where = message("meshes[", mesh_index, "].primitives[", i, "]");
            std::optional<Mesh> mesh =
                load_primitive(document_, reader_, from.primitives[i], where, scene_.warnings);
            if (!mesh) continue;
            uint32_t material = materials_.find(from.primitives[i].material, !mesh->colors.empty());
            complete_mesh(*mesh, scene_.materials[material], reader_, where, scene_.warnings);
            std::string name = from.name.empty() ? message("mesh.", mesh_index) : from.name;
            mesh->name = from.primitives.size() == 1 ? name : message(name, ".", i);
            parts.push_back({static_cast<uint32_t>(scene_.meshes.size()), material});
            scene_.meshes.push_back(std::move(*mesh));
        }
        return parts;
    }

    void add_camera(int index, const glm::dmat4& world_from_node) {
        const tinygltf::Camera& from = document_.model.cameras[document_.model.nodes[index].camera];
        std::string where = message("nodes[", index, "].camera");
        Camera camera;
        camera.name =
            !document_.model.nodes[index].name.empty() || from.name.empty() ? node_name(index) : from.name;
        // glTF: a camera's view is not scaled with its node. What is left of the axes is made orthogonal.
        glm::dvec3 backward(world_from_node[2]), up(world_from_node[1]);
        if (!(glm::length(backward) > 0.0)) {
            scene_.warnings.push_back(where + ": left out, its node has no direction to look along");
            return;
        }
        try {
            glm::dvec3 eye(world_from_node[3]);
            camera.world_from_camera =
                look_at(glm::vec3(0.0f), glm::vec3(-glm::normalize(backward)), glm::vec3(up))
                    .world_from_camera;
            camera.world_from_camera[3] = glm::vec4(glm::vec3(eye), 1.0f);
            camera.is_orthographic = from.type == "orthographic";
            if (camera.is_orthographic) {
                camera.half_height = static_cast<float>(std::abs(from.orthographic.ymag));
                camera.near_plane = static_cast<float>(from.orthographic.znear);
                camera.far_plane = static_cast<float>(from.orthographic.zfar);
            } else {
                camera.vertical_fov = static_cast<float>(from.perspective.yfov);
                camera.near_plane = static_cast<float>(from.perspective.znear);
            }
            validate(camera);
        } catch (const std::invalid_argument& error) {
            scene_.warnings.push_back(where + ": left out: " + error.what());
            return;
        }
        scene_.cameras.push_back(std::move(camera));
    }

    void make_names_unique() {
        std::set<std::string> taken;
        std::map<std::string, size_t> next;
        for (Object& object : scene_.objects) {
            std::string name = object.name;
            while (!taken.insert(name).second)
                name = message(object.name, ".", ++next[object.name]);
            object.name = name;
        }
    }

    const Document& document_;
    Scene& scene_;
    AccessorReader reader_;
    MaterialLoader materials_;
    std::vector<int> roots_;
    std::map<int, std::vector<Part>> parts_;
};

void tidy_warnings(std::vector<std::string>& warnings) {
    std::set<std::string> seen;
    std::vector<std::string> kept;
    for (std::string& warning : warnings)
        if (seen.insert(warning).second) kept.push_back(std::move(warning));
    if (kept.size() > MAX_WARNINGS) {
        size_t more = kept.size() - MAX_WARNINGS;
        kept.resize(MAX_WARNINGS);
        kept.push_back(message("and ", more, " more warnings"));
    }
    warnings = std::move(kept);
}

Scene load(const std::string& path) {
    Container container = read_container(path);
    Document document = parse_document(path, container.json);
    container.json = {};
    load_buffers(document, container);
    Scene scene;
    scene.warnings = document.warnings;
    scene.ignored_extensions = document.ignored_extensions;
    SceneBuilder(document, scene).build();
    if (scene.name.empty()) scene.name = std::filesystem::path(path).stem().string();
    tidy_warnings(scene.warnings);
    validate(scene);
    return scene;
}

} // namespace
} // namespace gltf

Scene load_gltf(const std::string& path) {
    // One door: whatever a broken file trips over, the caller sees the path and a sentence.
    try {
        return gltf::load(path);
    } catch (const FileError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw FileError(path, "needs more memory than there is");
    } catch (const std::exception& error) {
        throw FileError(path, error.what());
    }
}

} // namespace burnish
