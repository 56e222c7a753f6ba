// The pieces of a glTF file between reading and interpreting; used by the gltf_*.cpp files only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace burnish::gltf {

// Together they keep the loader below 2 GB whatever a file declares.
constexpr uint64_t MAX_FILE_BYTES = 512u << 20; ///< one file, and all buffers of a scene together
constexpr uint64_t MAX_JSON_BYTES = 256u << 20; ///< JSON with data URIs
constexpr uint64_t MAX_JSON_VALUES = 4u << 20;
constexpr uint64_t MAX_MESH_BYTES = 768u << 20;  ///< vertices and indices of all meshes
constexpr uint64_t MAX_IMAGE_TEXELS = 1u << 26;  ///< one picture: 8192 x 8192
constexpr uint64_t MAX_SCENE_TEXELS = 3u << 25;  ///< all pictures: 384 MB decoded
constexpr uint64_t MAX_IMAGE_BYTES = 128u << 20; ///< one picture, encoded
constexpr uint64_t MAX_OBJECTS = 1u << 20;

/// A .gltf's text, or a .glb's two chunks.
struct Container {
    std::string json;
    std::vector<uint8_t> binary; ///< the BIN chunk
    bool has_binary = false;
};

/// The parsed JSON. Every index in `model` is in range and every property of its documented type and size.
/// Buffers and images in it name their sources, but are not yet loaded.
struct Document {
    std::string path;
    std::filesystem::path folder;
    tinygltf::Model model;
    std::vector<uint64_t> buffer_bytes;
    std::vector<std::string> warnings;
    std::vector<std::string> ignored_extensions;
};

/// Throws FileError where the file is missing, too large, or no glTF container.
Container read_container(const std::string& path);

/// Parses and checks the JSON; throws FileError that names the property, the rule and the value.
Document parse_document(const std::string& path, const std::string& json);

/// Bytes behind a URI: base64 data, or a file in or below the folder, links followed. Throws
/// std::runtime_error with the reason.
std::vector<uint8_t> read_uri(const std::filesystem::path& folder, const std::string& uri,
                              uint64_t max_bytes);

/// The URI for a message: data URIs shortened.
std::string short_uri(const std::string& uri);

/// Fills model.buffers[i].data; throws FileError where one is missing or shorter than its byteLength.
void load_buffers(Document& document, Container& container);

} // namespace burnish::gltf
