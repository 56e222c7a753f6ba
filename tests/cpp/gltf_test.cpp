// Small glTF files, written by each test into a folder of its own, read back as scenes.
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "burnish/error.h"
#include "burnish/scene/scene.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

std::string base64(const std::vector<uint8_t>& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t j = 0; j < 3; ++j)
            group = group << 8 | (i + j < bytes.size() ? bytes[i + j] : 0u);
        for (size_t j = 0; j < 4; ++j)
            text += i + j > bytes.size() ? '=' : digits[group >> (18 - 6 * j) & 63];
    }
    return text;
}

/// A file in the making: accessors over one buffer, and the other arrays as JSON text.
struct Builder {
    std::vector<uint8_t> bytes;
    std::string views, accessors;
    int view_count = 0, accessor_count = 0;

    template <typename Number>
    int view(const std::vector<Number>& numbers, int stride = 0) {
        while (bytes.size() % 4)
            bytes.push_back(0);
        size_t offset = bytes.size(), size = numbers.size() * sizeof(Number);
        bytes.resize(offset + size);
        std::memcpy(bytes.data() + offset, numbers.data(), size);
        views += message(view_count ? "," : "", R"({"buffer":0,"byteOffset":)", offset, R"(,"byteLength":)",
                         size, stride ? message(R"(,"byteStride":)", stride) : "", "}");
        return view_count++;
    }
    int accessor(int view_index, int type, size_t count, const char* shape, const std::string& more = "") {
        accessors +=
            message(accessor_count ? "," : "", "{",
                    view_index < 0 ? "" : message(R"("bufferView":)", view_index, ","), R"("componentType":)",
                    type, R"(,"count":)", count, R"(,"type":")", shape, "\"", more, "}");
        return accessor_count++;
    }
    int floats(const std::vector<float>& numbers, const char* shape, size_t components) {
        return accessor(view(numbers), 5126, numbers.size() / components, shape);
    }
    std::string json(const std::string& rest) const {
        return message(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)", bytes.size(),
                       R"(,"uri":"data:application/octet-stream;base64,)", base64(bytes),
                       R"("}],"bufferViews":[)", views, R"(],"accessors":[)", accessors, "],", rest, "}");
    }
};

const std::vector<float> SQUARE = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::string ONE_NODE = R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0)";

std::string one_mesh(const std::string& primitive, const std::string& rest = ONE_NODE) {
    return R"("meshes":[{"primitives":[)" + primitive + "]}]," + rest;
}

class Gltf : public testing::Test {
protected:
    Gltf() {
        folder_ = fs::temp_directory_path() / (std::string("burnish_gltf_") +
                                               testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }
    ~Gltf() override { fs::remove_all(folder_); }

    std::string write(const std::string& text, const char* name = "scene.gltf") const {
        fs::path path = folder_ / name;
        std::ofstream(path, std::ios::binary) << text;
        return path.string();
    }
    Scene load(const std::string& text) const { return load_gltf(write(text)); }
    /// The reason, without the path in front.
    std::string error(const std::string& text) const {
        std::string path = write(text);
        try {
            load_gltf(path);
        } catch (const FileError& error) {
            return std::string(error.what()).substr(path.size() + 2);
        }
        return "nothing thrown";
    }

    fs::path folder_;
};

TEST_F(Gltf, ReadsEveryIndexTypeAndNone) {
    const std::vector<uint32_t> expected = {0, 1, 2, 0, 2, 3};
    for (int type : {5121, 5123, 5125}) {
        Builder file;
        int positions = file.floats(SQUARE, "VEC3", 3);
        int view = type == 5121   ? file.view<uint8_t>({0, 1, 2, 0, 2, 3})
                   : type == 5123 ? file.view<uint16_t>({0, 1, 2, 0, 2, 3})
                                  : file.view<uint32_t>({0, 1, 2, 0, 2, 3});
        int normals = file.floats({0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
        int indices = file.accessor(view, type, 6, "SCALAR");
        Scene scene =
            load(file.json(one_mesh(message(R"({"attributes":{"POSITION":)", positions, R"(,"NORMAL":)",
                                            normals, R"(},"indices":)", indices, "}"))));
        EXPECT_EQ(scene.meshes.at(0).indices, expected);
        EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1)); // made unit
    }
    Builder file;
    int positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    Scene scene = load(file.json(one_mesh(message(R"({"attributes":{"POSITION":)", positions, "}}"))));
    EXPECT_EQ(scene.meshes.at(0).indices.size(), 3u);
    EXPECT_EQ(scene.meshes[0].normals[2], glm::vec3(0, 0, 1)); // flat, since the file has none
}

TEST_F(Gltf, TurnsStripsAndFansIntoTriangles) {
    Builder file;
    int positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", 3);
    int fan = file.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    Scene scene = load(file.json(one_mesh(message(R"({"mode":5,"attributes":{"POSITION":)", positions,
                                                  R"(}},{"mode":6,"attributes":{"POSITION":)", fan,
                                                  R"(}},{"mode":1,"attributes":{"POSITION":)", fan, "}}"))));
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.meshes[0].indices.size(), 9u);
    EXPECT_EQ(scene.meshes[1].indices.size(), 6u);
    for (const Mesh& mesh : scene.meshes)
        for (const glm::vec3& normal : mesh.normals)
            EXPECT_EQ(normal, glm::vec3(0, 0, 1)); // every triangle faces the same way
    EXPECT_EQ(scene.warnings,
              std::vector<std::string>{"meshes[0].primitives[2]: points and lines are not drawn"});
    EXPECT_EQ(scene.objects[0].name, "node.0.0");
}

TEST_F(Gltf, ReadsSparseStridedAndNormalizedData) {
    Builder file;
    int at = file.view<uint16_t>({1, 2});
    int values = file.view<float>({5, 0, 0, 0, 5, 0});
    int positions = file.accessor(-1, 5126, 3, "VEC3",
                                  message(R"(,"sparse":{"count":2,"indices":{"bufferView":)", at,
                                          R"(,"componentType":5123},"values":{"bufferView":)", values, "}}"));
    int uv = file.accessor(file.view<uint8_t>({0, 255, 9, 9, 51, 102, 9, 9, 255, 0, 9, 9}, 4), 5121, 3,
                           "VEC2", R"(,"normalized":true)");
    int color = file.accessor(file.view<uint16_t>({65535, 0, 0, 0, 65535, 0, 0, 0, 65535}), 5123, 3, "VEC3",
                              R"(,"normalized":true)");
    Scene scene = load(file.json(one_mesh(message(R"({"attributes":{"POSITION":)", positions,
                                                  R"(,"TEXCOORD_0":)", uv, R"(,"COLOR_0":)", color, "}}"))));
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}, {0, 5, 0}}));
    EXPECT_EQ(mesh.uv0, (std::vector<glm::vec2>{{0, 1}, {0.2f, 0.4f}, {1, 0}}));
    EXPECT_EQ(mesh.colors[1], glm::vec4(0, 1, 0, 1));
    EXPECT_TRUE(scene.materials.at(scene.objects[0].material).source->has_vertex_color);
}

TEST_F(Gltf, TakesQuantizedPositionsOnlyWhereListed) {
    Builder file;
    int positions = file.accessor(file.view<int16_t>({-32768, 0, 0, 0, 32767, 0, 0, 0, 0, 16384, 0, 0}, 8),
                                  5122, 3, "VEC3", R"(,"normalized":true)");
    std::string body = one_mesh(message(R"({"attributes":{"POSITION":)", positions, "}}"));
    EXPECT_EQ(error(file.json(body)),
              "meshes[0].primitives[0].POSITION: expected 32-bit floats, got component type 5122");
    Scene scene = load(file.json(
        body +
        R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])"));
    EXPECT_EQ(scene.meshes.at(0).positions[0].x, -1.0f);
    EXPECT_EQ(scene.meshes[0].positions[1].x, 1.0f);
}

TEST_F(Gltf, FlattensNodesAndRemovesScaleFromCameras) {
    Builder file;
    int positions = file.floats(SQUARE, "VEC3", 3);
    Scene scene = load(file.json(one_mesh(
        message(R"({"attributes":{"POSITION":)", positions, R"(},"mode":6})"),
        R"("cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1}},{"type":"orthographic","orthographic":{"xmag":1,"ymag":2,"znear":0.1,"zfar":10}}],
           "nodes":[{"name":"a","mesh":0,"translation":[1,2,3],"children":[1,2]},
                    {"name":"a","mesh":0,"scale":[-2,2,2],"rotation":[0,0.70710678,0,0.70710678]},
                    {"camera":0,"scale":[3,3,3],"translation":[0,0,5]},{"camera":1}],"scenes":[{"nodes":[0,3]}])")));
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "a");
    EXPECT_EQ(scene.objects[1].name, "a.1");
    EXPECT_EQ(scene.objects[0].mesh, scene.objects[1].mesh);              // shared
    EXPECT_LT(glm::determinant(scene.objects[1].world_from_object), 0.0); // mirrored, as the file says
    glm::dvec3 x(scene.objects[1].world_from_object * glm::dvec4(1, 0, 0, 1));
    EXPECT_NEAR(glm::length(x - glm::dvec3(1, 2, 5)), 0.0,
                1e-7); // (-2, 0, 0) turned 90 degrees about y, then moved
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].world_from_camera[3], glm::dvec4(1, 2, 8, 1));
    EXPECT_NEAR(glm::length(scene.cameras[0].world_from_camera[0]), 1.0, 1e-12);
    EXPECT_EQ(scene.cameras[1].half_height, 2.0f);
}

TEST_F(Gltf, RefusesNodesThatAreNoTree) {
    const std::string head = R"({"asset":{"version":"2.0"},"nodes":)";
    EXPECT_EQ(error(head + R"([{"children":[1]},{"children":[0]}]})"),
              "nodes[0]: expected a tree, got a node among its own descendants");
    EXPECT_EQ(error(head + R"([{"children":[2]},{"children":[2]},{}]})"),
              "nodes[2]: expected one parent, got nodes[0] and nodes[1]");
    EXPECT_EQ(error(head + R"([{"children":[7]}]})"),
              "nodes[0].children[0]: expected an index below 1 nodes, got 7");
    // A chain longer than any stack frame budget is still a tree.
    std::string chain = "[";
    for (int i = 1; i < 50000; ++i)
        chain += message(R"({"children":[)", i, "]},");
    EXPECT_TRUE(load(head + chain + R"({}]})").objects.empty());
}

TEST_F(Gltf, ReadsMaterialsAndTheirExtensions) {
    Builder file;
    int positions = file.floats(SQUARE, "VEC3", 3);
    Scene scene = load(file.json(
        R"("materials":[{"name":"m","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,"emissiveFactor":[1,0.5,0],
             "pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.75],"metallicFactor":0,"roughnessFactor":0},
             "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4},"KHR_materials_ior":{"ior":2},
               "KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,2,3]},
               "KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":0.5},
               "KHR_materials_anisotropy":{"anisotropyStrength":0.5,"anisotropyRotation":1}}},
            {"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1]}}],)" +
        one_mesh(message(R"({"material":0,"attributes":{"POSITION":)", positions, R"(},"mode":6})")) +
        R"(,"extensionsUsed":["KHR_materials_iridescence","KHR_materials_ior","VENDOR_x"])"));
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
    EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(material.alpha_cutoff, 0.25f);
    EXPECT_TRUE(material.double_sided);
    ASSERT_EQ(material.lobes.size(), 2u);
    EXPECT_EQ(std::get<GgxLobe>(material.lobes[0]).rotation, 1.0f);
    EXPECT_NEAR(std::get<GgxLobe>(material.lobes[0]).roughness.x, 0.25f, 1e-3f);
    EXPECT_EQ(std::get<GgxLobe>(material.lobes[0]).roughness.y, MIN_ROUGHNESS);
    EXPECT_NEAR(std::get<GgxLobe>(material.lobes[0]).r0.x * std::get<GgxLobe>(material.lobes[0]).weight.x,
                0.5f / 9.0f, 1e-6f);
    EXPECT_EQ(material.source->base_color.w, 0.75f);
    EXPECT_EQ(scene.ignored_extensions, (std::vector<std::string>{"KHR_materials_iridescence", "VENDOR_x"}));
    EXPECT_FALSE(scene.meshes.at(0).tangents.empty()); // anisotropic: derived around y, since there is no uv
    ASSERT_EQ(scene.warnings.size(), 3u);
    EXPECT_EQ(scene.warnings[0],
              "KHR_materials_iridescence: its materials are drawn without the colours of a thin film");
    EXPECT_EQ(scene.warnings[1], "VENDOR_x: not known here, drawn as if it were not there");
    EXPECT_NE(scene.warnings[2].find("longitude"), std::string::npos);
    EXPECT_TRUE(scene.materials[1].lobes.empty());
    EXPECT_EQ(scene.materials[1].emissive, glm::vec3(0.5f, 0.25f, 1));
    EXPECT_EQ(scene.materials[1].diffuse, glm::vec3(0));
}

TEST_F(Gltf, SharesAMaterialBetweenColoredAndPlainMeshes) {
    Builder file;
    int positions = file.floats(SQUARE, "VEC3", 3);
    int colors = file.floats(std::vector<float>(16, 0.5f), "VEC4", 4);
    Scene scene = load(file.json(
        R"("materials":[{"name":"m"}],)" +
        one_mesh(message(R"({"material":0,"mode":6,"attributes":{"POSITION":)", positions, R"(,"COLOR_0":)",
                         colors, R"(}},{"material":0,"mode":6,"attributes":{"POSITION":)", positions,
                         "}}"))));
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_TRUE(scene.materials[scene.objects[0].material].source->has_vertex_color);
    EXPECT_FALSE(scene.materials[scene.objects[1].material].source->has_vertex_color);
}

TEST_F(Gltf, NamesWhatItCannotRead) {
    const std::string head = R"({"asset":{"version":"2.0"},)";
    EXPECT_EQ(
        error(head + R"("extensionsRequired":["KHR_draco_mesh_compression","KHR_materials_ior","X"]})"),
        "extensionsRequired: expected only extensions Burnish knows, got KHR_draco_mesh_compression, X");
    EXPECT_EQ(error(R"({"asset":{"version":"1.0"}})"), "asset.version: expected 2.x, got \"1.0\"");
    EXPECT_EQ(error(head + R"("materials":[{"pbrMetallicRoughness":{"metallicFactor":"much"}}]})"),
              "materials[0].pbrMetallicRoughness.metallicFactor: expected a finite number, got \"much\"");
    EXPECT_EQ(error(head + R"("buffers":[{"byteLength":4,"uri":"gone.bin"}]})"),
              "buffers[0] \"gone.bin\": no such file");
    EXPECT_EQ(
        error(head + R"("buffers":[{"byteLength":4,"uri":"%2e%2e/secret.bin"}]})"),
        "buffers[0] \"%2e%2e/secret.bin\": expected a file in or below the scene's folder, got one outside");
    EXPECT_EQ(error(head + R"("buffers":[{"byteLength":4,"uri":"/etc/passwd"}]})"),
              "buffers[0] \"/etc/passwd\": expected a file in or below the scene's folder, got one outside");
    EXPECT_EQ(error(head + R"("buffers":[{"byteLength":9,"uri":"data:;base64,AAAA"}]})"),
              "buffers[0] data URI.byteLength: expected at most the 3 bytes there are, got 9");
    EXPECT_EQ(error(head + R"("extras":)" + std::string(5000, '[') + std::string(5000, ']') + "}"),
              "JSON: expected at most 64 levels, got more");
    EXPECT_EQ(error("{").rfind("JSON: parse error", 0), 0u);
    EXPECT_THROW(load_gltf((folder_ / "absent.glb").string()), FileError);
}

TEST_F(Gltf, ChecksRangesBeforeItTouchesMemory) {
    Builder file;
    int positions = file.floats(SQUARE, "VEC3", 3);
    int far = file.accessor(0, 5126, 4, "VEC3", R"(,"byteOffset":2147483640)");
    int many = file.accessor(0, 5126, 2147483647, "VEC3");
    int zeros = file.accessor(-1, 5126, 2147483647, "VEC3");
    int indices = file.accessor(file.view<uint8_t>({0, 1, 9}), 5121, 3, "SCALAR");
    auto with = [&](int accessor) {
        return error(file.json(one_mesh(message(R"({"attributes":{"POSITION":)", accessor, "}}"))));
    };
    EXPECT_EQ(
        with(far),
        "meshes[0].primitives[0].POSITION: expected data within bufferViews[0] of 48 bytes, got 2147483688");
    EXPECT_NE(with(many).find("expected all meshes to take at most"), std::string::npos);
    EXPECT_NE(with(zeros).find("expected all meshes to take at most"), std::string::npos);
    EXPECT_EQ(with(indices),
              "meshes[0].primitives[0].POSITION: expected 32-bit floats, got component type 5121");
    EXPECT_EQ(error(file.json(one_mesh(
                  message(R"({"attributes":{"POSITION":)", positions, R"(},"indices":)", indices, "}")))),
              "meshes[0].primitives[0].indices: expected each below the vertex count 4, got 9");
}

TEST_F(Gltf, ReadsBinaryContainers) {
    Builder file;
    int positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    std::string json = message(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36}],"bufferViews":[)",
                               file.views, R"(],"accessors":[)", file.accessors, "],",
                               one_mesh(message(R"({"attributes":{"POSITION":)", positions, "}}")), "}");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    auto word = [](size_t value) {
        uint32_t bits = static_cast<uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&bits), 4);
    };
    std::string binary(file.bytes.begin(), file.bytes.end());
    std::string body = word(json.size()) + "JSON" + json + word(binary.size()) + std::string("BIN\0", 4) +
                       binary + word(4) + "WHAT" + "abcd"; // an unknown chunk is skipped
    std::string glb = "glTF" + word(2) + word(12 + body.size()) + body;
    EXPECT_EQ(load(glb).meshes.at(0).positions.size(), 3u);
    EXPECT_EQ(
        error("glTF" + word(2) + word(500 + body.size()) + body),
        message("GLB length: expected at most the file's ", glb.size(), " bytes, got ", 500 + body.size()));
    glb[12] = '\xff', glb[13] = '\xff', glb[14] = '\xff', glb[15] = '\xff';
    EXPECT_EQ(error(glb), message("GLB chunk: expected at most the remaining ", glb.size() - 20,
                                  " bytes, got 4294967295"));
}

} // namespace
} // namespace burnish
