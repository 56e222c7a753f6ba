// Materials, cameras and scenes made by code.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "burnish/scene/metallic_roughness.h"
#include "burnish/scene/scene.h"
#include "error_message.h"

namespace burnish {
namespace {

TEST(Material, RangesAreNamed) {
    EXPECT_EQ(message_of([] { validate(KurtLobe{.roughness = glm::vec2(0.0f)}); }),
              "roughness: expected 1e-06..1, got 0");
    Material material;
    material.lobes.resize(2);
    std::get<KurtLobe>(material.lobes[1]).alpha = 1.5f;
    EXPECT_EQ(message_of([&] { validate(material); }), "lobes[1].alpha: expected 0..1, got 1.5");
    material.lobes.assign(5, {});
    EXPECT_EQ(message_of([&] { validate(material); }), "lobes: expected at most 4, got 5");
    material.lobes.clear();
    material.emissive.y = -1.0f;
    EXPECT_EQ(message_of([&] { validate(material); }), "emissive: expected finite numbers >= 0, got -1");
}

TEST(Material, MetalKeepsItsColorAndPlasticItsDiffuse) {
    MappedSurface metal =
        map_metallic_roughness({.base = {1.0f, 0.7f, 0.3f}, .metallic = 1.0f, .roughness = 0.5f});
    EXPECT_EQ(metal.diffuse, glm::vec3(0.0f));
    EXPECT_EQ(metal.r0, glm::vec3(1.0f, 0.7f, 0.3f));
    EXPECT_EQ(metal.weight, 1.0f);
    EXPECT_EQ(metal.roughness, glm::vec2(0.25f));
    MappedSurface plastic =
        map_metallic_roughness({.base = glm::vec3(0.5f), .metallic = 0.0f, .roughness = 0.0f});
    EXPECT_NEAR(plastic.r0.x, 0.04f, 1e-6f);
    EXPECT_EQ(plastic.diffuse.x, 0.5f);
    EXPECT_NEAR(plastic.dielectric, 0.04f, 1e-6f);
    EXPECT_EQ(plastic.roughness.x, MIN_ROUGHNESS);
}

TEST(Material, SpecularScalesBothEndsOfFresnel) {
    MappedSurface half =
        map_metallic_roughness({.metallic = 0.0f, .specular = 0.5f, .specular_color = {1, 2, 100}});
    EXPECT_NEAR(half.weight, 0.5f, 1e-6f);
    EXPECT_NEAR(half.weight * half.r0.x, 0.02f, 1e-6f); // specular * 0.04
    EXPECT_NEAR(half.weight * half.r0.y, 0.04f, 1e-6f);
    EXPECT_NEAR(half.r0.z, 1.0f, 1e-6f); // clamped
    EXPECT_NEAR(half.dielectric, 0.5f, 1e-6f);
    EXPECT_EQ(map_metallic_roughness({.metallic = 0.0f, .specular = 0.0f}).weight, 0.0f);
    EXPECT_NEAR(map_metallic_roughness({.metallic = 0.0f, .ior = 0.0f}).r0.x, 1.0f,
                1e-6f); // KHR_materials_ior
    MappedSurface brushed = map_metallic_roughness({.roughness = 0.5f, .anisotropy = 0.5f});
    EXPECT_NEAR(brushed.roughness.x, 0.25f + 0.75f * 0.25f, 1e-6f);
    EXPECT_EQ(brushed.roughness.y, 0.25f);
}

TEST(Material, ClearcoatIsALobeOnTop) {
    Material material;
    material.source = MetallicRoughness{};
    material.source->clearcoat = 0.5f;
    material.source->clearcoat_roughness = 0.1f;
    map_metallic_roughness(material);
    ASSERT_EQ(material.lobes.size(), 2u);
    EXPECT_EQ(std::get<GgxLobe>(material.lobes[1]).weight, glm::vec3(0.5f));
    EXPECT_EQ(std::get<GgxLobe>(material.lobes[1]).r0, glm::vec3(0.04f));
    EXPECT_NEAR(std::get<GgxLobe>(material.lobes[1]).roughness.x, 0.01f, 1e-6f);
    ASSERT_EQ(material.covers.size(), 2u);
    EXPECT_FALSE(material.covers[0].is_over_emission);
    EXPECT_TRUE(material.covers[1].is_over_emission && !material.covers[1].albedo);
    validate(material);
    material.covers.pop_back();
    EXPECT_EQ(message_of([&] { validate(material); }), "covers: expected one a lobe, 2, got 1");
}

TEST(Material, KurtsMappingAddsUp) {
    Material material;
    material.source = MetallicRoughness{};
    material.source->model = MaterialModel::kurt;
    material.source->metallic = 0.0f;
    material.source->base_color = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    map_metallic_roughness(material);
    EXPECT_EQ(std::get<KurtLobe>(material.lobes.at(0)).alpha, 0.5f);
    EXPECT_NEAR(material.diffuse.x, 0.48f, 1e-6f);
    EXPECT_TRUE(material.covers.empty());
}

TEST(Camera, LooksAtItsTarget) {
    Camera camera = look_at({1, 2, 3}, {4, 2, 3}, {0, 5, 0});
    EXPECT_EQ(glm::vec3(camera.world_from_camera * glm::dvec4(0, 0, -3, 1)), glm::vec3(4, 2, 3));
    EXPECT_EQ(glm::vec3(camera.world_from_camera[1]), glm::vec3(0, 1, 0));
    validate(camera);
    EXPECT_EQ(message_of([] {
                  look_at({0, 0, 0}, {0, 0, 0}, {0, 1, 0});
              }),
              "target: expected a point other than eye, got the same point");
    EXPECT_EQ(message_of([] {
                  look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0});
              }),
              "up: expected a direction across the view, got one along it or zero");
    camera.vertical_fov = 4.0f;
    EXPECT_EQ(message_of([&] { validate(camera); }),
              "vertical_fov: expected radians between 0 and pi, got 4");
}

TEST(Scene, DefaultCameraSeesEverything) {
    Material material;
    std::vector<Scene> scenes = {Scene::sphere(material), Scene::plane(material),
                                 Scene::shader_ball(material, material),
                                 Scene::spheres(std::vector<Material>(11, material), 4)};
    scenes.push_back(scenes[0]);
    scenes.back().objects[0].world_from_object = glm::dmat4(1e-4); // eight hundredths of a millimetre
    scenes.back().objects[0].world_from_object[3] = {0.001, 0, 0, 1};
    for (const Scene& scene : scenes) {
        validate(scene);
        Camera camera = scene.default_camera();
        validate(camera);
        glm::dmat4 camera_from_world = glm::inverse(camera.world_from_camera);
        float slope = std::tan(0.5f * camera.vertical_fov), widest = 0.0f;
        for (const Object& object : scene.objects)
            for (const glm::vec3& position : scene.meshes[object.mesh].positions) {
                glm::vec3 p(camera_from_world * object.world_from_object *
                            glm::dvec4(glm::dvec3(position), 1.0));
                ASSERT_LT(p.z, -camera.near_plane);
                widest = std::max({widest, std::abs(p.x / p.z) / slope, std::abs(p.y / p.z) / slope});
            }
        EXPECT_LT(widest, 0.95f) << scene.name;
        EXPECT_GT(widest, 0.5f) << scene.name;
    }
}

TEST(Scene, BoundsFollowTransformsAndFindObjectListsNames) {
    Scene scene = Scene::spheres(std::vector<Material>(3), 2);
    Bounds bounds = scene.bounds();
    EXPECT_NEAR(bounds.high.x, 2.1f, 1e-5f);
    EXPECT_NEAR(bounds.low.y, -2.1f, 1e-5f);
    EXPECT_NEAR(scene.object_bounds(0).center().y, 1.1f, 1e-5f);
    EXPECT_EQ(Scene{}.bounds().low, glm::dvec3(-1.0));
    EXPECT_EQ(scene.find_object("sphere.2"), 2u);
    EXPECT_EQ(message_of([&] { scene.find_object("cube"); }),
              "object: expected one of \"sphere.0\", \"sphere.1\", \"sphere.2\", got \"cube\"");
    scene.objects[1].material = 8;
    EXPECT_EQ(message_of([&] { validate(scene); }), "objects[1].material: expected an index below 3, got 8");
}

} // namespace
} // namespace burnish
