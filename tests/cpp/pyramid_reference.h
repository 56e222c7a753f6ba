// The pyramid's definition in float64, written for clarity and apart from the engine's.
#pragma once

#include "burnish/light/environment.h"
#include "burnish/light/pyramid_filter.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <glm/gtc/packing.hpp>

namespace burnish {

using Faces = std::vector<float>; // (face, row, column, channel), 6 n n 3

inline float& texel(Faces& faces, uint32_t size, uint32_t face, uint32_t row, uint32_t column,
                    uint32_t channel) {
    return faces[((size_t{face} * size + row) * size + column) * 3 + channel];
}

inline double half_of(float value) {
    return double(glm::unpackHalf1x16(glm::packHalf1x16(value)));
}

// Distance of neighbouring halves around a value.
inline double half_spacing(double value) {
    return std::ldexp(1.0, std::max(std::ilogb(std::max(std::abs(value), 1e-30)), -14) - 10);
}

// The filter's definition, written for clarity: a texel beyond an edge is a point of the face's plane, beyond
// the cube's edge; turned by 90 degrees about that edge it lies on the neighbouring face.
class DirectFilter {
public:
    DirectFilter(const Faces& faces, uint32_t size) : faces_(faces), size_(size) {}

    glm::dvec3 reduced(uint32_t face, int row, int column, const std::vector<double>& taps) const {
        const int reach = int(taps.size()) / 2 - 1;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < int(taps.size()); ++i) {
            for (int j = 0; j < int(taps.size()); ++j) {
                sum += taps[size_t(i)] * taps[size_t(j)] *
                       read(face, 2 * row + i - reach, 2 * column + j - reach);
            }
        }
        return sum;
    }

private:
    glm::dvec3 read(uint32_t face, int row, int column) const {
        const double u = (2.0 * column + 1.0) / size_ - 1.0;
        const double v = (2.0 * row + 1.0) / size_ - 1.0;
        const glm::dvec3 center = cube_direction(face, 0.0f, 0.0f);
        const glm::dvec3 right = glm::round(glm::dvec3(cube_direction(face, 1.0f, 0.0f)) - 0.5 * center);
        const glm::dvec3 down = glm::round(glm::dvec3(cube_direction(face, 0.0f, 1.0f)) - 0.5 * center);
        const glm::dvec3 point = center + u * right + v * down;
        const int major = axis_of(center), first = axis_of(right), second = axis_of(down);
        const glm::dvec3 one = turned(turned(point, major, first), first, second);
        const glm::dvec3 other = turned(turned(point, major, second), second, first);
        const bool is_corner = std::abs(u) > 1.0 && std::abs(v) > 1.0;
        return is_corner ? 0.5 * (at(one) + at(other)) : at(std::abs(u) > 1.0 ? one : other);
    }

    static int axis_of(const glm::dvec3& d) { return d.x != 0.0 ? 0 : d.y != 0.0 ? 1 : 2; }

    // About the edge between the planes of two axes, if the point lies beyond it.
    static glm::dvec3 turned(glm::dvec3 point, int from_axis, int to_axis) {
        const double beyond = std::abs(point[to_axis]) - 1.0;
        if (beyond <= 0.0) return point;
        point[to_axis] = std::copysign(1.0, point[to_axis]);
        point[from_axis] -= std::copysign(beyond, point[from_axis]);
        return point;
    }

    glm::dvec3 at(const glm::dvec3& point) const {
        float u = 0.0f, v = 0.0f;
        const uint32_t face = cube_face(point, u, v);
        const auto column = uint32_t((u + 1.0f) / 2.0f * float(size_));
        const auto row = uint32_t((v + 1.0f) / 2.0f * float(size_));
        const float* rgb = &faces_[((size_t{face} * size_ + row) * size_ + column) * 3];
        return {rgb[0], rgb[1], rgb[2]};
    }

    const Faces& faces_;
    uint32_t size_;
};

inline std::vector<double> taps_of(PyramidFilter filter) {
    switch (filter) {
    case PyramidFilter::box:
        return {0.5, 0.5};
    case PyramidFilter::gauss4:
        return {0.125, 0.375, 0.375, 0.125};
    default:
        return {0.03125, 0.15625, 0.3125, 0.3125, 0.15625, 0.03125};
    }
}

// Halves over the whole range, subnormal ones and the largest among them; mostly of moderate size.
inline Faces random_faces(uint32_t size, uint32_t seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> exponent(-2.0f, 2.0f);
    std::uniform_int_distribution<int> kind(0, 99);
    Faces faces(size_t{6} * size * size * 3);
    for (float& value : faces) {
        const int k = kind(generator);
        const float moderate = std::exp2(exponent(generator));
        value = k == 0 ? 65504.0f : k == 1 ? 0.0f : k < 4 ? moderate * 1e-6f : moderate;
        value = float(half_of(value));
    }
    return faces;
}

} // namespace burnish
