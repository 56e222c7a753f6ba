// Bytes of a glTF file and of what it refers to: containers, URIs, buffers.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>

#include "burnish/error.h"
#include "burnish/scene/gltf/document.h"

namespace burnish::gltf {
namespace fs = std::filesystem;
namespace {

/// Throws std::runtime_error with a reason that does not repeat the path.
std::vector<uint8_t> read_file(const fs::path& path, uint64_t max_bytes) {
    std::error_code code;
    fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw std::runtime_error("no such file");
    if (!fs::is_regular_file(status)) throw std::runtime_error("expected a file, got a folder or device");
    uint64_t size = fs::file_size(path, code);
    if (code) throw std::runtime_error(code.message());
    if (size > max_bytes)
        throw std::runtime_error(message("expected at most ", max_bytes, " bytes, got ", size));
    std::ifstream stream(path, std::ios::binary);
    std::vector<uint8_t> bytes(size);
    if (!stream || !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw std::runtime_error("cannot be read");
    return bytes;
}

uint32_t read_uint32(const std::vector<uint8_t>& bytes, size_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | static_cast<uint32_t>(bytes[at + 3]) << 24;
}

/// glTF 2.0, section 4.4: a 12-byte header, a JSON chunk, at most one BIN chunk, chunks of unknown type.
Container split_glb(const std::string& path, std::vector<uint8_t> bytes) {
    constexpr uint32_t JSON_CHUNK = 0x4E4F534A, BIN_CHUNK = 0x004E4942;
    if (bytes.size() < 20)
        throw FileError(path, message("GLB: expected at least 20 bytes, got ", bytes.size()));
    uint32_t version = read_uint32(bytes, 4), length = read_uint32(bytes, 8);
    if (version != 2) throw FileError(path, message("GLB version: expected 2, got ", version));
    if (length > bytes.size())
        throw FileError(
            path, message("GLB length: expected at most the file's ", bytes.size(), " bytes, got ", length));
    Container container;
    size_t binary_begin = 0, binary_end = 0;
    bool has_json = false;
    for (size_t at = 12; at + 8 <= length;) {
        size_t size = read_uint32(bytes, at), begin = at + 8;
        uint32_t type = read_uint32(bytes, at + 4);
        if (size > length - begin)
            throw FileError(path, message("GLB chunk: expected at most the remaining ", length - begin,
                                          " bytes, got ", size));
        if (!has_json && type != JSON_CHUNK)
            throw FileError(path, "GLB: expected the first chunk to be JSON, got another");
        if (type == JSON_CHUNK && !has_json) {
            container.json.assign(bytes.begin() + begin, bytes.begin() + begin + size);
            has_json = true;
        } else if (type == BIN_CHUNK && !container.has_binary) {
            binary_begin = begin;
            binary_end = begin + size;
            container.has_binary = true;
        }
        at = begin + size;
    }
    if (!has_json) throw FileError(path, "GLB: expected a JSON chunk, got none");
    if (container.has_binary) {
        bytes.resize(binary_end);
        bytes.erase(bytes.begin(), bytes.begin() + binary_begin);
        container.binary = std::move(bytes);
    }
    return container;
}

std::vector<uint8_t> decode_base64(std::string_view text) {
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    uint32_t bits = 0;
    int count = 0;
    while (!text.empty() && text.back() == '=')
        text.remove_suffix(1);
    for (char c : text) {
        int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                    : c >= 'a' && c <= 'z' ? c - 'a' + 26
                    : c >= '0' && c <= '9' ? c - '0' + 52
                    : c == '+' || c == '-' ? 62
                    : c == '/' || c == '_' ? 63
                                           : -1;
        if (value < 0) throw std::runtime_error("expected base64 data, got another character");
        bits = bits << 6 | static_cast<uint32_t>(value);
        if (++count % 4 != 1) bytes.push_back(static_cast<uint8_t>(bits >> (6 - 2 * ((count - 1) % 4))));
    }
    if (count % 4 == 1) throw std::runtime_error("expected whole base64 groups, got a lone character");
    return bytes;
}

std::string decode_percent(const std::string& uri) {
    auto hex = [](char c) {
        return std::isdigit(static_cast<unsigned char>(c)) ? c - '0' : (c | 32) - 'a' + 10;
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        bool is_escape = uri[i] == '%' && i + 2 < uri.size() &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
        text += is_escape ? static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2])) : uri[i];
        if (is_escape) i += 2;
    }
    return text;
}

/// A file may only refer to its own folder and what lies below: the rule for the name, before it is looked
/// up.
void require_inside(const std::string& name) {
    if (name.find('\0') != std::string::npos)
        throw std::runtime_error("expected a file name, got one with a zero byte");
    size_t colon = name.find(':');
    if (colon != std::string::npos && colon < name.find('/'))
        throw std::runtime_error("expected a relative file name or base64 data, got another scheme");
    if (name.front() == '/' || name.front() == '\\' || *fs::path(name).lexically_normal().begin() == "..")
        throw std::runtime_error("expected a file in or below the scene's folder, got one outside");
}

/// The same rule for what the name leads to: the path without links, which must lie below the folder without
/// links. The scene's own file may be a link, its folder is that of the name it was asked for by.
fs::path require_inside(const fs::path& folder, const fs::path& path) {
    std::error_code code;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, code);
    if (code) throw std::runtime_error(code.message());
    const fs::path target = fs::canonical(path, code);
    if (code == std::errc::no_such_file_or_directory) throw std::runtime_error("no such file");
    if (code) throw std::runtime_error(code.message());
    const auto [end, ignored] = std::mismatch(root.begin(), root.end(), target.begin(), target.end());
    if (end != root.end())
        throw std::runtime_error("expected a file in or below the scene's folder, got a link to one outside");
    return target;
}

} // namespace

Container read_container(const std::string& path) {
    std::vector<uint8_t> bytes;
    try {
        bytes = read_file(path, MAX_FILE_BYTES);
    } catch (const std::runtime_error& error) {
        throw FileError(path, error.what());
    }
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0)
        return split_glb(path, std::move(bytes));
    if (fs::path(path).extension() == ".glb")
        throw FileError(path, "GLB: expected a file that begins with glTF, got another");
    Container container;
    size_t mark = bytes.size() >= 3 && bytes[0] == 0xEF && bytes[1] == 0xBB && bytes[2] == 0xBF ? 3 : 0;
    container.json.assign(bytes.begin() + mark, bytes.end());
    return container;
}

std::string short_uri(const std::string& uri) {
    if (uri.rfind("data:", 0) != 0) return "\"" + uri + "\"";
    return "data URI";
}

std::vector<uint8_t> read_uri(const fs::path& folder, const std::string& uri, uint64_t max_bytes) {
    if (uri.empty()) throw std::runtime_error("expected a file name, got an empty URI");
    if (uri.rfind("data:", 0) == 0) {
        constexpr std::string_view MARK = ";base64,";
        size_t mark = uri.find(MARK);
        if (mark == std::string::npos || mark > 256)
            throw std::runtime_error("expected base64 data, got another encoding");
        std::string_view data = std::string_view(uri).substr(mark + MARK.size());
        return decode_base64(data);
    }
    std::string name = decode_percent(uri);
    require_inside(name);
    require_inside(uri);
    // Exporters leave characters undecoded as often as they escape them: a name may really contain a percent
    // sign.
    fs::path decoded = folder / fs::path(name), verbatim = folder / fs::path(uri);
    std::error_code code;
    const bool is_decoded = fs::exists(decoded, code) || !fs::exists(verbatim, code);
    return read_file(require_inside(folder, is_decoded ? decoded : verbatim), max_bytes);
}

void load_buffers(Document& document, Container& container) {
    uint64_t remaining = MAX_FILE_BYTES;
    for (size_t i = 0; i < document.model.buffers.size(); ++i) {
        tinygltf::Buffer& buffer = document.model.buffers[i];
        std::string where = message("buffers[", i, "]");
        if (!buffer.uri.empty()) where.append(" ").append(short_uri(buffer.uri));
        try {
            if (!buffer.uri.empty())
                buffer.data = read_uri(document.folder, buffer.uri, remaining);
            else if (i == 0 && container.has_binary)
                buffer.data = std::move(container.binary);
            else
                continue; // a placeholder for an extension's data: whoever reads from it gets the error
        } catch (const std::runtime_error& error) {
            throw FileError(document.path, where + ": " + error.what());
        }
        buffer.uri.clear();
        if (buffer.data.size() < document.buffer_bytes[i])
            throw FileError(document.path,
                            message(where, ".byteLength: expected at most the ", buffer.data.size(),
                                    " bytes there are, got ", document.buffer_bytes[i]));
        buffer.data.resize(document.buffer_bytes[i]);
        if (buffer.data.size() > remaining)
            throw FileError(document.path, message("buffers: expected at most ", MAX_FILE_BYTES,
                                                   " bytes together, got more"));
        remaining -= buffer.data.size();
    }
}

} // namespace burnish::gltf
