// Range checks with the project's message: "name: expected rule, got value".
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/glm.hpp>

#include "burnish/error.h"

namespace burnish {

/// Throws std::invalid_argument unless low <= value <= high; NaN fails.
inline void require_range(const std::string& name, float value, float low, float high) {
    if (!(value >= low && value <= high))
        throw std::invalid_argument(message(name, ": expected ", low, "..", high, ", got ", value));
}

/// Throws std::invalid_argument unless every component is in [0, 1].
inline void require_unit(const std::string& name, const glm::vec3& value) {
    for (int channel = 0; channel < 3; ++channel)
        require_range(name, value[channel], 0.0f, 1.0f);
}

/// Throws std::invalid_argument unless every component is finite and >= 0.
inline void require_non_negative(const std::string& name, const glm::vec3& value) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(value[axis] >= 0.0f) || !std::isfinite(value[axis]))
            throw std::invalid_argument(message(name, ": expected finite numbers >= 0, got ", value[axis]));
}

/// Throws std::invalid_argument unless the number is finite and > 0.
inline void require_positive(const std::string& name, float value) {
    if (!(value > 0.0f) || !std::isfinite(value))
        throw std::invalid_argument(message(name, ": expected a finite number > 0, got ", value));
}

/// Throws std::invalid_argument unless the number is finite.
inline void require_finite(const std::string& name, float value) {
    if (!std::isfinite(value))
        throw std::invalid_argument(message(name, ": expected a finite number, got ", value));
}

inline bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_finite(const glm::vec2& v) {
    return std::isfinite(v.x) && std::isfinite(v.y);
}
inline bool is_finite(const glm::vec4& v) {
    return is_finite(glm::vec3(v)) && std::isfinite(v.w);
}
inline bool is_finite(const glm::mat4& m) {
    return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]) && is_finite(m[3]);
}

} // namespace burnish
