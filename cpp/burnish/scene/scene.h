// What there is to render, as plain data. Knows no Vulkan.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/light/direct_light.h"
#include "burnish/light/environment.h"
#include "burnish/scene/camera.h"
#include "burnish/scene/material.h"
#include "burnish/scene/mesh.h"
#include "burnish/scene/shared_parts.h"
#include "burnish/scene/texture.h"

namespace burnish {

/// One mesh placed in the world.
struct Object {
    std::string name;
    uint32_t mesh = 0;                 ///< index into Scene::meshes
    uint32_t material = 0;             ///< index into Scene::materials
    glm::dmat4 world_from_object{1.0}; ///< in double precision: float32 ends a few kilometres from the origin
    /// The map its lobes reflect: null = the scene's environment, else a captured or given one of its own.
    std::shared_ptr<const Environment> reflects = nullptr;
};

struct Bounds {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    glm::dvec3 center() const { return 0.5 * (low + high); }
    double radius() const { return 0.5 * glm::length(high - low); }
};

struct Scene {
    std::string name;
    SharedParts<Mesh> meshes;
    std::vector<Material> materials;
    SharedParts<TextureImage> images;
    std::vector<Object> objects;
    std::vector<Camera> cameras;
    std::vector<DirectLight> lights;
    std::shared_ptr<const Environment> environment;
    bool show_background = true;       ///< draw the environment where no object is
    std::vector<std::string> warnings; ///< what was repaired or left out while loading, a sentence each
    std::vector<std::string> ignored_extensions; ///< optional glTF extensions that have no effect here

    Bounds bounds() const; ///< of all objects in the world; the unit box about 0 when there are none
    Bounds object_bounds(uint32_t object) const;
    /// A camera that sees all of it, from the front and a little above.
    Camera default_camera() const;
    /// Index of the object of that name; throws std::invalid_argument listing the names there are.
    uint32_t find_object(const std::string& object_name) const;

    static Scene sphere(const Material& material);
    /// rows x columns unit spheres, one material each (row-major).
    static Scene spheres(const std::vector<Material>& materials, uint32_t columns);
    static Scene plane(const Material& material);
    /// The shader ball on a ground plane.
    static Scene shader_ball(const Material& material, const Material& ground);
};

/// Throws std::invalid_argument unless indices, sizes and numbers are consistent and finite.
void validate(const Scene& scene);

/// glTF 2.0 (.gltf, .glb). `leaves_out_idle`: without what changes no pixel, see idle_parts.h. Throws
/// FileError.
Scene load_gltf(const std::string& path, MaterialModel model = MaterialModel::ggx,
                bool leaves_out_idle = true);

} // namespace burnish
