#include "burnish/scene/scene.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "burnish/check.h"
#include "burnish/scene/texture_kinds.h"

namespace burnish {
namespace {

constexpr double LARGEST = std::numeric_limits<float>::max();

struct Box {
    glm::dvec3 low{LARGEST};
    glm::dvec3 high{-LARGEST};
    bool is_empty() const { return low.x > high.x; }
};

void extend(Box& box, const Scene& scene, const Object& object) {
    for (const glm::vec3& position : scene.meshes.at(object.mesh).positions) {
        glm::dvec3 world = glm::clamp(
            glm::dvec3(object.world_from_object * glm::dvec4(glm::dvec3(position), 1.0)), -LARGEST, LARGEST);
        box.low = glm::min(box.low, world);
        box.high = glm::max(box.high, world);
    }
}

Bounds bounds_of(const Box& box) {
    return box.is_empty() ? Bounds{glm::dvec3(-1.0), glm::dvec3(1.0)} : Bounds{box.low, box.high};
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
    for (const TextureKind& kind : TEXTURE_KINDS) {
        const TextureUse& use = source.*kind.use;
        if (!use.is_used()) continue;
        if (static_cast<size_t>(use.image) >= scene.images.size())
            throw std::invalid_argument(message("source.texture.image: expected an index below ",
                                                scene.images.size(), ", got ", use.image));
        if (use.uv_set > 1)
            throw std::invalid_argument(message("source.texture.uv_set: expected 0 or 1, got ", use.uv_set));
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
    constexpr double FOV = 0.6, MARGIN = 1.08;
    const glm::dvec3 toward_eye =
        glm::normalize(glm::dvec3(0.45, 0.4, 1.0)); // three quarters, a little above
    const Bounds box = bounds();
    const glm::dvec3 center = box.center(), half = 0.5 * (box.high - box.low);

    // The distance from which every corner of the box lies within the square picture of this field of view.
    Camera axes = look_at(toward_eye, glm::dvec3(0.0), {0, 1, 0});
    const glm::dvec3 right(axes.world_from_camera[0]), up(axes.world_from_camera[1]);
    const double spread = std::tan(0.5 * FOV) / MARGIN;
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 offset = half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        double across = std::max(std::abs(glm::dot(offset, right)), std::abs(glm::dot(offset, up)));
        distance = std::max(distance, across / spread + glm::dot(offset, toward_eye));
    }
    // A point, a scene so far away that doubles end, or one too large to square in float: any view is as
    // good.
    const double largest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    const double least = distance > 0.0 ? std::max(1e-12 * largest, 1e-30) : std::max(1e-5 * largest, 1e-8);
    distance = std::clamp(distance, least, 1e18);
    Camera camera = look_at(center + distance * toward_eye, center, {0, 1, 0});
    camera.name = "default";
    camera.vertical_fov = static_cast<float>(FOV);
    camera.near_plane = static_cast<float>(1e-3 * distance);
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
    for (size_t i = 0; i < scene.lights.size(); ++i)
        within(message("lights[", i, "]"), [&] { validate(scene.lights[i]); });
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        std::string where = message("objects[", i, "].");
        if (object.mesh >= scene.meshes.size())
            throw std::invalid_argument(
                message(where, "mesh: expected an index below ", scene.meshes.size(), ", got ", object.mesh));
        if (object.material >= scene.materials.size())
            throw std::invalid_argument(message(where, "material: expected an index below ",
                                                scene.materials.size(), ", got ", object.material));
        if (!is_finite(glm::mat4(object.world_from_object)))
            throw std::invalid_argument(where +
                                        "world_from_object: expected finite numbers, got a non-finite one");
    }
}

} // namespace burnish
