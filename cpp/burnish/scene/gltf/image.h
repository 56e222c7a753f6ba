// Pictures of a glTF file: sizes are checked before anything is decoded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "burnish/scene/texture.h"

namespace burnish::gltf {

struct StbHeader {
    bool is_known = false;
    bool is_16_bit = false;
    int width = 0;
    int height = 0;
};

StbHeader stb_header(const std::vector<uint8_t>& bytes);
/// RGBA bytes, empty with the reason in `failure` where the picture is damaged.
std::vector<uint8_t> stb_decode(const std::vector<uint8_t>& bytes, int& width, int& height,
                                std::string& failure);

// A few bytes of a deflate stream can ask for gigabytes: while a picture is decoded no block may exceed what
// its size can need.
void* bounded_malloc(size_t size);
void* bounded_realloc(void* pointer, size_t size);
void bounded_free(void* pointer);

/// Decodes a PNG or JPEG. Throws std::runtime_error with the reason. `max_texels` bounds width * height.
/// `warning` is set where the picture was converted.
TextureImage decode_image(const std::vector<uint8_t>& bytes, uint64_t max_texels, std::string& warning);

} // namespace burnish::gltf
