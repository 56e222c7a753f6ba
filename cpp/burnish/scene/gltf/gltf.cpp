// load_gltf: from a checked document to a scene. Nodes become objects and cameras with world transforms.
#include <algorithm>
#include <set>

#include <glm/gtc/matrix_transform.hpp>

#include "burnish/check.h"
#include "burnish/error.h"
#include "burnish/scene/gltf/light.h"
#include "burnish/scene/gltf/material.h"
#include "burnish/scene/gltf/mesh.h"
#include "burnish/scene/idle_parts.h"

namespace burnish {
namespace gltf {
namespace {

constexpr size_t MAX_WARNINGS = 200;

class SceneBuilder {
public:
    SceneBuilder(const Document& document, MaterialModel model, Scene& scene)
        : document_(document), scene_(scene), reader_(document), materials_(document, reader_, model, scene),
          nodes_(document) {}

    void build() {
        const tinygltf::Model& model = document_.model;
        if (!model.scenes.empty()) scene_.name = model.scenes[std::max(model.defaultScene, 0)].name;
        materials_.load();
        for (const int node : nodes_.drawn())
            visit(node);
        const auto has_triangles = [&](const Object& object) {
            return !scene_.meshes[object.mesh].indices.empty();
        };
        if (std::none_of(scene_.objects.begin(), scene_.objects.end(), has_triangles))
            scene_.warnings.push_back("nothing is drawn: no node of the scene has a mesh with triangles");
        make_names_unique();
    }

private:
    struct Part {
        uint32_t mesh, material;
        bool is_skinned;
    };

    std::string node_name(int index) const {
        const std::string& name = document_.model.nodes[index].name;
        return name.empty() ? message("node.", index) : name;
    }

    void visit(int index) {
        const tinygltf::Node& node = document_.model.nodes[index];
        const glm::dmat4& world_from_node = nodes_.world_from_node(index);
        require_affine(document_, world_from_node, message("nodes[", index, "]"));
        if (node.mesh >= 0) add_objects(index, world_from_node);
        if (node.camera >= 0) add_camera(index, world_from_node);
        if (const auto light = light_of(document_, index, world_from_node, scene_.warnings))
            scene_.lights.push_back(*light);
    }

    void add_objects(int index, const glm::dmat4& world_from_node) {
        const tinygltf::Node& node = document_.model.nodes[index];
        const std::vector<Part>& parts = parts_of(node.mesh, node.skin);
        const std::vector<glm::dmat4> instances = node_from_instances(document_, reader_, index);
        if (scene_.objects.size() + parts.size() * instances.size() > MAX_OBJECTS)
            throw FileError(document_.path,
                            message("nodes: expected at most ", MAX_OBJECTS, " objects, got more"));
        for (const glm::dmat4& node_from_instance : instances) {
            const glm::dmat4 world_from_instance = world_from_node * node_from_instance;
            require_affine(document_, world_from_instance, message("nodes[", index, "]'s instances"));
            for (size_t i = 0; i < parts.size(); ++i)
                scene_.objects.push_back(
                    {.name = parts.size() == 1 ? node_name(index) : message(node_name(index), ".", i),
                     .mesh = parts[i].mesh,
                     .material = parts[i].material,
                     // Joints place a skinned mesh in the world, whatever its node does.
                     .world_from_object = parts[i].is_skinned
                                              ? glm::translate(glm::dmat4(1.0), skins_.at(node.skin).origin())
                                              : world_from_instance});
        }
    }

    const Skin* skin_of(int index) {
        if (index < 0) return nullptr;
        auto known = skins_.find(index);
        if (known == skins_.end())
            known = skins_.emplace(index, Skin(document_, reader_, nodes_, index)).first;
        return &known->second;
    }

    /// The meshes of a file's mesh, loaded on first use and shared by all nodes that place it by the same
    /// skin, or by none (-1).
    const std::vector<Part>& parts_of(int mesh_index, int skin_index) {
        auto known = parts_.find({mesh_index, skin_index});
        if (known != parts_.end()) return known->second;
        std::vector<Part>& parts = parts_[{mesh_index, skin_index}];
        const Skin* skin = skin_of(skin_index);
        const tinygltf::Mesh& from = document_.model.meshes[mesh_index];
        for (size_t i = 0; i < from.primitives.size(); ++i) {
            std::string where = message("meshes[", mesh_index, "].primitives[", i, "]");
            std::optional<Mesh> mesh =
                load_primitive(document_, reader_, from.primitives[i], skin, where, scene_.warnings);
            if (!mesh) continue;
            const bool is_skinned = skin && has_joints(from.primitives[i]);
            if (skin && !is_skinned)
                scene_.warnings.push_back(where + ": its node has a skin, but it has no JOINTS_0: placed by "
                                                  "the node alone");
            uint32_t material = materials_.find(from.primitives[i].material, !mesh->colors.empty());
            complete_mesh(*mesh, scene_.materials[material], reader_, where, scene_.warnings);
            std::string name = from.name.empty() ? message("mesh.", mesh_index) : from.name;
            mesh->name = from.primitives.size() == 1 ? name : message(name, ".", i);
            parts.push_back({static_cast<uint32_t>(scene_.meshes.size()), material, is_skinned});
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
            camera.world_from_camera =
                look_at(glm::dvec3(0.0), -glm::normalize(backward), up).world_from_camera;
            camera.world_from_camera[3] = world_from_node[3];
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
    const NodeTree nodes_;
    std::map<int, Skin> skins_;
    std::map<std::pair<int, int>, std::vector<Part>> parts_;
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

Scene load(const std::string& path, MaterialModel model) {
    Container container = read_container(path);
    Document document = parse_document(path, container.json);
    container.json = {};
    load_buffers(document, container);
    Scene scene;
    scene.warnings = document.warnings;
    scene.ignored_extensions = document.ignored_extensions;
    SceneBuilder(document, model, scene).build();
    if (scene.name.empty()) scene.name = std::filesystem::path(path).stem().string();
    tidy_warnings(scene.warnings);
    validate(scene);
    return scene;
}

} // namespace
} // namespace gltf

Scene load_gltf(const std::string& path, MaterialModel model, bool leaves_out_idle) {
    // One door: whatever a broken file trips over, the caller sees the path and a sentence.
    try {
        Scene scene = gltf::load(path, model);
        if (leaves_out_idle) leave_out_idle_textures(scene);
        return scene;
    } catch (const FileError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw FileError(path, "needs more memory than there is");
    } catch (const std::exception& error) {
        throw FileError(path, error.what());
    }
}

} // namespace burnish
