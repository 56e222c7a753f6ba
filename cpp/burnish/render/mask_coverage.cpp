#include "burnish/render/mask_coverage.h"

#include <array>
#include <cmath>

namespace burnish::render {
namespace {

constexpr int PLACES = 8; // along each side of a texel

/// The texel that the sampler reads one step outside of the picture.
int wrapped(int i, int count, WrapMode mode) {
    if (i >= 0 && i < count) return i;
    if (mode == WrapMode::repeat) return (i + count) % count;
    return i < 0 ? 0 : count - 1; // mirrored: the edge's own texel again
}

/// Share of a texel's area where its alpha, read between the 3 x 3 around it, reaches the cutoff.
float share_of(const std::array<float, 9>& around, float cutoff) {
    int covered = 0;
    for (int y = 0; y < PLACES; ++y)
        for (int x = 0; x < PLACES; ++x) {
            const float u = (float(x) + 0.5f) / PLACES - 0.5f, v = (float(y) + 0.5f) / PLACES - 0.5f;
            const int column = u < 0.0f ? 0 : 1, row = v < 0.0f ? 0 : 1; // of the four nearest texels
            const float s = u < 0.0f ? 1.0f + u : u, t = v < 0.0f ? 1.0f + v : v;
            const float* top = &around[size_t(3 * row + column)];
            const float* bottom = top + 3;
            const float alpha = (1.0f - t) * ((1.0f - s) * top[0] + s * top[1]) +
                                t * ((1.0f - s) * bottom[0] + s * bottom[1]);
            covered += alpha >= cutoff ? 1 : 0;
        }
    return float(covered) / (PLACES * PLACES);
}

} // namespace

std::vector<uint8_t> with_coverage(const TextureImage& picture, const TextureSampler& sampler, float cutoff) {
    std::vector<uint8_t> rgba = picture.rgba;
    const int width = int(picture.width), height = int(picture.height);
    const auto alpha_at = [&](int column, int row) {
        const size_t x = size_t(wrapped(column, width, sampler.wrap_u)),
                     y = size_t(wrapped(row, height, sampler.wrap_v));
        return float(picture.rgba[(y * picture.width + x) * 4 + 3]) / 255.0f;
    };
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            std::array<float, 9> around;
            bool is_above = false, is_below = false;
            for (int k = 0; k < 9; ++k) {
                around[size_t(k)] = alpha_at(column + k % 3 - 1, row + k / 3 - 1);
                (around[size_t(k)] >= cutoff ? is_above : is_below) = true;
            }
            const bool is_even = !(is_above && is_below) || sampler.magnify == TextureFilter::nearest;
            const float share = is_even ? (around[4] >= cutoff ? 1.0f : 0.0f) : share_of(around, cutoff);
            rgba[(size_t(row) * picture.width + size_t(column)) * 4 + 3] =
                uint8_t(std::lround(255.0f * share));
        }
    return rgba;
}

} // namespace burnish::render
