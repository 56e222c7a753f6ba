// Environments made by code, for tests.
#pragma once

#include "burnish/light/environment.h"

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace burnish {

/// With the radiance of each texel's middle.
inline std::shared_ptr<const Environment>
environment_of(uint32_t face_size, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    std::vector<float> faces;
    for (uint32_t face = 0; face < 6; ++face) {
        for (uint32_t row = 0; row < face_size; ++row) {
            for (uint32_t column = 0; column < face_size; ++column) {
                const double u = (2.0 * column + 1.0) / face_size - 1.0;
                const double v = (2.0 * row + 1.0) / face_size - 1.0;
                const glm::dvec3 color = radiance(glm::dvec3(cube_direction(face, float(u), float(v))));
                for (int k = 0; k < 3; ++k)
                    faces.push_back(float(color[k]));
            }
        }
    }
    return std::make_shared<const Environment>(Environment::from_faces(face_size, std::move(faces)));
}

inline std::shared_ptr<const Environment> random_environment(uint32_t face_size, uint32_t seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> exponent(-12.0f, 9.0f);
    std::vector<float> faces(size_t{6} * face_size * face_size * 3);
    for (float& value : faces)
        value = std::exp2(exponent(generator));
    return std::make_shared<const Environment>(Environment::from_faces(face_size, std::move(faces)));
}

} // namespace burnish
