#include "burnish/render/gpu_scene.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/packing.hpp>

#include "burnish/render/mask_coverage.h"
#include "burnish/render/octahedral.h"
#include "burnish/render/scene_identity.h"
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

Mesh derive_tangents(Mesh mesh) {
    compute_tangents(mesh, mesh.uv0.empty() ? 1 : 0);
    return mesh;
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

GpuScene::GpuScene(const vulkan::DevicePointer& device, const Scene& scene, Images known)
    : device_(device), pictures_(scene.images.shared()), images_(std::move(known)) {
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

GpuScene::Images GpuScene::images_of(const Scene& scene) const {
    Images found;
    for (const auto& [key, image] : images_) {
        const TextureImage* picture = std::get<0>(key);
        const auto is_it = [&](const auto& one) { return one.get() == picture; };
        if (!picture || std::ranges::any_of(scene.images.shared(), is_it)) found.emplace(key, image);
    }
    return found;
}

uint64_t GpuScene::memory_bytes() const {
    uint64_t bytes = vertices_.size_bytes() + texture_vertices_.size_bytes() + indices_.size_bytes();
    for (const auto& picture : pictures_)
        bytes += 5 * picture->rgba.size(); // here, and with 4/3 for its levels in three forms on the device
    return bytes;
}

vulkan::Image GpuScene::upload_image(const TextureUse& use, bool is_srgb,
                                     std::optional<float> mask_cutoff) const {
    const TextureImage white{"white", 1, 1, {255, 255, 255, 255}};
    const TextureImage& picture = use.is_used() ? *pictures_[size_t(use.image)] : white;
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
    const TextureImage* picture = use.is_used() ? pictures_[size_t(use.image)].get() : nullptr;
    ImageKey key(picture, picture && is_srgb, 0.0f, {}, {}, {});
    if (mask_cutoff)
        key = {picture, is_srgb, *mask_cutoff, use.sampler.wrap_u, use.sampler.wrap_v, use.sampler.magnify};
    auto image = images_.find(key);
    if (image == images_.end()) {
        uploads_ += picture ? 1 : 0;
        image =
            images_
                .emplace(key,
                         std::make_shared<vulkan::Image>(upload_image(use, std::get<1>(key), mask_cutoff)))
                .first;
    }
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
    return {image->second.get(), &sampler->second};
}

} // namespace burnish::render
