// The extension module burnish._core. Order only: a type comes before what mentions it.
#include <pybind11/pybind11.h>

#include "burnish/error.h"

namespace py = pybind11;

namespace burnish {
void bind_vulkan(py::module_& m);
void bind_environment(py::module_& m);
void bind_scene(py::module_& m);
void bind_sampling(py::module_& m);
void bind_render(py::module_& m);
void bind_maps(py::module_& m);
void bind_shared(py::module_& m);
void bind_probe(py::module_& m);
} // namespace burnish

PYBIND11_MODULE(_core, m) {
    m.doc() = "The compiled part of burnish; use the names of the package instead.";
    m.attr("__version__") = BURNISH_VERSION;
    py::register_exception<burnish::FileError>(m, "FileError", PyExc_OSError);
    py::register_exception<burnish::VulkanError>(m, "VulkanError", PyExc_RuntimeError);
    burnish::bind_vulkan(m);
    burnish::bind_environment(m);
    burnish::bind_scene(m);
    burnish::bind_sampling(m);
    burnish::bind_render(m);
    burnish::bind_maps(m);
    burnish::bind_shared(m);
    burnish::bind_probe(m);
}
