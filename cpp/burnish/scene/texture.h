// Pictures that materials read, as plain data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

/// An 8-bit picture, row 0 at the top (glTF: texture coordinate v = 0).
struct TextureImage {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba; ///< width * height * 4, not decoded from sRGB
};

enum class WrapMode { repeat, mirrored_repeat, clamp_to_edge };
enum class TextureFilter { nearest, linear };
enum class MipFilter { none, nearest, linear };

struct TextureSampler {
    WrapMode wrap_u = WrapMode::repeat;
    WrapMode wrap_v = WrapMode::repeat;
    TextureFilter magnify = TextureFilter::linear;
    TextureFilter minify = TextureFilter::linear;
    MipFilter mip = MipFilter::linear;
    bool operator==(const TextureSampler&) const = default;
};

/// One use of a picture by a material.
struct TextureUse {
    int32_t image = -1; ///< index into Scene::images, -1 = none
    TextureSampler sampler;
    uint32_t uv_set = 0; ///< 0 or 1
    /// uv' = uv_scale_rotation * uv + uv_offset (KHR_texture_transform).
    glm::mat2 uv_scale_rotation{1.0f};
    glm::vec2 uv_offset{0.0f};

    bool is_used() const { return image >= 0; }
};

} // namespace burnish
