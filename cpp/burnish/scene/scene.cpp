#include "burnish/scene/scene.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "burnish/scene/check.h"

namespace burnish {
namespace {

struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{-std::numeric_limits<float>::max()};
    bool is_empty() const { return low.x > high.x; }
};

void extend(Box& box, const Scene& scene, const Object& object) {
    constexpr float LARGEST = std::numeric_limits<float>::max();
    for (const glm::vec3& position : scene.meshes.at(object.mesh).positions) {
        glm::vec3 world =
            glm::clamp(glm::vec3(object.world_from_object * glm::vec4(position, 1.0f)), -LARGEST, LARGEST);
        box.low = glm::min(box.low, world);
        box.high = glm::max(box.high, world);
    }
}

Bounds bounds_of(const Box& box) {
    return box.is_empty() ? Bounds{glm::vec3(-1.0f), glm::vec3(1.0f)} : Bounds{box.low, box.high};
}

/// Runs a check and puts `where` before its message.
template <typename Check>
void within(const std::string& where, const Check& check) {
    try {
        check();
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(where + "." + error.what());
    }
}

void validate_textures(const Scene& scene, const MetallicRoughness& source) {
    for (const TextureUse* use :
         {&source.base_color_texture, &source.metallic_roughness_texture, &source.normal_texture,
          &source.occlusion_texture, &source.emissive_texture, &source.specular_texture,
          &source.specular_color_texture, &source.anisotropy_texture, &source.clearcoat_texture,
          &source.clearcoat_roughness_texture}) {
        if (!use->is_used()) continue;
        if (static_cast<size_t>(use->image) >= scene.images.size())
            throw std::invalid_argument(message("source.texture.image: expected an index below ",
                                                scene.images.size(), ", got ", use->image));
        if (use->uv_set > 1)
            throw std::invalid_argument(message("source.texture.uv_set: expected 0 or 1, got ", use->uv_set));
    }
}

} // namespace

Bounds Scene::bounds() const {
    Box box;
    for (const Object& object : objects)
        extend(box, *this, object);
    return bounds_of(box);
}

Bounds Scene::object_bounds(uint32_t object) const {
    if (object >= objects.size())
        throw std::invalid_argument(
            message("object: expected an index below ", objects.size(), ", got ", object));
    Box box;
    extend(box, *this, objects[object]);
    return bounds_of(box);
}

Camera Scene::default_camera() const {
    constexpr float FOV = 0.6f, MARGIN = 1.08f;
    const glm::vec3 toward_eye =
        glm::normalize(glm::vec3(0.45f, 0.4f, 1.0f)); // three quarters, a little above
    Bounds box = bounds();
    glm::vec3 center = 0.5f * box.low + 0.5f * box.high; // not of the sum, which may overflow
    glm::vec3 half = 0.5f * box.high - 0.5f * box.low;

    // The distance from which every corner of the box lies within the square picture of this field of view.
    Camera axes = look_at(toward_eye, glm::vec3(0.0f), {0, 1, 0});
    glm::vec3 right(axes.world_from_camera[0]), up(axes.world_from_camera[1]);
    float spread = std::tan(0.5f * FOV) / MARGIN, distance = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        glm::vec3 offset = half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        float across = std::max(std::abs(glm::dot(offset, right)), std::abs(glm::dot(offset, up)));
        distance = std::max(distance, across / spread + glm::dot(offset, toward_eye));
    }
    // A point, or a world too large to square in float: any view is as good.
    float largest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z), 1e-3f});
    distance = std::clamp(distance, 1e-5f * largest, 1e18f);
    Camera camera = look_at(center + distance * toward_eye, center, {0, 1, 0});
    camera.name = "default";
    camera.vertical_fov = FOV;
    camera.near_plane = 1e-3f * distance;
    return camera;
}

uint32_t Scene::find_object(const std::string& object_name) const {
    for (uint32_t i = 0; i < objects.size(); ++i)
        if (objects[i].name == object_name) return i;
    constexpr size_t LISTED = 20;
    std::string names;
    for (size_t i = 0; i < std::min(objects.size(), LISTED); ++i)
        names += (i ? ", \"" : "\"") + objects[i].name + "\"";
    if (objects.size() > LISTED) names += message(" and ", objects.size() - LISTED, " more");
    throw std::invalid_argument(message("object: expected one of ", names.empty() ? "no objects" : names,
                                        ", got \"", object_name, "\""));
}

void validate(const Scene& scene) {
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        within(message("meshes[", i, "]"), [&] { validate(scene.meshes[i]); });
    for (size_t i = 0; i < scene.materials.size(); ++i)
        within(message("materials[", i, "]"), [&] {
            validate(scene.materials[i]);
            if (scene.materials[i].source) validate_textures(scene, *scene.materials[i].source);
        });
    for (size_t i = 0; i < scene.images.size(); ++i) {
        const TextureImage& image = scene.images[i];
        if (image.rgba.empty() || image.rgba.size() != size_t{4} * image.width * image.height)
            throw std::invalid_argument(message("images[", i, "].rgba: expected width * height * 4 = ",
                                                size_t{4} * image.width * image.height, " > 0 bytes, got ",
                                                image.rgba.size()));
    }
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        within(message("cameras[", i, "]"), [&] { validate(scene.cameras[i]); });
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        std::string where = message("objects[", i, "].");
        if (object.mesh >= scene.meshes.size())
            throw std::invalid_argument(
                message(where, "mesh: expected an index below ", scene.meshes.size(), ", got ", object.mesh));
        if (object.material >= scene.materials.size())
            throw std::invalid_argument(message(where, "material: expected an index below ",
                                                scene.materials.size(), ", got ", object.material));
        if (!is_finite(object.world_from_object))
            throw std::invalid_argument(where +
                                        "world_from_object: expected finite numbers, got a non-finite one");
    }
}

} // namespace burnish
