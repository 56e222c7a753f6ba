#include "burnish/render/gpu_scene.h"

#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "burnish/plan/material_traits.h"
#include "burnish/render/mask_coverage.h"
#include "burnish/render/octahedral.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"

namespace burnish::render {
namespace {

// The twins of orthonormal_basis and diamond_encode in glsl/lib/frame.glsl.
glm::vec2 in_basis(glm::vec3 n, glm::vec3 t) {
    const float s = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (s + n.z);
    const float b = n.x * n.y * a;
    return {glm::dot(t, {1.0f + s * n.x * n.x * a, s * b, -s * n.x}),
            glm::dot(t, {b, s + n.y * n.y * a, -n.y})};
}

float diamond_encode(glm::vec2 v) {
    const float sum = std::abs(v.x) + std::abs(v.y);
    if (!(sum > 0.0f)) return 0.0f;
    const float a = v.y / sum;
    return 0.5f * (v.x >= 0.0f ? a : (v.y >= 0.0f ? 2.0f - a : -2.0f - a));
}

struct Vertex {
    glm::vec3 position;
    int16_t normal_tangent[4];
};
static_assert(sizeof(Vertex) == GpuScene::VERTEX_BYTES);

struct TextureVertex {
    glm::vec2 uv0, uv1;
    uint16_t color[4];
};
static_assert(sizeof(TextureVertex) == GpuScene::TEXTURE_VERTEX_BYTES);

/// What positions are kept relative to: the middle of the mesh's box where that lies far from its origin, so
/// that products with a matrix keep the digits that the mesh has.
glm::dvec3 center_of(const Mesh& mesh) {
    if (mesh.positions.empty()) return glm::dvec3(0.0);
    glm::dvec3 low(mesh.positions[0]), high(mesh.positions[0]);
    for (const glm::vec3& position : mesh.positions) {
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    constexpr double FAR_IN_SIZES = 4.0;
    const glm::dvec3 center = 0.5 * (low + high), away = glm::abs(center);
    const double size = glm::length(high - low);
    return std::max({away.x, away.y, away.z}) > FAR_IN_SIZES * size ? center : glm::dvec3(0.0);
}

Vertex pack_vertex(const Mesh& mesh, size_t k, const glm::dvec3& center) {
    Vertex vertex{};
    vertex.position = glm::vec3(glm::dvec3(mesh.positions[k]) - center);
    const glm::vec2 octahedral = octahedral_encode(mesh.normals[k]);
    vertex.normal_tangent[0] = int16_t(glm::packSnorm1x16(octahedral.x));
    vertex.normal_tangent[1] = int16_t(glm::packSnorm1x16(octahedral.y));
    // Against the basis that the shader will build: that of the normal as packed.
    const glm::vec3 normal = octahedral_decode({glm::unpackSnorm1x16(uint16_t(vertex.normal_tangent[0])),
                                                glm::unpackSnorm1x16(uint16_t(vertex.normal_tangent[1]))});
    const bool has_tangent = !mesh.tangents.empty();
    const glm::vec3 tangent =
        has_tangent ? glm::vec3(mesh.tangents[k]) : glm::vec3(normal.z, 0.0f, -normal.x);
    vertex.normal_tangent[2] = int16_t(glm::packSnorm1x16(diamond_encode(in_basis(normal, tangent))));
    vertex.normal_tangent[3] = has_tangent && mesh.tangents[k].w < 0.0f ? -32767 : 32767;
    return vertex;
}

TextureVertex pack_texture_vertex(const Mesh& mesh, size_t k) {
    TextureVertex vertex{};
    if (!mesh.uv0.empty()) vertex.uv0 = mesh.uv0[k];
    if (!mesh.uv1.empty()) vertex.uv1 = mesh.uv1[k];
    const glm::vec4 color = mesh.colors.empty() ? glm::vec4(1.0f) : mesh.colors[k];
    for (int c = 0; c < 4; ++c)
        vertex.color[c] = glm::packUnorm1x16(color[c]);
    return vertex;
}

/// By mesh: whether some object's material asks for tangents that it lacks, yet has texture coordinates for.
std::vector<bool> meshes_to_derive(const Scene& scene) {
    std::vector<bool> result(scene.meshes.size(), false);
    for (const Object& object : scene.objects) {
        if (object.mesh >= scene.meshes.size() || object.material >= scene.materials.size()) continue;
        const Mesh& mesh = scene.meshes[object.mesh];
        if (mesh.tangents.empty() && !(mesh.uv0.empty() && mesh.uv1.empty()))
            result[object.mesh] = result[object.mesh] || needs_tangent(scene.materials[object.material]);
    }
    return result;
}

Mesh derive_tangents(Mesh mesh) {
    compute_tangents(mesh, mesh.uv0.empty() ? 1 : 0);
    return mesh;
}

uint64_t mix(uint64_t hash, const void* data, size_t bytes) {
    constexpr uint64_t factor = 0x9fb21c651e98df25ull;
    const auto* next = static_cast<const unsigned char*>(data);
    hash = (hash ^ bytes) * 0x9e3779b97f4a7c15ull;
    // Every frame looks at all of the scene: four chains side by side, since one waits for its
    // multiplications.
    std::array<uint64_t, 4> lanes = {hash, hash + 1, hash + 2, hash + 3};
    for (; bytes >= sizeof(lanes); bytes -= sizeof(lanes), next += sizeof(lanes)) {
        std::array<uint64_t, 4> words;
        std::memcpy(words.data(), next, sizeof(words));
        for (size_t k = 0; k < lanes.size(); ++k) {
            lanes[k] = (lanes[k] ^ words[k]) * factor;
            lanes[k] ^= lanes[k] >> 32;
        }
    }
    for (const uint64_t lane : lanes) {
        hash = (hash ^ lane) * factor;
        hash ^= hash >> 32;
    }
    for (; bytes >= 8; bytes -= 8, next += 8) {
        uint64_t word;
        std::memcpy(&word, next, 8);
        hash = (hash ^ word) * factor;
        hash ^= hash >> 32;
    }
    uint64_t last = 0;
    if (bytes > 0)
        std::memcpy(&last, next, bytes); // of no bytes the address may be null, which memcpy forbids
    return (hash ^ last) * factor;
}

template <typename T>
uint64_t mix(uint64_t hash, const std::vector<T>& values) {
    return mix(hash, values.data(), values.size() * sizeof(T));
}

VkSamplerAddressMode address_mode(WrapMode mode) {
    switch (mode) {
    case WrapMode::repeat:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case WrapMode::mirrored_repeat:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case WrapMode::clamp_to_edge:
        return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

} // namespace

uint64_t fingerprint(const Scene& scene) {
    uint64_t hash = scene.meshes.size() * 31 + scene.images.size();
    for (const Mesh& mesh : scene.meshes) {
        hash = mix(hash, mesh.positions);
        hash = mix(hash, mesh.normals);
        hash = mix(hash, mesh.tangents);
        hash = mix(hash, mesh.uv0);
        hash = mix(hash, mesh.uv1);
        hash = mix(hash, mesh.colors);
        hash = mix(hash, mesh.indices);
    }
    for (const bool is_derived : meshes_to_derive(scene))
        hash = hash * 31 + (is_derived ? 1 : 0);
    for (const TextureImage& image : scene.images)
        hash = mix(hash ^ (uint64_t(image.width) << 32), image.rgba);
    return hash;
}

GpuScene::GpuScene(const vulkan::DevicePointer& device, const Scene& scene)
    : device_(device), pictures_(scene.images) {
    upload_meshes(device, scene);
}

void GpuScene::upload_meshes(const vulkan::DevicePointer& device, const Scene& scene) {
    std::vector<Vertex> vertices;
    std::vector<TextureVertex> texture_vertices;
    std::vector<uint32_t> indices;
    for (const Mesh& mesh : scene.meshes)
        has_texture_vertices_ |= !mesh.uv0.empty() || !mesh.colors.empty();
    const std::vector<bool> to_derive = meshes_to_derive(scene);
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh derived = to_derive[m] ? derive_tangents(scene.meshes[m]) : Mesh{};
        const Mesh& mesh = to_derive[m] ? derived : scene.meshes[m];
        meshes_.push_back({uint32_t(indices.size()), uint32_t(mesh.indices.size()), int32_t(vertices.size()),
                           center_of(mesh)});
        MeshRange& range = meshes_.back();
        for (size_t k = 0; k < mesh.positions.size(); ++k) {
            vertices.push_back(pack_vertex(mesh, k, range.center));
            range.reach = glm::max(range.reach, glm::abs(vertices.back().position));
            if (has_texture_vertices_) texture_vertices.push_back(pack_texture_vertex(mesh, k));
        }
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    triangle_count_ = indices.size() / 3;
    if (vertices.empty()) vertices.emplace_back();
    if (texture_vertices.empty()) texture_vertices.push_back(pack_texture_vertex(Mesh{}, 0));
    if (indices.empty()) indices.push_back(0);
    vertices_ =
        vulkan::make_buffer(device, std::as_bytes(std::span(vertices)), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    texture_vertices_ = vulkan::make_buffer(device, std::as_bytes(std::span(texture_vertices)),
                                            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    indices_ =
        vulkan::make_buffer(device, std::as_bytes(std::span(indices)), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
}

uint64_t GpuScene::memory_bytes() const {
    uint64_t bytes = vertices_.size_bytes() + texture_vertices_.size_bytes() + indices_.size_bytes();
    for (const TextureImage& picture : pictures_)
        bytes += 5 * picture.rgba.size(); // here, and with 4/3 for its levels in three forms on the device
    return bytes;
}

vulkan::Image GpuScene::upload_image(const TextureUse& use, bool is_srgb,
                                     std::optional<float> mask_cutoff) const {
    const TextureImage white{"white", 1, 1, {255, 255, 255, 255}};
    const TextureImage& picture = use.is_used() ? pictures_[size_t(use.image)] : white;
    vulkan::ImageSettings settings;
    settings.format = is_srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
    settings.width = picture.width;
    settings.height = picture.height;
    settings.levels = vulkan::full_levels(picture.width, picture.height);
    vulkan::Image image(device_, settings);
    const std::vector<uint8_t> averaged =
        mask_cutoff ? with_coverage(picture, use.sampler, *mask_cutoff) : std::vector<uint8_t>{};
    vulkan::upload(image, {}, std::as_bytes(std::span(mask_cutoff ? averaged : picture.rgba)),
                   VK_IMAGE_LAYOUT_GENERAL);
    vulkan::Commands commands(device_);
    commands.blit_levels(image);
    commands.transition(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.submit();
    if (mask_cutoff) vulkan::upload(image, {}, std::as_bytes(std::span(picture.rgba)));
    return image;
}

BoundTexture GpuScene::texture(const TextureUse& use, bool is_srgb, std::optional<float> mask_cutoff) {
    ImageKey key(use.is_used() ? use.image : -1, use.is_used() && is_srgb, 0.0f, {}, {}, {});
    if (mask_cutoff)
        key = {use.image, is_srgb, *mask_cutoff, use.sampler.wrap_u, use.sampler.wrap_v, use.sampler.magnify};
    auto image = images_.find(key);
    if (image == images_.end())
        image = images_.emplace(key, upload_image(use, std::get<1>(key), mask_cutoff)).first;
    const std::array<int, 5> sampler_key = {int(use.sampler.wrap_u), int(use.sampler.wrap_v),
                                            int(use.sampler.magnify), int(use.sampler.minify),
                                            int(use.sampler.mip)};
    auto sampler = samplers_.find(sampler_key);
    if (sampler == samplers_.end()) {
        vulkan::SamplerSettings settings;
        settings.wrap_u = address_mode(use.sampler.wrap_u);
        settings.wrap_v = address_mode(use.sampler.wrap_v);
        settings.magnification =
            use.sampler.magnify == TextureFilter::linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
        settings.minification =
            use.sampler.minify == TextureFilter::linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
        settings.mip_mode = use.sampler.mip == MipFilter::linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                                 : VK_SAMPLER_MIPMAP_MODE_NEAREST;
        settings.max_lod =
            use.sampler.mip == MipFilter::none ? 0.25f : VK_LOD_CLAMP_NONE; // .25: keeps minification apart
        sampler = samplers_.emplace(sampler_key, vulkan::Sampler(device_, settings)).first;
    }
    return {&image->second, &sampler->second};
}

} // namespace burnish::render
