// Python numbers and arrays to GLM vectors and matrices, for the scene's bindings.
#pragma once

#include <array>
#include <string>
#include <variant>

#include <glm/glm.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "burnish/error.h"
#include "burnish/scene/material.h"
#include "numpy.h"

namespace burnish {

using Pair = std::variant<float, std::array<float, 2>>;  ///< one number stands for both
using Color = std::variant<float, std::array<float, 3>>; ///< one number stands for all three
using Triple = std::array<float, 3>;

inline glm::vec2 vec2_of(const Pair& pair) {
    if (const float* both = std::get_if<float>(&pair)) return glm::vec2(*both);
    const auto& [x, y] = std::get<1>(pair);
    return {x, y};
}

inline glm::vec3 vec3_of(const Triple& triple) {
    return {triple[0], triple[1], triple[2]};
}
inline glm::vec3 vec3_of(const Color& color) {
    if (const float* all = std::get_if<float>(&color)) return glm::vec3(*all);
    return vec3_of(std::get<1>(color));
}

inline py::tuple tuple_of(const glm::vec2& v) {
    return py::make_tuple(v.x, v.y);
}
inline py::tuple tuple_of(const glm::vec3& v) {
    return py::make_tuple(v.x, v.y, v.z);
}

using Place = std::array<double, 3>; ///< a point of the world
inline glm::dvec3 dvec3_of(const Place& place) {
    return {place[0], place[1], place[2]};
}
inline py::tuple tuple_of(const glm::dvec3& v) {
    return py::make_tuple(v.x, v.y, v.z);
}

/// (4, 4) numbers, m[row][column] as written on paper: the last column is the translation.
inline glm::dmat4 dmat4_of(const py::object& object, const char* name) {
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(object);
    if (!array) {
        PyErr_Clear();
        throw std::invalid_argument(message(name, ": expected numbers of shape (4, 4), got ",
                                            std::string(py::str(py::type::of(object)))));
    }
    if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4)
        throw std::invalid_argument(message(name, ": expected numbers of shape (4, 4), got shape ",
                                            shape_text({array.shape(), array.shape() + array.ndim()})));
    glm::dmat4 matrix;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            matrix[column][row] = array.at(row, column);
    return matrix;
}

inline py::array_t<double> array_of(const glm::dmat4& matrix) {
    std::vector<double> rows;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            rows.push_back(matrix[column][row]);
    return make_array(std::move(rows), {4, 4});
}

/// Vertex data as a new (n, components) array; None where there is none.
template <typename Vector>
py::object array_of(const std::vector<Vector>& vectors) {
    if (vectors.empty()) return py::none();
    constexpr py::ssize_t COMPONENTS = sizeof(Vector) / sizeof(float);
    const float* first = reinterpret_cast<const float*>(vectors.data());
    return make_array(std::vector<float>(first, first + vectors.size() * COMPONENTS),
                      {static_cast<py::ssize_t>(vectors.size()), COMPONENTS});
}

/// Throws std::invalid_argument for a name that is none.
inline MaterialModel material_model_of(const std::string& name) {
    if (name == "ggx") return MaterialModel::ggx;
    if (name == "kurt") return MaterialModel::kurt;
    throw std::invalid_argument(message("model: expected 'ggx' or 'kurt', got '", name, "'"));
}

/// Binds what follows, Material and Camera.
void bind_scene_parts(py::module_& m);
void bind_lobes(py::module_& m);
void bind_lights(py::module_& m);
void bind_mesh(py::module_& m);

} // namespace burnish
