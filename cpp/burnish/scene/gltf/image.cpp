#include "burnish/scene/gltf/image.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "burnish/error.h"

namespace burnish::gltf {
namespace {

constexpr int MAX_SIDE = 16384;
// Of any block while decoding: 16-bit RGBA with the doubling of a growing buffer, and room for tables.
constexpr size_t BLOCK_BYTES_PER_TEXEL = 16, SMALLEST_BLOCK_LIMIT = 4u << 20,
                 LARGEST_BLOCK_LIMIT = 513u << 20;
thread_local size_t largest_block = SMALLEST_BLOCK_LIMIT;

bool starts_with(const std::vector<uint8_t>& bytes, std::initializer_list<uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

/// What the bytes are, for the message about a picture that is neither PNG nor JPEG.
std::string describe(const std::vector<uint8_t>& bytes) {
    if (bytes.empty()) return "an empty file";
    if (starts_with(bytes, {0xAB, 'K', 'T', 'X', ' ', '2', '0'})) return "a KTX2 file";
    if (starts_with(bytes, {'R', 'I', 'F', 'F'})) return "a WebP file";
    if (starts_with(bytes, {'D', 'D', 'S', ' '})) return "a DDS file";
    if (starts_with(bytes, {0x89, 'P', 'N', 'G'})) return "a damaged PNG";
    if (starts_with(bytes, {0xFF, 0xD8})) return "a damaged JPEG";
    return "something else";
}

/// stb_image up to 2.27 writes past its Huffman tables where one lists more than 256 codes; no valid table
/// does. Looks at every marker that decoder can reach: entropy-coded data holds no 0xFF but before 0 and
/// restart markers.
bool has_oversized_huffman_table(const std::vector<uint8_t>& jpeg) {
    constexpr uint8_t DEFINE_HUFFMAN_TABLES = 0xC4;
    auto is_bare = [](uint8_t code) {
        return code <= 0x01 || (code >= 0xD0 && code <= 0xD9) || code == 0xFF;
    };
    for (size_t at = 0; at + 4 <= jpeg.size();) {
        if (jpeg[at] != 0xFF || is_bare(jpeg[at + 1])) {
            ++at;
            continue;
        }
        size_t end = std::min(jpeg.size(), at + 2 + (size_t{jpeg[at + 2]} << 8 | jpeg[at + 3]));
        size_t table = at + 4;
        if (jpeg[at + 1] == DEFINE_HUFFMAN_TABLES) {
            while (table + 17 <= end) {
                size_t codes = 0;
                for (size_t length = 1; length <= 16; ++length)
                    codes += jpeg[table + length];
                if (codes > 256) return true;
                table += 17 + codes;
            }
            // A table that crosses its segment's end is read to its own end by the decoder.
            if (table < end) return true;
        }
        at = std::max(end, table);
    }
    return false;
}

} // namespace

void* bounded_malloc(size_t size) {
    // Zeroed: stb_image up to 2.27 decodes by Huffman tables that a JPEG names and does not define, left as
    // the memory was.
    return size <= largest_block ? std::calloc(1, size) : nullptr;
}
void* bounded_realloc(void* pointer, size_t size) {
    return size <= largest_block ? std::realloc(pointer, size) : nullptr;
}
void bounded_free(void* pointer) {
    std::free(pointer);
}

TextureImage decode_image(const std::vector<uint8_t>& bytes, uint64_t max_texels, std::string& warning) {
    if (starts_with(bytes, {0xFF}) && has_oversized_huffman_table(bytes)) // a JPEG, if it is anything
        throw std::runtime_error("damaged picture (a Huffman table of more than 256 codes)");
    largest_block = SMALLEST_BLOCK_LIMIT;
    StbHeader header = stb_header(bytes);
    if (!header.is_known) throw std::runtime_error("expected a PNG or JPEG, got " + describe(bytes));
    if (header.width < 1 || header.height < 1 || header.width > MAX_SIDE || header.height > MAX_SIDE)
        throw std::runtime_error(
            message("expected sides of 1..", MAX_SIDE, " texels, got ", header.width, " x ", header.height));
    uint64_t texels = uint64_t{static_cast<uint32_t>(header.width)} * static_cast<uint32_t>(header.height);
    if (texels > max_texels)
        throw std::runtime_error(
            message("expected at most ", max_texels, " texels, got ", header.width, " x ", header.height));

    largest_block = std::clamp(static_cast<size_t>(texels) * BLOCK_BYTES_PER_TEXEL, SMALLEST_BLOCK_LIMIT,
                               LARGEST_BLOCK_LIMIT);
    int width = 0, height = 0;
    std::string failure;
    TextureImage image;
    image.rgba = stb_decode(bytes, width, height, failure);
    if (image.rgba.empty()) throw std::runtime_error("damaged picture (" + failure + ")");
    image.width = static_cast<uint32_t>(width);
    image.height = static_cast<uint32_t>(height);
    if (header.is_16_bit) warning = "16 bits per channel read as 8";
    return image;
}

} // namespace burnish::gltf
