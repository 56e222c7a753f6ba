// What shading_loop reads, in the order of the file: scripts/benchmark/hand_loop.py writes it.
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lanes.h"

constexpr uint32_t MOST_SAMPLES = 64, LAST_LEVEL_AT_MOST = 12;

struct Header {
    uint32_t width, height, last_level, sample_count;
    float ray_corner[3], ray_dx[3], ray_dy[3];
};

/// As in the engine's SampleTable: slopes of the half-vector, weight, texel factor.
struct Sample {
    float slope_x, slope_y, weight, texel_factor;
};

/// Two texels side by side as halves: r r', g g', b b', and a pair that is not used.
struct alignas(16) Pair {
    uint16_t halves[8];
};

struct Input {
    Header header;
    std::vector<Sample> samples;
    std::vector<uint32_t> normals; // octahedral, two snorm16
    std::vector<Pair> pairs;
};

template <typename T>
void read_all(std::ifstream& file, T* begin, size_t count) {
    file.read(reinterpret_cast<char*>(begin), std::streamsize(count * sizeof(T)));
    if (!file) throw std::runtime_error("INPUT: expected as much data as its header says, got less");
}

inline Input read_input(const char* path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(std::string("INPUT: expected a file that can be read, got ") + path);
    Input input;
    read_all(file, &input.header, 1);
    const Header& header = input.header;
    if (header.width % lanes::COUNT || header.sample_count < 1 || header.sample_count > MOST_SAMPLES ||
        header.last_level > LAST_LEVEL_AT_MOST)
        throw std::runtime_error(
            "INPUT: expected a width of whole vectors, 1..64 samples and faces of at most 4096, got others");
    input.samples.resize(header.sample_count);
    input.normals.resize(size_t(header.width) * header.height);
    size_t pairs = 0;
    for (uint32_t level = 0; level <= header.last_level; ++level) {
        const size_t size = size_t(1) << level;
        pairs += 6 * (size + 1) * (size + 2);
    }
    input.pairs.resize(pairs);
    read_all(file, input.samples.data(), input.samples.size());
    read_all(file, input.normals.data(), input.normals.size());
    read_all(file, input.pairs.data(), input.pairs.size());
    return input;
}
