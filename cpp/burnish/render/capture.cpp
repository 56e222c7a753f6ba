#include "burnish/render/capture.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "burnish/error.h"
#include "burnish/light/cube_texels.h"

namespace burnish::render {
namespace {

/// A camera sees a face mirrored: cubes are looked at from inside in a left-handed order. So what lies to the
/// right on a face lies to the left of its camera.
Camera face_camera(const FaceAxes& axes, glm::dvec3 point, float near_plane) {
    Camera camera;
    camera.world_from_camera = glm::dmat4(glm::dvec4(-axes.right, 0.0), glm::dvec4(-axes.down, 0.0),
                                          glm::dvec4(-axes.axis, 0.0), glm::dvec4(point, 1.0));
    camera.vertical_fov = std::numbers::pi_v<float> / 2.0f;
    camera.near_plane = near_plane;
    return camera;
}

} // namespace

std::shared_ptr<Environment> capture(Renderer& renderer, const Scene& scene, glm::dvec3 point,
                                     uint32_t face_size, std::optional<uint32_t> without_object) {
    if (!std::has_single_bit(face_size) || face_size > 2048)
        throw std::invalid_argument(
            message("face_size: expected a power of two in 1..2048, got ", face_size));
    if (!std::isfinite(point.x + point.y + point.z))
        throw std::invalid_argument("point: expected finite coordinates");
    Scene surroundings = scene;
    if (without_object) {
        if (*without_object >= scene.objects.size())
            throw std::invalid_argument(
                message("object: expected an index below ", scene.objects.size(), ", got ", *without_object));
        surroundings.objects.erase(surroundings.objects.begin() + *without_object);
    }
    surroundings.show_background = true;
    for (Object& object : surroundings.objects)
        object.reflects = nullptr; // no lobe is seen, so no map is needed

    RenderSettings settings;
    settings.width = settings.height = face_size;
    settings.plan.has_lobes = false;
    std::vector<float> radiance(size_t(6) * face_size * face_size * 3);
    const float near_plane = float(std::max(1e-4 * surroundings.bounds().radius(), 1e-20));
    for (uint32_t face = 0; face < 6; ++face) {
        const Frame frame =
            renderer.render(surroundings, face_camera(face_axes(face), point, near_plane), settings);
        const std::span<const glm::vec4> texels = frame.radiance();
        for (uint32_t row = 0; row < face_size; ++row)
            for (uint32_t column = 0; column < face_size; ++column) {
                const glm::vec4& texel = texels[size_t(row) * face_size + (face_size - 1 - column)];
                float* target = &radiance[((size_t(face) * face_size + row) * face_size + column) * 3];
                for (int c = 0; c < 3; ++c)
                    target[c] = texel[c];
            }
    }
    auto environment = std::make_shared<Environment>(Environment::from_faces(face_size, std::move(radiance)));
    environment->name = "captured";
    return environment;
}

} // namespace burnish::render
