// Devices. A Python Device is a renderer with its device: what one frame leaves behind, the next can use.
#include <memory>
#include <optional>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "burnish/render/lookup_probe.h"
#include "burnish/render/lookup_record.h"
#include "burnish/render/renderer.h"
#include "burnish/vulkan/memory.h"
#include "interpreter.h"

namespace py = pybind11;

namespace burnish {
namespace {

constexpr int64_t least_memory_bytes = int64_t{1} << 20; // what it keeps for itself fits into that

std::string version_text(uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

py::dict limits_of(const vulkan::Device& device) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    py::dict result;
    result["max_image_dimension_2d"] = limits.maxImageDimension2D;
    result["max_image_dimension_cube"] = limits.maxImageDimensionCube;
    result["max_image_array_layers"] = limits.maxImageArrayLayers;
    result["max_texel_buffer_elements"] = limits.maxTexelBufferElements;
    result["max_storage_buffer_bytes"] = limits.maxStorageBufferRange;
    result["sub_pixel_bits"] = limits.subPixelPrecisionBits;
    result["max_push_constant_bytes"] = limits.maxPushConstantsSize;
    result["max_allocation_bytes"] = device.features().max_allocation_bytes;
    result["timestamp_period_ns"] = device.features().timestamp_period_ns;
    return result;
}

py::dict features_of(const vulkan::Device& device) {
    const vulkan::DeviceFeatures& features = device.features();
    py::dict result;
    result["timestamps"] = features.timestamps;
    result["multiview"] = features.multiview;
    result["shader_float16"] = features.shader_float16;
    result["shader_int16"] = features.shader_int16;
    result["sampler_anisotropy"] = features.sampler_anisotropy;
    result["subgroup_size"] = features.subgroup_size;
    result["validation"] = device.validates();
    return result;
}

std::optional<py::dict> measurement_of(const LookupChoice& lookup) {
    if (!lookup.measured) return std::nullopt;
    py::dict result;
    result["sampler_ms"] = lookup.measured->sampler_ms;
    result["software_ms"] = lookup.measured->software_ms;
    result["ratio"] = lookup.measured->ratio();
    result["date"] = lookup.measured->date;
    result["kept_in"] = lookup.measured->kept_in;
    return result;
}

/// Callers of earlier versions chose what a picture does while its pipeline is compiled.
void check_compile(const std::optional<std::string>& compile) {
    if (!compile) return;
    if (*compile != "wait" && *compile != "background" && *compile != "shared")
        throw std::invalid_argument(
            message("compile: expected wait, background or shared, got '", *compile, "'"));
    if (PyErr_WarnEx(PyExc_DeprecationWarning,
                     "compile has no effect: pipelines do not depend on a lobe's roughness", 1) != 0)
        throw py::error_already_set();
}

size_t checked_budget(int64_t budget) {
    if (budget < 1)
        throw std::invalid_argument(message("pipeline_budget: expected 1 or more pipelines, got ", budget));
    return size_t(budget);
}

int64_t pipelines_from_environment() {
    const char* const text = std::getenv("BURNISH_PIPELINES");
    if (!text || !*text) return render::DEFAULT_PIPELINE_BUDGET;
    char* end = nullptr;
    const long long value = std::strtoll(text, &end, 10);
    if (*end != 0 || value < 1)
        throw std::invalid_argument(
            message("BURNISH_PIPELINES: expected a number of pipelines, 1 or more, got '", text, "'"));
    return value;
}

std::shared_ptr<render::Renderer> open_device(const std::string& name, std::optional<bool> validation,
                                              const std::string& lookup,
                                              std::optional<int64_t> memory_limit_bytes,
                                              const std::optional<std::string>& compile,
                                              std::optional<int64_t> pipeline_budget) {
    check_compile(compile);
    const Released release;
    vulkan::DeviceSettings settings;
    settings.name = name;
    if (memory_limit_bytes && *memory_limit_bytes < least_memory_bytes)
        throw std::invalid_argument(message("memory_limit_bytes: expected None or at least ",
                                            least_memory_bytes, ", got ", *memory_limit_bytes));
    if (memory_limit_bytes) settings.memory_limit_bytes = static_cast<VkDeviceSize>(*memory_limit_bytes);
    if (validation) settings.validation = *validation;
    render::RendererSettings renderer{map_lookup(lookup)};
    renderer.pipeline_budget = checked_budget(pipeline_budget.value_or(pipelines_from_environment()));
    const char* from_environment = std::getenv("BURNISH_LOOKUP");
    if (!renderer.lookup && from_environment && *from_environment)
        renderer.lookup = map_lookup(from_environment);
    const std::shared_ptr<vulkan::Device> device = vulkan::Device::create(settings);
    // A driver that compiles for minutes is spared; SwiftShader's sampler shows wrong pictures besides.
    if (!renderer.lookup && device->info().is_software && !device->info().compiles_slowly)
        renderer.measured = render::find_lookup_measurement(*device);
    return render::Renderer::open(device, renderer);
}

} // namespace

void bind_vulkan(py::module_& m) {
    rest_at_interpreter_exit();
    py::class_<vulkan::DeviceInfo>(m, "DeviceInfo", "A Vulkan device of this machine, usable or not.")
        .def_readonly("name", &vulkan::DeviceInfo::name, "As the driver gives it.")
        .def_readonly("driver", &vulkan::DeviceInfo::driver, "Name and version of the driver.")
        .def_readonly("is_software", &vulkan::DeviceInfo::is_software, "True for a CPU.")
        .def_property_readonly(
            "api_version", [](const vulkan::DeviceInfo& info) { return version_text(info.api_version); },
            "Vulkan version, \"1.3.230\".")
        .def_readonly("refusals", &vulkan::DeviceInfo::refusals,
                      "Why it cannot be used, a sentence each; empty = it can.")
        .def("__repr__", [](const vulkan::DeviceInfo& info) {
            return "DeviceInfo('" + info.name + "', '" + info.driver + "')";
        });

    m.def("cache_folder", &render::cache_folder,
          "Path of what the engine keeps for later processes, which may be deleted at any time: the "
          "environment "
          "variable BURNISH_CACHE, else $XDG_CACHE_HOME/burnish, else ~/.cache/burnish. None where "
          "BURNISH_CACHE "
          "is \"off\", or no folder is known.");

    m.def("list_devices", &vulkan::list_devices, py::call_guard<Released>(),
          "All Vulkan devices, with the reasons why some cannot be used. Raises VulkanError if there is no "
          "driver.");

    py::class_<render::Renderer, std::shared_ptr<render::Renderer>>(m, "Device", R"(A Vulkan device, opened.

It keeps pipelines, scenes and maps from frame to frame. Several threads may use it: their calls take turns, and
each gets what it would alone; a scene must not be changed while another thread draws it. Several processes may open
devices on one GPU or CPU. A process that was forked must open its own.

Parameters
----------
name : str
    Part of the device's name, any case, such as "llvmpipe"; "" takes the best: a discrete GPU before an integrated
    one before a virtual one before a CPU.
validation : bool or None
    Validation layer with synchronization validation; its errors are raised. None: the environment variable
    BURNISH_VALIDATION.
lookup : str
    How maps are read: "sampler", by the device's own; "software", by ours, exact to float32. "auto": the environment
    variable BURNISH_LOOKUP, else "sampler" on a GPU; on a CPU "software", unless its driver takes more than 1.1 times as
    long for that. The first process on a driver measures it, some 50 ms (200 ms where the driver has to compile), and
    keeps it for later ones in the folder BURNISH_CACHE, else $XDG_CACHE_HOME/burnish, else ~/.cache/burnish;
    with BURNISH_CACHE=off every process measures.
memory_limit_bytes : int or None
    Most memory that it takes from the driver, 2**20 or more; what needs more is refused. None: as much as the driver
    gives, which on a CPU may be more than the machine has to spare.
compile : str or None
    Deprecated, "wait", "background" or "shared": has no effect, pipelines do not depend on a lobe's roughness.
pipeline_budget : int or None
    Pipelines that it keeps for later pictures, 1 or more; those used longest ago go first, never one that the last
    picture used. On a CPU each holds 7 MB (Regular) to 35 MB (Matched). None: the environment variable
    BURNISH_PIPELINES, else 16.

Raises
------
VulkanError
    If no device fits; the message lists every device with the reason.)")
        .def(py::init(&open_device), py::arg("name") = "", py::arg("validation") = py::none(),
             py::arg("lookup") = "auto", py::arg("memory_limit_bytes") = py::none(),
             py::arg("compile") = py::none(), py::arg("pipeline_budget") = py::none())
        .def_property_readonly(
            "name", [](const render::Renderer& self) { return self.device()->info().name; },
            "As the driver gives it.")
        .def_property_readonly(
            "driver", [](const render::Renderer& self) { return self.device()->info().driver; },
            "Name and version of the driver.")
        .def_property_readonly(
            "is_software", [](const render::Renderer& self) { return self.device()->info().is_software; },
            "True for a CPU.")
        .def_property_readonly(
            "lookup", [](const render::Renderer& self) { return map_lookup_name(self.lookup().wanted); },
            "How maps are read: \"sampler\" or \"software\".")
        .def_property_readonly(
            "lookup_reason", [](const render::Renderer& self) { return self.lookup().reason; },
            "Why they are read that way, a sentence.")
        .def_property_readonly(
            "lookup_measurement", [](const render::Renderer& self) { return measurement_of(self.lookup()); },
            R"(dict or None: what "auto" decided by on a CPU.

Milliseconds of all threads, `sampler_ms` and `software_ms`, for the same lookups by either; their `ratio`, software to
sampler; `date` (UTC); and `kept_in`, the file that later processes read it from, "" where it could not be kept.)")
        .def_property_readonly(
            "compile", [](const render::Renderer&) { return "shared"; },
            "\"shared\", whatever was asked for: pipelines do not depend on a lobe's roughness.")
        .def_property(
            "pipeline_budget", &render::Renderer::pipeline_budget,
            [](render::Renderer& self, int64_t budget) { self.set_pipeline_budget(checked_budget(budget)); },
            "Pipelines that it keeps for later pictures; a new value holds from the next one on.")
        .def_property_readonly("pipeline_count", &render::Renderer::pipeline_count,
                               "Pipelines that it keeps now.")
        .def(
            "finish_compiling", [](const render::Renderer&) {},
            "Has no effect: nothing is compiled in the background.")
        .def_property_readonly(
            "is_lost", [](const render::Renderer& self) { return self.device()->is_lost(); },
            "True once the driver gave the device up; then all calls raise VulkanError, and a new Device is "
            "needed.")
        .def_property_readonly(
            "api_version",
            [](const render::Renderer& self) { return version_text(self.device()->info().api_version); },
            "Vulkan version, \"1.3.230\".")
        .def_property_readonly(
            "limits", [](const render::Renderer& self) { return limits_of(*self.device()); },
            "dict: sizes the device can take.")
        .def_property_readonly(
            "features", [](const render::Renderer& self) { return features_of(*self.device()); },
            "dict: optional abilities.")
        .def(
            "memory_statistics",
            [](const render::Renderer& self) {
                const vulkan::MemoryStatistics statistics = self.device()->memory_statistics();
                py::dict result;
                result["blocks"] = statistics.blocks;
                result["bytes_reserved"] = statistics.reserved_bytes;
                result["bytes_used"] = statistics.used_bytes;
                result["allocations"] = statistics.allocations;
                return result;
            },
            "dict: blocks and bytes taken from the driver, bytes and allocations in use.")
        .def(
            "validation_messages",
            [](const render::Renderer& self) { return self.device()->validation_messages(); },
            "Warnings and errors of the validation layer so far.")
        .def("__repr__",
             [](const render::Renderer& self) { return "Device('" + self.device()->info().name + "')"; });
}

} // namespace burnish
