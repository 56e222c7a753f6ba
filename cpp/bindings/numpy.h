// Arrays between numpy and C++: checked on the way in, never cast or copied behind the caller's back, new and
// owned on the way out.
#pragma once

#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "burnish/error.h"

namespace burnish {

namespace py = pybind11;

/// In a shape: any length. Shown as "n".
constexpr py::ssize_t any = -1;

inline std::string shape_text(const std::vector<py::ssize_t>& shape) {
    std::string text = "(";
    for (size_t i = 0; i < shape.size(); ++i) {
        text += (i > 0 ? ", " : "") + (shape[i] == any ? std::string("n") : std::to_string(shape[i]));
    }
    return text + (shape.size() == 1 ? ",)" : ")");
}

/// The array itself, seen as T. Throws std::invalid_argument unless it is C-contiguous, of type T and of that
/// shape.
template <typename T>
py::array_t<T, py::array::c_style> require_array(const py::array& array, const char* name,
                                                 std::initializer_list<py::ssize_t> shape) {
    const std::vector<py::ssize_t> expected(shape);
    const std::vector<py::ssize_t> actual(array.shape(), array.shape() + array.ndim());
    bool fits = actual.size() == expected.size();
    for (size_t i = 0; fits && i < expected.size(); ++i) {
        fits = expected[i] == any || expected[i] == actual[i];
    }
    const bool is_contiguous = (array.flags() & py::array::c_style) != 0;
    // Unpickled arrays have a type object of their own: types are compared, not objects.
    const bool has_type = py::array_t<T, 0>::check_(array);
    if (!fits || !is_contiguous || !has_type) {
        throw std::invalid_argument(
            message(name, ": expected C-contiguous ", std::string(py::str(py::dtype::of<T>())), " of shape ",
                    shape_text(expected), ", got ", is_contiguous ? "" : "non-contiguous ",
                    std::string(py::str(array.dtype())), " of shape ", shape_text(actual)));
    }
    return py::reinterpret_borrow<py::array_t<T, py::array::c_style>>(array);
}

/// A numpy array that takes over the vector, without a copy.
template <typename T>
py::array_t<T> make_array(std::vector<T> values, const std::vector<py::ssize_t>& shape) {
    auto owner = std::make_unique<std::vector<T>>(std::move(values));
    const T* data = owner->data();
    const py::capsule free_owner(owner.release(),
                                 [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
    return py::array_t<T>(shape, data, free_owner);
}

} // namespace burnish
