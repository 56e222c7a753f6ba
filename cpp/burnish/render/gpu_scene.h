// A scene's triangles and pictures on the device. Materials are small and change often: they are in
// ShadeTables.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "burnish/scene/scene.h"
#include "burnish/vulkan/buffer.h"
#include "burnish/vulkan/image.h"

namespace burnish::render {

/// Where one mesh lies in the buffers.
struct MeshRange {
    uint32_t first_index = 0;
    uint32_t index_count = 0;
    int32_t vertex_offset = 0;
    glm::dvec3 center{0.0}; ///< object space: what the buffer's positions are relative to
    glm::vec3 reach{0.0f};  ///< largest absolute coordinates relative to it
};

/// One texture of one material, ready to be bound.
struct BoundTexture {
    const vulkan::Image* image = nullptr;
    const vulkan::Sampler* sampler = nullptr;
};

class GpuScene {
public:
    /// Bytes of one vertex: position, then normal and tangent packed; and of what textures need of it.
    static constexpr uint32_t VERTEX_BYTES = 20;
    static constexpr uint32_t TEXTURE_VERTEX_BYTES = 24;

    /// By what their texels depend on: picture (null = white), is_srgb and, of those with coverage, cutoff,
    /// wrapping and filter.
    using ImageKey = std::tuple<const TextureImage*, bool, float, WrapMode, WrapMode, TextureFilter>;
    using Images = std::map<ImageKey, std::shared_ptr<vulkan::Image>>;

    /// `known`: images of the scene's pictures that other scenes have uploaded.
    GpuScene(const vulkan::DevicePointer& device, const Scene& scene, Images known = {});

    /// Those on the device whose pictures the scene has, too; and the white one.
    Images images_of(const Scene& scene) const;

    const vulkan::Buffer& vertices() const { return vertices_; }
    /// Texture coordinates and colours; a single vertex of zeros when no mesh has any.
    const vulkan::Buffer& texture_vertices() const { return texture_vertices_; }
    bool has_texture_vertices() const { return has_texture_vertices_; }
    const vulkan::Buffer& indices() const { return indices_; }
    const MeshRange& mesh(uint32_t index) const { return meshes_[index]; }
    uint64_t triangle_count() const { return triangle_count_; }
    /// At most so much memory, of host and device: textures may be uploaded in two encodings.
    uint64_t memory_bytes() const;

    /// The picture decoded from sRGB or not, with mip levels; a white texel for an unused texture. With a
    /// cutoff in (0, 1] alpha of all levels but the first is coverage (mask_coverage.h).
    BoundTexture texture(const TextureUse& use, bool is_srgb, std::optional<float> mask_cutoff);
    /// Textures uploaded since the last call.
    uint32_t take_uploads() { return std::exchange(uploads_, 0); }

private:
    void upload_meshes(const vulkan::DevicePointer& device, const Scene& scene);
    vulkan::Image upload_image(const TextureUse& use, bool is_srgb, std::optional<float> mask_cutoff) const;

    vulkan::DevicePointer device_;
    std::vector<std::shared_ptr<const TextureImage>> pictures_; // uploaded when first used
    vulkan::Buffer vertices_, texture_vertices_, indices_;
    bool has_texture_vertices_ = false;
    uint64_t triangle_count_ = 0;
    std::vector<MeshRange> meshes_;
    Images images_;
    uint32_t uploads_ = 0;
    std::map<std::array<int, 5>, vulkan::Sampler> samplers_;
};

} // namespace burnish::render
