// The extension module burnish._core. Order only: a type comes before what mentions it.
#include <cstring>

#include <pybind11/gil_safe_call_once.h>
#include <pybind11/pybind11.h>

#include "burnish/error.h"

namespace py = pybind11;

namespace burnish {
void bind_vulkan(py::module_& m);
void bind_environment(py::module_& m);
void bind_pictures(py::module_& m);
void bind_scene(py::module_& m);
void bind_sampler(py::module_& m);
void bind_render(py::module_& m);
void bind_maps(py::module_& m);
void bind_shared(py::module_& m);
void bind_probe(py::module_& m);
} // namespace burnish

namespace {

/// The message may quote bytes of a file that are not UTF-8: Python sees them as \xNN. Handed over as they
/// are, they would empty the whole message.
void register_file_error(py::module_& m) {
    PYBIND11_CONSTINIT static py::gil_safe_call_once_and_store<py::object> type;
    type.call_once_and_store_result(
        [&]() -> py::object { return py::exception<burnish::FileError>(m, "FileError", PyExc_OSError); });
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const burnish::FileError& error) {
            const auto size = static_cast<Py_ssize_t>(std::strlen(error.what()));
            PyObject* text = PyUnicode_DecodeUTF8(error.what(), size, "backslashreplace");
            if (text) py::set_error(type.get_stored(), py::reinterpret_steal<py::object>(text));
        }
    });
}

} // namespace

PYBIND11_MODULE(_core, m) {
    m.doc() = "The compiled part of burnish; use the names of the package instead.";
    m.attr("__version__") = BURNISH_VERSION;
    register_file_error(m);
    py::register_exception<burnish::VulkanError>(m, "VulkanError", PyExc_RuntimeError);
    burnish::bind_vulkan(m);
    burnish::bind_environment(m);
    burnish::bind_pictures(m);
    burnish::bind_scene(m);
    burnish::bind_sampler(m);
    burnish::bind_render(m);
    burnish::bind_maps(m);
    burnish::bind_shared(m);
    burnish::bind_probe(m);
}
