// Levels of maps as lookups see them, and what making them costs.
#include <memory>
#include <optional>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "burnish/render/renderer.h"
#include "burnish/sampler/prefilter_table.h"
#include "interpreter.h"
#include "numpy.h"

namespace burnish {
namespace {

using EnvironmentPointer = std::shared_ptr<Environment>;
using Levels = std::vector<std::vector<float>>;

/// Without a kernel the pyramid itself.
Levels make_levels(render::Renderer& renderer, const EnvironmentPointer& environment,
                   const std::string& filter, std::optional<PrefilterKernel> kernel,
                   std::vector<vulkan::PassTime>* times = nullptr) {
    const PyramidFilter chosen = pyramid_filter(filter);
    const Released release;
    return kernel ? renderer.prefiltered(*kernel, environment, chosen, times)
                  : renderer.pyramid(environment, chosen, times);
}

py::list levels_list(uint32_t face_size, Levels levels) {
    py::list result;
    py::ssize_t size = face_size;
    for (std::vector<float>& level : levels) {
        result.append(make_array(std::move(level), {6, size, size, 3}));
        size /= 2;
    }
    return result;
}

py::list pyramid_levels(render::Renderer& renderer, const EnvironmentPointer& environment,
                        const std::string& filter) {
    return levels_list(environment->face_size(), make_levels(renderer, environment, filter, {}));
}

py::list spherical_levels(render::Renderer& renderer, const EnvironmentPointer& environment,
                          const std::string& filter) {
    return levels_list(environment->face_size(),
                       make_levels(renderer, environment, filter, PrefilterKernel::spherical));
}

py::list prefiltered_levels(render::Renderer& renderer, const EnvironmentPointer& environment,
                            const std::string& filter) {
    const py::list levels = levels_list(environment->face_size(),
                                        make_levels(renderer, environment, filter, PrefilterKernel::lobe));
    py::list result;
    uint32_t size = environment->face_size();
    for (const py::handle level : levels) {
        result.append(py::make_tuple(result.empty() ? 0.0f : prefiltered_roughness(size), level));
        size /= 2;
    }
    return result;
}

py::list level_times(render::Renderer& renderer, const EnvironmentPointer& environment,
                     const std::string& filter, std::optional<PrefilterKernel> kernel) {
    std::vector<vulkan::PassTime> times;
    make_levels(renderer, environment, filter, kernel, &times);
    py::list result;
    for (const vulkan::PassTime& time : times)
        result.append(py::make_tuple(time.name, time.milliseconds));
    return result;
}

py::list pyramid_times(render::Renderer& renderer, const EnvironmentPointer& environment,
                       const std::string& filter) {
    return level_times(renderer, environment, filter, {});
}

py::list prefilter_times(render::Renderer& renderer, const EnvironmentPointer& environment,
                         const std::string& filter, bool is_spherical) {
    return level_times(renderer, environment, filter,
                       is_spherical ? PrefilterKernel::spherical : PrefilterKernel::lobe);
}

} // namespace

void bind_maps(py::module_& m) {
    m.def("environment_pyramid", &pyramid_levels, py::arg("device"), py::arg("environment"),
          py::arg("filter"),
          "List of (6, n, n, 3) float32, finest first, as lookups see them: rounded to half.");
    m.def(
        "environment_prefiltered", &prefiltered_levels, py::arg("device"), py::arg("environment"),
        py::arg("filter"),
        "List of (roughness, (6, n, n, 3) float32), finest first, as the sampler Prefiltered looks them up.");
    m.def("environment_spherical", &spherical_levels, py::arg("device"), py::arg("environment"),
          py::arg("filter"),
          "List of (6, n, n, 3) float32, finest first, as the sampler Matched looks them up.");
    m.def("prefilter_times", &prefilter_times, py::arg("device"), py::arg("environment"), py::arg("filter"),
          py::arg("is_spherical") = false,
          "List of (pass, milliseconds) of making one prefiltered map, for benchmarks.");
    m.def("pyramid_times", &pyramid_times, py::arg("device"), py::arg("environment"), py::arg("filter"),
          "List of (pass, milliseconds) of making one map's pyramid, for benchmarks.");
    m.def(
        "time_blits",
        [](render::Renderer& renderer, const EnvironmentPointer& environment) {
            return renderer.time_blits(environment);
        },
        py::arg("device"), py::arg("environment"),
        "Milliseconds of making one map's levels by the device's blits, not seamless; for benchmarks.");
}

} // namespace burnish
