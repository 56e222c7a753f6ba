// The one place that compiles the third-party readers: tinygltf for the JSON, stb_image for PNG and JPEG.
#include <cstddef>
#include <cstdint>

#include "burnish/scene/gltf/image.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_MALLOC(size) burnish::gltf::bounded_malloc(size)
#define STBI_REALLOC(pointer, size) burnish::gltf::bounded_realloc(pointer, size)
#define STBI_FREE(pointer) burnish::gltf::bounded_free(pointer)
#include <stb_image.h>

#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

namespace burnish::gltf {

StbHeader stb_header(const std::vector<uint8_t>& bytes) {
    StbHeader header;
    int channels = 0;
    header.is_known = stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &header.width,
                                            &header.height, &channels);
    header.is_16_bit =
        header.is_known && stbi_is_16_bit_from_memory(bytes.data(), static_cast<int>(bytes.size()));
    return header;
}

std::vector<uint8_t> stb_decode(const std::vector<uint8_t>& bytes, int& width, int& height,
                                std::string& failure) {
    int channels = 0;
    uint8_t* texels = stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height,
                                            &channels, STBI_rgb_alpha);
    if (!texels) {
        failure = stbi_failure_reason() ? stbi_failure_reason() : "unknown reason";
        return {};
    }
    std::vector<uint8_t> rgba(texels, texels + size_t{4} * width * height);
    stbi_image_free(texels);
    return rgba;
}

} // namespace burnish::gltf
