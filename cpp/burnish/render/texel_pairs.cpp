#include "burnish/render/texel_pairs.h"

#include "burnish/cores.h"
#include "burnish/light/environment.h"
#include "burnish/light/half.h"
#include "burnish/plan/map_lookup.h"
#include "burnish/vulkan/commands.h"
#include "burnish/vulkan/transfer.h"

#include <algorithm>
#include <array>
#include <vector>

#include <glm/gtc/packing.hpp>

namespace burnish {

namespace {

constexpr uint32_t TEXEL_BYTES = 8;

/// The texels of one level of a cube, found by their places in the orientation of the pairs.
class CubeLevel {
public:
    explicit CubeLevel(const LevelTexels& texels) : texels_(texels), size_(texels.size) {}

    /// Texels of a row of a bordered face, from the border's corner on; `row` has room for them.
    void read_row(uint32_t face, int y, std::span<uint64_t> row) const {
        const int n = int(size_);
        const bool is_border = y < 0 || y >= n;
        const std::ptrdiff_t begin = index(face, 0, y), step = n > 1 ? index(face, 1, y) - begin : 0;
        for (int x = 0; x < n; ++x)
            row[size_t(x) + 1] = texels_.first[begin + x * step];
        row.front() = is_border ? corner(face, -1, y) : texel(face, -1, y);
        row.back() = is_border ? corner(face, n, y) : texel(face, n, y);
    }

private:
    /// Of a texel of the face, or of the one that lies as deep inside the neighbouring face as (x, y) is
    /// beyond the edge.
    std::ptrdiff_t index(uint32_t face, int x, int y) const {
        // Coordinates of texel centres are multiples of 1/size, a power of two: exact.
        const float size = float(size_), texel = 1.0f / size;
        const float u = float(2 * x + 1) * texel - 1.0f, v = float(2 * y + 1) * texel - 1.0f;
        const bool is_beyond = std::max(std::abs(u), std::abs(v)) > 1.0f;
        const float a = std::clamp(u, -1.0f, 1.0f), b = std::clamp(v, -1.0f, 1.0f);
        const float side = (face % 2 ? -1.0f : 1.0f) * (is_beyond ? 1.0f - texel : 1.0f);
        const glm::vec3 point = face < 2   ? glm::vec3(side, b, a)
                                : face < 4 ? glm::vec3(a, side, b)
                                           : glm::vec3(a, b, side);
        float right = 0.0f, down = 0.0f;
        const uint32_t owner = cube_face(point, right, down);
        const auto place = [&](float coordinate) {
            return std::ptrdiff_t((coordinate + 1.0f) * (0.5f * size));
        };
        return std::ptrdiff_t(owner * texels_.face_pitch) + place(down) * std::ptrdiff_t(texels_.row_pitch) +
               place(right);
    }

    uint64_t texel(uint32_t face, int x, int y) const { return texels_.first[index(face, x, y)]; }

    /// Beyond two edges: the mean of the three texels that meet there.
    uint64_t corner(uint32_t face, int x, int y) const {
        const int last = int(size_) - 1;
        const int inside_x = std::clamp(x, 0, last), inside_y = std::clamp(y, 0, last);
        const std::array<glm::vec4, 3> around{glm::unpackHalf4x16(texel(face, inside_x, inside_y)),
                                              glm::unpackHalf4x16(texel(face, inside_x, y)),
                                              glm::unpackHalf4x16(texel(face, x, inside_y))};
        const glm::vec4 mean = (around[0] + around[1] + around[2]) / 3.0f;
        return half_bits(mean.r) | uint64_t(half_bits(mean.g)) << 16 | uint64_t(half_bits(mean.b)) << 32;
    }

    LevelTexels texels_;
    uint32_t size_;
};

glm::uvec4 pair_of(uint64_t left, uint64_t right) {
    const auto low = [](uint64_t texel) { return uint32_t(texel & 0xffffu); };
    const auto high = [](uint64_t texel) { return uint32_t(texel & 0xffff0000u); };
    return {low(left) | low(right) << 16, high(left) >> 16 | high(right),
            low(left >> 32) | low(right >> 32) << 16, 0u};
}

void pack_level(const LevelTexels& texels, glm::uvec4* pairs) {
    const uint32_t size = texels.size;
    const CubeLevel level(texels);
    for_each_on_cores(6, size >= LEAST_THREADED_SIZE, [&](size_t face) {
        std::vector<uint64_t> row(size + 2);
        glm::uvec4* pair = pairs + face * (size + 1) * (size + 2);
        for (uint32_t y = 0; y < size + 2; ++y) {
            level.read_row(uint32_t(face), int(y) - 1, row);
            for (uint32_t x = 0; x <= size; ++x)
                *pair++ = pair_of(row[x], row[x + 1]);
        }
    });
}

} // namespace

void pack_pairs(std::span<const LevelTexels> levels, uint32_t face_size, uint32_t first_cube,
                uint32_t cube_count, const vulkan::ElementBuffer& pairs) {
    if (levels.empty()) return;
    uint64_t first = 0; // pairs of a cube before those levels
    for (uint32_t size = face_size; size > levels.front().size; size /= 2)
        first += level_pair_count(size);
    uint64_t count = 0;
    for (const LevelTexels& level : levels)
        count += level_pair_count(level.size);
    const bool is_mapped = pairs.buffer().is_mapped();
    std::vector<glm::uvec4> staged(is_mapped ? 0 : count);
    for (uint32_t cube = 0; cube < cube_count; ++cube) {
        const uint64_t begin = (first_cube + cube) * cube_pair_count(face_size) + first;
        glm::uvec4* pair = is_mapped ? pairs.buffer().mapped<glm::uvec4>().data() + begin : staged.data();
        for (LevelTexels level : levels) {
            level.first += 6 * cube * level.face_pitch;
            pack_level(level, pair);
            pair += level_pair_count(level.size);
        }
        if (!is_mapped)
            vulkan::upload(pairs.buffer(), std::as_bytes(std::span(staged)), begin * sizeof(glm::uvec4));
    }
}

void pack_pairs(vulkan::Image& cubes, uint32_t first_level, uint32_t first_cube, uint32_t cube_count,
                const vulkan::ElementBuffer& pairs) {
    const vulkan::ImageSettings& settings = cubes.settings();
    std::vector<VkBufferImageCopy> copies;
    uint64_t texels = 0;
    for (uint32_t level = first_level; level < settings.levels; ++level) {
        const uint32_t size = settings.width >> level;
        VkBufferImageCopy copy{};
        copy.bufferOffset = texels * TEXEL_BYTES;
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 6 * first_cube, 6 * cube_count};
        copy.imageExtent = {size, size, 1};
        copies.push_back(copy);
        texels += uint64_t(6) * cube_count * size * size;
    }
    if (copies.empty()) return;
    const vulkan::Buffer room(cubes.device(), texels * TEXEL_BYTES, 0, vulkan::MemoryUse::read_back);
    vulkan::Commands commands(cubes.device());
    commands.transition(cubes, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(commands.handle(), cubes.handle(), cubes.layout(), room.handle(),
                           uint32_t(copies.size()), copies.data());
    commands.transition(cubes, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.submit();

    std::vector<LevelTexels> levels;
    for (const VkBufferImageCopy& copy : copies) {
        const size_t size = copy.imageExtent.width;
        levels.push_back({room.mapped<uint64_t>().data() + copy.bufferOffset / TEXEL_BYTES, size, size * size,
                          uint32_t(size)});
    }
    pack_pairs(levels, settings.width, first_cube, cube_count, pairs);
}

} // namespace burnish
