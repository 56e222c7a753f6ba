// What this machine can do at best with the engine's method: Regular as published (one round Kurt lobe,
// trilinear) by hand, on the engine's own data: a packed normal a pixel, a table of samples, and a map in
// pairs of texels (cpp/burnish/render/texel_pairs.h). Nothing of the engine is in it; scripts/bench writes
// its input and compares pictures and times.
//
//   shading_loop INPUT THREADS RUNS [PICTURE]
//
// prints the milliseconds of each run, by the clock and of all threads. PICTURE is RGBA in float32.
#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "lanes.h"
#include "loop_input.h"

namespace {

using lanes::Floats;
using lanes::Ints;
using lanes::Vector;

constexpr int LANES = lanes::COUNT, BAND_ROWS = 8;

/// One bilinear lookup of every lane. The weights are of (left above, right above, left below, right below),
/// and hold all that the texels are multiplied by.
struct alignas(64) Aims {
    Ints above, below; // bytes from the first pair
    float weights[LANES][4];
};

/// The sums of LANES pixels go through two phases: all lookups are aimed, a lane a pixel; then every pixel
/// loads its own, a lane a channel of a texel. Both phases stay in the first cache.
class Shader {
public:
    explicit Shader(const Input& input)
        : input_(input), header_(input.header), aims_(2 * input.samples.size()) {
        const float size = float(1 << header_.last_level);
        last_level_ = float(header_.last_level);
        size_bits_ = std::bit_cast<int32_t>(size);
    }

    void shade_row(uint32_t y, float* row) {
        const uint32_t* normals = &input_.normals[size_t(y) * header_.width];
        for (uint32_t x = 0; x < header_.width; x += LANES) {
            aim(x, y, normals + x);
            for (int lane = 0; lane < LANES; ++lane)
                load(lane, row + 4 * (x + uint32_t(lane)));
        }
    }

private:
    static Vector decode_normal(const uint32_t* packed) {
        Ints bits;
        std::memcpy(&bits, packed, sizeof bits);
        const Floats x = lanes::most(lanes::to_floats((bits << 16) >> 16) / 32767.0f, Floats{} - 1.0f);
        const Floats y = lanes::most(lanes::to_floats(bits >> 16) / 32767.0f, Floats{} - 1.0f);
        const Floats z = 1.0f - lanes::absolute(x) - lanes::absolute(y);
        const Floats folded_x = 1.0f - lanes::absolute(y), folded_y = 1.0f - lanes::absolute(x);
        return lanes::normalized({z < 0.0f ? (x >= 0.0f ? folded_x : -folded_x) : x,
                                  z < 0.0f ? (y >= 0.0f ? folded_y : -folded_y) : y, z});
    }

    Vector view(uint32_t x, uint32_t y) const {
        const Floats column = lanes::counting() + (float(x) + 0.5f);
        const float row = float(y) + 0.5f;
        const auto along = [&](int axis) {
            return -(header_.ray_corner[axis] + column * header_.ray_dx[axis] + row * header_.ray_dy[axis]);
        };
        return lanes::normalized({along(0), along(1), along(2)});
    }

    /// Tangent along growing longitude; at the poles that of Duff et al. 2017.
    static Vector tangent_of(Vector n) {
        const Floats length2 = n.x * n.x + n.z * n.z;
        const Floats scale = 1.0f / lanes::square_root(lanes::most(length2, Floats{} + 1e-36f));
        const Vector along{n.z * scale, Floats{}, -n.x * scale};
        const Ints is_usable = length2 > 1e-10f;
        if (!lanes::any(~is_usable)) return along;
        const Floats sign = n.z >= 0.0f ? Floats{} + 1.0f : Floats{} - 1.0f;
        const Floats a = -1.0f / (sign + n.z);
        return lanes::select(is_usable, along,
                             {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x});
    }

    void aim(uint32_t x, uint32_t y, const uint32_t* packed_normals) {
        const Vector o = view(x, y);
        Vector n = decode_normal(packed_normals);
        const Floats facing = lanes::dot(n, o);
        if (lanes::any(facing < 1e-3f)) {
            const Floats missing = lanes::most(1e-3f - facing, Floats{});
            n = lanes::select(
                facing < 1e-3f,
                lanes::normalized({n.x + missing * o.x, n.y + missing * o.y, n.z + missing * o.z}), n);
        }
        const Vector t = tangent_of(n), b = lanes::cross(n, t);
        const Vector local{lanes::dot(o, t), lanes::dot(o, b), lanes::dot(o, n)};
        const Floats xx = local.x * local.x, yy = local.y * local.y, zz = local.z * local.z;
        const Floats area = lanes::square_root((xx + zz) * (yy + zz));

        for (size_t k = 0; k < input_.samples.size(); ++k) {
            const Sample& s = input_.samples[k];
            const float twice_c = 2.0f / (1.0f + s.slope_x * s.slope_x + s.slope_y * s.slope_y);
            const Floats og = local.z + s.slope_x * local.x + s.slope_y * local.y;
            const Floats q = twice_c * og;
            const Vector i{q * (n.x + s.slope_x * t.x + s.slope_y * b.x) - o.x,
                           q * (n.y + s.slope_x * t.y + s.slope_y * b.y) - o.y,
                           q * (n.z + s.slope_x * t.z + s.slope_y * b.z) - o.z};
            const Floats weight = s.weight * lanes::most(q - local.z, Floats{});
            aim_sample(&aims_[2 * k], i, weight, s.texel_factor * area, og);
        }
    }

    void aim_sample(Aims* aims, Vector i, Floats weight, Floats texel_term, Floats og) const {
        const Floats ax = lanes::absolute(i.x), ay = lanes::absolute(i.y), az = lanes::absolute(i.z);
        const Ints is_y = ay >= ax;
        const Floats side = is_y ? ay : ax;
        const Ints is_z = az >= side;
        const Floats largest = is_z ? az : side;
        const Floats axis = is_z ? i.z : (is_y ? i.y : i.x);
        const Floats positive_og = lanes::most(og, Floats{} + 1e-6f);
        const Floats inverse = 1.0f / (largest * positive_og); // one division for 1/largest and 1/og
        const Floats inverse_largest = inverse * positive_og;
        const Floats u = (is_z || is_y ? i.x : i.z) * inverse_largest;
        const Floats v = (is_z ? i.y : (is_y ? i.z : i.y)) * inverse_largest;
        const Ints face =
            (is_z ? Ints{} + 4 : (is_y ? Ints{} + 2 : Ints{})) + (lanes::as_ints(axis) >> 31 & 1);

        const Floats texels = texel_term * inverse;
        const Floats level =
            lanes::least(0.5f * lanes::log2(lanes::most(texels, Floats{} + 1.0f)), Floats{} + last_level_);
        const Ints fine = lanes::truncate(level);
        const Floats coarse_share = level - lanes::to_floats(fine);
        const Ints last = Ints{} + int32_t(header_.last_level);
        aim_level(aims[0], u, v, face, fine, weight * (1.0f - coarse_share));
        aim_level(aims[1], u, v, face, fine < last ? fine + 1 : last, weight * coarse_share);
    }

    void aim_level(Aims& aims, Floats u, Floats v, Ints face, Ints level, Floats weight) const {
        const Floats size = lanes::as_floats(size_bits_ - (level << 23));
        const Floats half = 0.5f * size;
        const Floats x = u * half + (half + 0.5f), y = v * half + (half + 0.5f);
        const Ints column = lanes::truncate(x), row = lanes::truncate(y);
        const Floats fx = x - lanes::to_floats(column), fy = y - lanes::to_floats(row);
        const Ints s = lanes::truncate(size), pitch = s + 1;
        // Pairs of the levels before: 6 (n + 1)(n + 2) each, halving, in closed form.
        const int32_t n = 1 << header_.last_level;
        const Ints before = n * (8 * n + 36) - s * (8 * s + 36) + 12 * level;
        const Ints at = before + (face * (pitch + 1) + row) * pitch + column;
        aims.above = at * int32_t(sizeof(Pair));
        aims.below = (at + pitch) * int32_t(sizeof(Pair));
        const Floats below = weight * fy, above = weight - below;
        const Floats right_above = above * fx, right_below = below * fx;
        interleave(aims.weights, above - right_above, right_above, below - right_below, right_below);
    }

    /// Writes a[k] b[k] c[k] d[k] for every lane k.
    static void interleave(float (*out)[4], Floats a, Floats b, Floats c, Floats d) {
        Ints low, high;
        for (int k = 0; k < LANES; ++k) {
            low[k] = k / 2 + (k & 1) * LANES;
            high[k] = low[k] + LANES / 2;
        }
        const Floats ac_low = __builtin_shuffle(a, c, low), ac_high = __builtin_shuffle(a, c, high);
        const Floats bd_low = __builtin_shuffle(b, d, low), bd_high = __builtin_shuffle(b, d, high);
        const Floats parts[4] = {
            __builtin_shuffle(ac_low, bd_low, low), __builtin_shuffle(ac_low, bd_low, high),
            __builtin_shuffle(ac_high, bd_high, low), __builtin_shuffle(ac_high, bd_high, high)};
        std::memcpy(out, parts, sizeof parts);
    }

    void load(int lane, float* pixel) const {
        const char* pairs = reinterpret_cast<const char*>(input_.pairs.data());
#ifdef __AVX512F__
        const __m512i places = _mm512_set_epi32(3, 2, 3, 2, 3, 2, 3, 2, 1, 0, 1, 0, 1, 0, 1, 0);
        __m512 sums[2] = {_mm512_setzero_ps(), _mm512_setzero_ps()};
        for (size_t k = 0; k < aims_.size(); k += 2)
            for (size_t j = 0; j < 2; ++j) {
                const Aims& aims = aims_[k + j];
                const __m128i above = load_pair(pairs + uint32_t(aims.above[lane]));
                const __m256i both = _mm256_inserti128_si256(
                    _mm256_castsi128_si256(above), load_pair(pairs + uint32_t(aims.below[lane])), 1);
                const __m512 weights =
                    _mm512_permutevar_ps(_mm512_broadcast_f32x4(_mm_load_ps(aims.weights[lane])), places);
                sums[j] = _mm512_fmadd_ps(_mm512_cvtph_ps(both), weights, sums[j]);
            }
        const __m512 sum = _mm512_add_ps(sums[0], sums[1]);
        const __m256 rows = _mm256_add_ps(_mm512_castps512_ps256(sum), _mm512_extractf32x8_ps(sum, 1));
#else
        const __m256i places_above = _mm256_set_epi32(1, 0, 1, 0, 1, 0, 1, 0);
        const __m256i places_below = _mm256_set_epi32(3, 2, 3, 2, 3, 2, 3, 2);
        __m256 sums[2] = {_mm256_setzero_ps(), _mm256_setzero_ps()};
        for (const Aims& aims : aims_) {
            const __m256 weights = _mm256_broadcast_ps(reinterpret_cast<const __m128*>(aims.weights[lane]));
            const __m256 above = _mm256_cvtph_ps(load_pair(pairs + uint32_t(aims.above[lane])));
            const __m256 below = _mm256_cvtph_ps(load_pair(pairs + uint32_t(aims.below[lane])));
            sums[0] = _mm256_fmadd_ps(above, _mm256_permutevar_ps(weights, places_above), sums[0]);
            sums[1] = _mm256_fmadd_ps(below, _mm256_permutevar_ps(weights, places_below), sums[1]);
        }
        const __m256 rows = _mm256_add_ps(sums[0], sums[1]);
#endif
        const __m128 red_green = _mm256_castps256_ps128(rows), blue = _mm256_extractf128_ps(rows, 1);
        const __m128 sum_rgb = _mm_hadd_ps(red_green, blue);
        _mm_storeu_ps(pixel, _mm_insert_ps(sum_rgb, _mm_set_ss(1.0f), 0x30));
    }

    static __m128i load_pair(const char* at) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(at));
    }

    const Input& input_;
    const Header& header_;
    std::vector<Aims> aims_;
    float last_level_;
    int32_t size_bits_;
};

struct Milliseconds {
    double wall, all_threads;
};

Milliseconds shade(const Input& input, std::vector<float>& picture, unsigned thread_count) {
    const auto began = std::chrono::steady_clock::now();
    const std::clock_t threads_began = std::clock();
    std::atomic<uint32_t> next_band{0};
    const auto work = [&] {
        Shader shader(input);
        for (;;) {
            const uint32_t begin = BAND_ROWS * next_band++;
            if (begin >= input.header.height) return;
            for (uint32_t y = begin; y < std::min(begin + BAND_ROWS, input.header.height); ++y)
                shader.shade_row(y, &picture[size_t(4) * y * input.header.width]);
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned k = 1; k < thread_count; ++k)
        threads.emplace_back(work);
    work();
    threads.clear();
    const double all_threads = 1e3 * double(std::clock() - threads_began) / CLOCKS_PER_SEC;
    return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count(),
            all_threads};
}

} // namespace

int main(int count, char** arguments) try {
    if (count < 4) throw std::runtime_error("usage: shading_loop INPUT THREADS RUNS [PICTURE]");
    const Input input = read_input(arguments[1]);
    std::vector<float> picture(size_t(4) * input.header.width * input.header.height);
    const unsigned threads = unsigned(std::stoul(arguments[2]));
    shade(input, picture, threads); // a warm-up: pages, caches, clocks
    for (unsigned long run = std::stoul(arguments[3]); run > 0; --run) {
        const Milliseconds times = shade(input, picture, threads);
        std::printf("%.4f %.4f\n", times.wall, times.all_threads);
    }
    if (count > 4)
        std::ofstream(arguments[4], std::ios::binary)
            .write(reinterpret_cast<const char*>(picture.data()),
                   std::streamsize(picture.size() * sizeof(float)));
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::fprintf(stderr, "shading_loop: %s\n", error.what());
    return EXIT_FAILURE;
}
