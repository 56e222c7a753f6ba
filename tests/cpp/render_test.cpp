// The engine without Python: frames, points and captured maps on the device of these tests.
#include "burnish/lobe/albedo_table.h"
#include "burnish/render/capture.h"
#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace burnish::render {
namespace {

/// One renderer for all tests: its pipelines are made once.
Renderer& renderer() {
    static Renderer one(vulkan::Device::create());
    return one;
}

std::shared_ptr<const Environment> uniform_environment(float radiance, uint32_t face_size = 4) {
    const size_t values = size_t(6) * face_size * face_size * 3;
    return std::make_shared<const Environment>(
        Environment::from_faces(face_size, std::vector<float>(values, radiance)));
}

KurtLobe lobe_of(float roughness) {
    KurtLobe lobe;
    lobe.roughness = glm::vec2(roughness);
    return lobe;
}

Scene furnace_sphere(float roughness) {
    Material material;
    material.lobes = {lobe_of(roughness)};
    Scene scene = Scene::sphere(material);
    scene.environment = uniform_environment(1.0f);
    return scene;
}

RenderSettings small_settings(uint32_t width = 32, uint32_t height = 32) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    return settings;
}

std::set<std::string> pass_names(const Report& report) {
    std::set<std::string> names;
    for (const vulkan::PassTime& pass : report.passes)
        names.insert(pass.name);
    return names;
}

double mean_coverage(const Frame& frame) {
    double sum = 0;
    for (const glm::vec4& texel : frame.radiance())
        sum += texel.a;
    return sum / double(frame.radiance().size());
}

TEST(Render, SphereInAFurnaceIsNoBrighterThanIt) {
    const Scene scene = furnace_sphere(0.1f);
    const Camera camera = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});
    const Frame frame = renderer().render(scene, camera, small_settings(33, 33));
    ASSERT_EQ(frame.radiance().size(), 33u * 33u);
    for (const glm::vec4& texel : frame.radiance()) {
        EXPECT_LE(texel.r, 1.001f);
        if (texel.a == 0.0f) { // braces: the macro holds an if of its own
            EXPECT_FLOAT_EQ(texel.r, 1.0f);
        }
    }
    EXPECT_NEAR(frame.radiance()[16 * 33 + 16].r, directional_albedo({0, 0, 1}, glm::dvec2(0.1), 0.0).x,
                1e-3);
    EXPECT_TRUE(frame.report.stopped.empty());
}

TEST(Render, SphereCoversItsDisc) {
    const Scene scene = furnace_sphere(0.2f);
    Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    camera.is_orthographic = true;
    camera.half_height = 2.0f;
    camera.far_plane = 10.0f;
    Frame frame = renderer().render(scene, camera, small_settings(128, 128));
    // A unit disc in a square of edge 4; the mesh of 128 segments lies a little inside.
    EXPECT_NEAR(mean_coverage(frame), std::numbers::pi / 16, 2e-3);
    const std::vector<float> depth = frame.depth();
    EXPECT_NEAR(depth[64 * 128 + 64], 4.0f, 2e-3f);
    EXPECT_TRUE(std::isinf(depth[0]));
    const std::vector<glm::vec3> normals = frame.normals();
    EXPECT_NEAR(normals[64 * 128 + 64].z, 1.0f, 1e-3f);
    EXPECT_EQ(normals[0], glm::vec3(0.0f));
}

TEST(Render, ReportNamesThePassesThatThePlanNamed) {
    const Scene scene = furnace_sphere(0.15f);
    RenderSettings settings = small_settings();
    settings.plan.spp = 2;
    SunCache suns;
    const Plan plan = make_plan(scene, settings.plan, suns);
    const Frame frame = renderer().render(scene, scene.default_camera(), settings);
    std::set<std::string> ran = pass_names(frame.report);
    for (const PassLine& line : plan.passes) {
        EXPECT_TRUE(ran.contains(line.name())) << line.name();
        EXPECT_FALSE(line.reason.empty()) << line.name();
    }
    EXPECT_TRUE(ran.contains("accumulate"));
    const Frame single = renderer().render(scene, scene.default_camera(), small_settings());
    EXPECT_FALSE(pass_names(single.report).contains("accumulate"));
    EXPECT_EQ(single.report.device_name, renderer().device()->info().name);
    EXPECT_EQ(single.report.width, 32u);
    EXPECT_GT(single.report.triangles, 1000u);
}

TEST(Render, TinyGltfSceneShowsItsTriangle) {
    // Half of the square -1..1: below the diagonal from the upper left to the lower right; it emits (1, 2,
    // 3).
    const auto folder =
        std::filesystem::temp_directory_path() / ("burnish_render_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const float corners[] = {-1, -1, 0, 1, -1, 0, -1, 1, 0};
    std::ofstream(folder / "t.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(corners), sizeof corners);
    std::ofstream(folder / "t.gltf")
        << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"emissiveFactor": [0.25, 0.5, 0.75], "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]},
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}}],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "buffers": [{"uri": "t.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [-1, -1, 0], "max": [1, 1, 0]}]})";
    const Scene scene = load_gltf((folder / "t.gltf").string());
    std::filesystem::remove_all(folder);
    Camera camera = look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
    camera.is_orthographic = true;
    camera.far_plane = 4.0f;
    const Frame frame = renderer().render(scene, camera, small_settings(64, 64));
    EXPECT_NEAR(mean_coverage(frame), 0.5, 0.01);
    const glm::vec4 inside = frame.radiance()[50 * 64 + 10], outside = frame.radiance()[10 * 64 + 50];
    EXPECT_NEAR(inside.r, 1.0f, 1e-3f);
    EXPECT_NEAR(inside.g, 2.0f, 1e-3f);
    EXPECT_NEAR(inside.b, 3.0f, 1e-3f);
    EXPECT_EQ(outside, glm::vec4(0.0f));
    EXPECT_TRUE(std::any_of(
        frame.report.warnings.begin(), frame.report.warnings.end(),
        [](const std::string& warning) { return warning.find("no environment") != std::string::npos; }));
}

TEST(Render, PointsInAFurnaceShowTheDiffuseReflectance) {
    Material material;
    material.diffuse = glm::vec3(0.1f, 0.5f, 0.9f);
    const std::vector<glm::vec3> up(70, glm::vec3(0, 0, 1)), along(70, glm::vec3(1, 0, 0));
    Report report;
    const std::vector<glm::vec3> radiance =
        renderer().shade(uniform_environment(2.0f), material, {up, along, up}, {}, &report);
    ASSERT_EQ(radiance.size(), 70u);
    for (const glm::vec3& one : radiance)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(one[k], 2.0f * material.diffuse[k], 1e-3f);
    EXPECT_FALSE(pass_names(report).contains("pyramid"));
    const std::vector<glm::vec3> fewer(1, glm::vec3(0, 0, 1));
    EXPECT_THROW(renderer().shade(uniform_environment(1.0f), material, {up, fewer, up}, {}),
                 std::invalid_argument);
}

TEST(Render, SamplersAgreeInAFurnace) {
    Material material;
    material.lobes = {lobe_of(0.2f)};
    const std::vector<glm::vec3> up(1, glm::vec3(0, 0, 1)), along(1, glm::vec3(1, 0, 0));
    const auto environment = uniform_environment(1.0f, 16);
    PlanSettings settings;
    settings.sampler = Reference{.method = ReferenceMethod::quadrature};
    const float truth = renderer().shade(environment, material, {up, along, up}, settings)[0].r;
    for (const Sampler& sampler : {Sampler(Regular{}), Sampler(Importance{.samples = 64}),
                                   Sampler(Reference{.method = ReferenceMethod::progressive})}) {
        settings.sampler = sampler;
        const float got = renderer().shade(environment, material, {up, along, up}, settings)[0].r;
        EXPECT_NEAR(got, truth, 0.02f * truth) << facts(sampler).text;
    }
}

TEST(Capture, SeesTheLampOnItsSideAndLeavesTheObjectOut) {
    Material lamp;
    lamp.emissive = glm::vec3(5.0f);
    Scene scene = Scene::sphere(lamp);
    scene.objects[0].world_from_object[3] = glm::dvec4(3, 0, 0, 1);
    scene.environment = uniform_environment(0.5f);
    const auto captured = capture(renderer(), scene, glm::dvec3(0.0), 16, std::nullopt);
    const auto middle = [](const Environment& map, uint32_t face) {
        const uint32_t n = map.face_size();
        return map.radiance()[((size_t(face) * n + n / 2) * n + n / 2) * 3];
    };
    EXPECT_NEAR(middle(*captured, 0), 5.0f, 1e-3f);
    for (uint32_t face = 1; face < 6; ++face)
        EXPECT_NEAR(middle(*captured, face), 0.5f, 1e-3f) << face;
    const auto without = capture(renderer(), scene, glm::dvec3(0.0), 16, 0u);
    EXPECT_NEAR(middle(*without, 0), 0.5f, 1e-3f);
    EXPECT_THROW(capture(renderer(), scene, glm::dvec3(0.0), 12, std::nullopt), std::invalid_argument);
    EXPECT_THROW(capture(renderer(), scene, glm::dvec3(0.0), 16, 1u), std::invalid_argument);
}

TEST(Render, FramesRefuseSizesOutOfRange) {
    const Scene scene = furnace_sphere(0.2f);
    EXPECT_THROW(renderer().render(scene, scene.default_camera(), small_settings(0, 8)),
                 std::invalid_argument);
    EXPECT_THROW(renderer().render(scene, scene.default_camera(), small_settings(8, 16385)),
                 std::invalid_argument);
}

TEST(Render, ValidationLayerIsSilent) {
    const Scene scene = furnace_sphere(0.3f);
    (void)renderer().render(scene, scene.default_camera(), small_settings());
    // Hints on speed are no faults: images stay in the general layout.
    for (const std::string& message : renderer().device()->validation_messages())
        EXPECT_NE(message.find("Performance Warning"), std::string::npos) << message;
}

} // namespace
} // namespace burnish::render
