#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>

#include "burnish/check.h"
#include "burnish/scene/scene.h"

namespace burnish {
namespace {

constexpr uint32_t SPHERE_SEGMENTS = 128;
constexpr float SPHERE_SPACING = 2.2f; ///< between centres of unit spheres

Scene single(const char* name, Mesh mesh, const Material& material) {
    validate(material);
    Scene scene;
    scene.name = name;
    scene.objects.push_back({.name = name});
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material);
    return scene;
}

} // namespace

Scene Scene::sphere(const Material& material) {
    return single("sphere", make_sphere(1.0f, SPHERE_SEGMENTS), material);
}

Scene Scene::plane(const Material& material) {
    return single("plane", make_plane(2.0f, 1), material);
}

Scene Scene::spheres(const std::vector<Material>& materials, uint32_t columns) {
    if (materials.empty()) throw std::invalid_argument("materials: expected at least one, got none");
    if (columns == 0) throw std::invalid_argument("columns: expected a number >= 1, got 0");
    Scene scene;
    scene.name = "spheres";
    scene.meshes.push_back(make_sphere(1.0f, SPHERE_SEGMENTS));
    uint32_t count = static_cast<uint32_t>(materials.size());
    uint32_t used_columns = std::min(columns, count), rows = (count + columns - 1) / columns;
    for (uint32_t i = 0; i < count; ++i) {
        validate(materials[i]);
        scene.materials.push_back(materials[i]);
        float x = static_cast<float>(i % columns) - 0.5f * static_cast<float>(used_columns - 1);
        float y = 0.5f * static_cast<float>(rows - 1) - static_cast<float>(i / columns);
        scene.objects.push_back({.name = message("sphere.", i),
                                 .material = i,
                                 .world_from_object = glm::translate(
                                     glm::dmat4(1.0), double(SPHERE_SPACING) * glm::dvec3(x, y, 0))});
    }
    return scene;
}

Scene Scene::shader_ball(const Material& material, const Material& ground) {
    Scene scene = single("ball", make_shader_ball(SPHERE_SEGMENTS), material);
    validate(ground);
    scene.name = "shader_ball";
    scene.meshes.push_back(make_plane(6.0f, 1));
    scene.materials.push_back(ground);
    scene.objects.push_back({.name = "ground", .mesh = 1, .material = 1});
    return scene;
}

} // namespace burnish
