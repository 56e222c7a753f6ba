// Meshes, materials, cameras and scenes made by code.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "burnish/scene/metallic_roughness.h"
#include "burnish/scene/scene.h"

namespace burnish {
namespace {

template <typename Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing thrown";
}

glm::vec3 face_cross(const Mesh& mesh, size_t i) {
    glm::vec3 a = mesh.positions[mesh.indices[i]];
    return glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
}

/// Every triangle has area, faces its vertices' normals, and every frame is orthonormal.
void expect_well_formed(const Mesh& mesh) {
    validate(mesh);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        glm::vec3 normal = face_cross(mesh, i);
        ASSERT_GT(glm::length(normal), 0.0f) << mesh.name << " triangle " << i / 3;
        glm::vec3 mean = mesh.normals[mesh.indices[i]] + mesh.normals[mesh.indices[i + 1]] +
                         mesh.normals[mesh.indices[i + 2]];
        ASSERT_GT(glm::dot(glm::normalize(normal), glm::normalize(mean)), 0.8f)
            << mesh.name << " triangle " << i / 3;
    }
    ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-5f) << i;
        ASSERT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-5f) << i;
        ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5f) << i;
    }
}

/// A unit square facing +z, uv as a picture lies: u to the right, v downward.
Mesh make_quad() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    mesh.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

TEST(Mesh, BuiltInMeshesAreWellFormed) {
    for (uint32_t segments : {3u, 16u, 129u}) {
        SCOPED_TRACE(segments);
        if (segments > 3) { // with three segments the chords are far from the surface
            expect_well_formed(make_sphere(2.0f, segments));
            expect_well_formed(make_torus(1.0f, 0.3f, segments));
            expect_well_formed(make_shader_ball(segments));
        }
        expect_well_formed(make_plane(2.0f, segments));
        validate(make_sphere(1.0f, segments));
    }
}

TEST(Mesh, SphereIsExact) {
    Mesh mesh = make_sphere(3.0f, 64);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.positions[i] - 3.0f * mesh.normals[i]), 0.0f, 1e-6f);
        // Longitude grows from +z toward +x.
        glm::vec3 east = glm::normalize(glm::vec3(mesh.tangents[i]));
        EXPECT_NEAR(east.y, 0.0f, 1e-6f);
    }
    EXPECT_EQ(mesh.indices.size() / 3, 64u * (2 * 32 - 2));
}

TEST(Mesh, SegmentsOutOfRangeAreRefused) {
    EXPECT_EQ(message_of([] { make_sphere(1.0f, 2); }), "segments: expected 3..4096, got 2");
    EXPECT_EQ(message_of([] { make_sphere(-1.0f, 8); }), "radius: expected a finite number > 0, got -1");
    EXPECT_EQ(message_of([] { make_torus(1.0f, 2.0f, 8); }),
              "tube_radius: expected a number between 0 and radius = 1, got 2");
}

TEST(Mesh, ValidateNamesTheArray) {
    Mesh mesh = make_quad();
    mesh.indices[4] = 9;
    EXPECT_EQ(message_of([&] { validate(mesh); }), "indices: expected each below the vertex count 4, got 9");
    mesh = make_quad();
    mesh.positions[1].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(message_of([&] { validate(mesh); }),
              "positions: expected finite numbers, got a non-finite one at 1");
    mesh = make_quad();
    mesh.uv0.pop_back();
    EXPECT_EQ(message_of([&] { validate(mesh); }), "uv0: expected as many as positions (4), got 3");
}

TEST(Mesh, NormalsAreWeightedByArea) {
    Mesh mesh;
    // Two faces meet at vertex 0: one of area 2 facing +z, one of area 0.5 facing +x.
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 1}, {7, 7, 7}};
    mesh.indices = {0, 1, 2, 0, 3, 4};
    compute_normals(mesh);
    glm::vec3 expected = glm::normalize(glm::vec3(0.5f, 0, 2));
    EXPECT_NEAR(glm::length(mesh.normals[0] - expected), 0.0f, 1e-6f);
    EXPECT_EQ(mesh.normals[5], glm::vec3(0, 0, 1));
}

TEST(Mesh, FlatNormalsSplitVerticesAndDropEmptyTriangles) {
    Mesh mesh = make_quad();
    mesh.positions[3] = {0, 1, 5};
    mesh.indices.insert(mesh.indices.end(), {0, 1, 1});
    compute_flat_normals(mesh);
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_LT(mesh.normals[3].z, 0.5f);
}

TEST(Tangents, FollowUAndGreenPointsToThePicturesTop) {
    Mesh mesh = make_quad();
    compute_tangents(mesh, 0);
    EXPECT_EQ(mesh.positions.size(), 4u);
    for (const glm::vec4& tangent : mesh.tangents)
        EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
    for (glm::vec2& uv : mesh.uv0)
        uv.x = 1.0f - uv.x;
    compute_tangents(mesh, 0);
    for (const glm::vec4& tangent : mesh.tangents)
        EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
}

TEST(Tangents, MirroredNeighboursSplitTheirSharedVertices) {
    Mesh mesh; // two squares side by side, the texture mirrored at x = 1
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
    mesh.normals.assign(6, glm::vec3(0, 0, 1));
    mesh.uv0 = {{0, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    compute_tangents(mesh, 0);
    EXPECT_EQ(mesh.positions.size(), 8u);
    for (size_t corner = 0; corner < 6; ++corner)
        EXPECT_EQ(mesh.tangents[mesh.indices[corner]], glm::vec4(1, 0, 0, 1)) << corner;
    for (size_t corner = 6; corner < 12; ++corner)
        EXPECT_EQ(mesh.tangents[mesh.indices[corner]], glm::vec4(-1, 0, 0, -1)) << corner;
}

TEST(Tangents, AreWeightedByAngleNotByArea) {
    // Two faces at vertex 0 in one plane: one spans 90 degrees, the other, ten times as large, 45 degrees.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-10, 10, 0}};
    mesh.normals.assign(4, glm::vec3(0, 0, 1));
    mesh.uv0 = {{0, 0}, {1, 0}, {0, -1}, {-10, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    compute_tangents(mesh, 0);
    // dP/du is (1, 0) on the first; on the second (0, 1) has uv (0, -1) and (-10, 10) has uv (-10, 0): (1,
    // -1).
    glm::vec2 second = glm::normalize(glm::vec2(1, -1));
    glm::vec2 expected =
        glm::normalize(glm::vec2(1, 0) * glm::half_pi<float>() + second * glm::quarter_pi<float>());
    EXPECT_NEAR(mesh.tangents[0].x, expected.x, 1e-5f);
    EXPECT_NEAR(mesh.tangents[0].y, expected.y, 1e-5f);
}

TEST(Tangents, FacesWithoutTextureAreaTakeTheirNeighboursTangent) {
    Mesh mesh = make_quad();
    mesh.uv0[3] = mesh.uv0[0]; // the second triangle has no area in uv
    compute_tangents(mesh, 0);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_TRUE(std::isfinite(tangent.x));
        EXPECT_EQ(tangent.w, 1.0f);
    }
    EXPECT_NEAR(mesh.tangents[0].x, mesh.tangents[2].x, 1e-6f);
    std::fill(mesh.uv0.begin(), mesh.uv0.end(), glm::vec2(0.5f)); // none has: any frame, but a frame
    compute_tangents(mesh, 0);
    for (size_t i = 0; i < mesh.tangents.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-6f);
    }
}

TEST(Tangents, MatchThoseOfTheBuiltInSphere) {
    Mesh mesh = make_sphere(1.0f, 96);
    Mesh derived = mesh;
    compute_tangents(derived, 0);
    size_t compared = 0;
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        glm::vec4 given = mesh.tangents[mesh.indices[corner]],
                  found = derived.tangents[derived.indices[corner]];
        if (std::abs(mesh.positions[mesh.indices[corner]].y) > 0.95f) continue;
        ++compared;
        ASSERT_GT(glm::dot(glm::vec3(given), glm::vec3(found)), 0.995f) << corner;
        ASSERT_EQ(given.w, found.w);
    }
    EXPECT_GT(compared, 1000u);
}

TEST(Tangents, AroundYFollowLongitude) {
    Mesh mesh = make_sphere(1.0f, 48);
    Mesh derived = mesh;
    compute_tangents_around_y(derived);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_NEAR(glm::length(glm::vec3(derived.tangents[i])), 1.0f, 1e-5f) << i;
        if (std::abs(mesh.positions[i].y) < 0.99f) {
            ASSERT_NEAR(glm::dot(glm::vec3(derived.tangents[i]), glm::vec3(mesh.tangents[i])), 1.0f, 1e-5f)
                << i;
        }
    }
}

TEST(Tangents, NeedTextureCoordinates) {
    Mesh mesh = make_quad();
    EXPECT_EQ(message_of([&] { compute_tangents(mesh, 1); }), "uv1: expected as many as positions, got 0");
}

TEST(Material, RangesAreNamed) {
    EXPECT_EQ(message_of([] { validate(KurtLobe{.roughness = glm::vec2(0.0f)}); }),
              "roughness: expected 1e-06..1, got 0");
    Material material;
    material.lobes.resize(2);
    material.lobes[1].alpha = 1.5f;
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
    EXPECT_NEAR(plastic.diffuse.x, 0.48f, 1e-6f);
    EXPECT_EQ(plastic.roughness.x, MIN_ROUGHNESS);
}

TEST(Material, SpecularScalesBothEndsOfFresnel) {
    MappedSurface half =
        map_metallic_roughness({.metallic = 0.0f, .specular = 0.5f, .specular_color = {1, 2, 100}});
    EXPECT_NEAR(half.weight, 0.5f, 1e-6f);
    EXPECT_NEAR(half.weight * half.r0.x, 0.02f, 1e-6f); // specular * 0.04
    EXPECT_NEAR(half.weight * half.r0.y, 0.04f, 1e-6f);
    EXPECT_NEAR(half.r0.z, 1.0f, 1e-6f); // clamped
    EXPECT_NEAR(half.diffuse.x, 0.5f, 1e-6f);
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
    EXPECT_EQ(material.lobes[1].weight, glm::vec3(0.5f));
    EXPECT_EQ(material.lobes[1].r0, glm::vec3(0.04f));
    EXPECT_NEAR(material.lobes[1].roughness.x, 0.01f, 1e-6f);
    validate(material);
}

TEST(Camera, LooksAtItsTarget) {
    Camera camera = look_at({1, 2, 3}, {4, 2, 3}, {0, 5, 0});
    EXPECT_EQ(glm::vec3(camera.world_from_camera * glm::vec4(0, 0, -3, 1)), glm::vec3(4, 2, 3));
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
    scenes.back().objects[0].world_from_object = glm::mat4(1e-4f); // eight hundredths of a millimetre
    scenes.back().objects[0].world_from_object[3] = {0.001f, 0, 0, 1};
    for (const Scene& scene : scenes) {
        validate(scene);
        Camera camera = scene.default_camera();
        validate(camera);
        glm::mat4 camera_from_world = glm::inverse(camera.world_from_camera);
        float slope = std::tan(0.5f * camera.vertical_fov), widest = 0.0f;
        for (const Object& object : scene.objects)
            for (const glm::vec3& position : scene.meshes[object.mesh].positions) {
                glm::vec3 p(camera_from_world * object.world_from_object * glm::vec4(position, 1.0f));
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
    EXPECT_EQ(Scene{}.bounds().low, glm::vec3(-1.0f));
    EXPECT_EQ(scene.find_object("sphere.2"), 2u);
    EXPECT_EQ(message_of([&] { scene.find_object("cube"); }),
              "object: expected one of \"sphere.0\", \"sphere.1\", \"sphere.2\", got \"cube\"");
    scene.objects[1].material = 8;
    EXPECT_EQ(message_of([&] { validate(scene); }), "objects[1].material: expected an index below 3, got 8");
}

} // namespace
} // namespace burnish
