// Single shader functions, for tests.
#include <span>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "burnish/render/probe.h"
#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/validation.h"
#include "interpreter.h"
#include "numpy.h"
#include "shared/probe.h"

namespace burnish {
namespace {

py::array_t<float> probe(const render::Renderer& renderer, const std::string& library, uint32_t function,
                         const py::array& arguments) {
    const auto checked = require_array<float>(arguments, "arguments", {any, any, 4});
    std::vector<float> results;
    {
        const Released release;
        const std::span<const float> values(checked.data(), static_cast<size_t>(checked.size()));
        results = render::run_probe(renderer.device(), library, function, values,
                                    static_cast<uint32_t>(checked.shape(1)));
    }
    return make_array(std::move(results), {checked.shape(0), shared::PROBE_RESULTS, 4});
}

} // namespace

void bind_probe(py::module_& m) {
    m.def(
        "inject_fault",
        [](const render::Renderer& renderer, const std::string& call, int result, uint32_t skip,
           uint32_t times) {
            renderer.device()->inject_fault(call, static_cast<VkResult>(result), skip, times);
        },
        py::arg("device"), py::arg("call"), py::arg("result"), py::arg("skip") = 0, py::arg("times") = 1,
        R"(Let a Vulkan call fail; for tests of what no driver can be made to do. Takes the place of an earlier one.

Parameters
----------
device : Device
call : str
    "vkQueueSubmit2", "vkAllocateMemory", "vkCreateComputePipelines", "vkCreateGraphicsPipelines", or "vkFreeMemory" for
    all memory that is left when the device is closed.
result : int
    The VkResult that it returns, without being made.
skip : int
    Calls that go well before.
times : int
    Calls that fail then.)");
    m.def("closing_messages", &vulkan::closing_messages,
          "What the validation layer said while devices were closed, its hints on speed left out.");
    m.def("exit_on_closing_messages", &vulkan::exit_on_closing_messages,
          "From now on such a message ends the process with exit code 1; for tests, whose last devices are "
          "closed when none "
          "is left to fail.");
    m.def("probe", &probe, py::arg("device"), py::arg("library"), py::arg("function"), py::arg("arguments"),
          R"(Run one function of the shader library over a list of items; for tests.

Parameters
----------
device : Device
library : str
    File of glsl/lib, without its ending.
function : int
    Number of the function in glsl/shared/probe.h.
arguments : (n, k, 4) float32, k in 1..16
    Integers go in as the floats of the same bits.

Returns
-------
results : (n, 3, 4) float32
    What the function leaves unwritten is 0.)");
}

} // namespace burnish
