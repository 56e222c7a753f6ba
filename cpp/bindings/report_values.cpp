#include "report_values.h"

#include <pybind11/stl.h>

#include "burnish/error.h"
#include "burnish/plan/effects.h"

namespace py = pybind11;

namespace burnish {
namespace {

py::list stopped_list(const render::Report& report) {
    py::list result;
    for (const render::StoppedValues& one : report.stopped) {
        py::object first = py::int_(one.first);
        if (report.width) first = py::make_tuple(one.first / report.width, one.first % report.width);
        result.append(
            py::dict(py::arg("pass") = one.pass, py::arg("count") = one.count, py::arg("first") = first));
    }
    return result;
}

} // namespace

py::list effects_list(const std::vector<EffectLine>& effects) {
    py::list result;
    for (const EffectLine& line : effects)
        result.append(py::dict(py::arg("name") = line.name, py::arg("on") = line.is_on,
                               py::arg("reason") = line.reason));
    return result;
}

py::dict values_dict(const Variant& variant) {
    py::dict result;
    for (const EffectValue& one : effect_values(variant))
        result[one.name] = one.value;
    return result;
}

py::dict report_dict(const render::Report& report) {
    py::list passes, classes;
    for (const vulkan::PassTime& pass : report.passes)
        passes.append(py::dict(py::arg("name") = pass.name, py::arg("kind") = pass.kind,
                               py::arg("milliseconds") = pass.milliseconds));
    std::string used;
    for (const render::ClassReport& one : report.classes) {
        classes.append(py::dict(py::arg("effects") = effect_names(one.variant),
                                py::arg("values") = values_dict(one.variant), py::arg("table") = one.table,
                                py::arg("samples") = one.samples, py::arg("reason") = one.reason));
        if (!one.samples.empty() && used.find(one.samples) == std::string::npos)
            used += (used.empty() ? "" : ", ") + one.samples;
    }
    if (report.reference_samples)
        used = message(report.reference_samples, " (standard error ", report.standard_error, ")");
    else if (report.sampler == "reference")
        used = "every texel";
    py::dict result;
    result["version"] = BURNISH_VERSION;
    result["device"] =
        py::dict(py::arg("name") = report.device_name, py::arg("driver") = report.device_driver,
                 py::arg("is_software") = report.is_software);
    result["size"] = py::make_tuple(report.height, report.width);
    result["spp"] = report.spp;
    result["filter"] = report.filter;
    result["sampler"] = py::dict(py::arg("name") = report.sampler.substr(0, report.sampler.find(':')),
                                 py::arg("requested") = report.sampler, py::arg("used") = used);
    result["passes"] = passes;
    result["compile_ms"] = report.compile_ms;
    result["prepare_ms"] = report.prepare_ms;
    result["wall_ms"] = report.wall_ms;
    result["effects"] = effects_list(report.effects);
    result["classes"] = classes;
    result["triangles"] = report.triangles;
    result["uploads"] =
        py::dict(py::arg("meshes") = report.uploads.meshes, py::arg("textures") = report.uploads.textures,
                 py::arg("maps") = report.uploads.maps);
    result["stopped"] = stopped_list(report);
    result["diffuse_error"] = report.diffuse_error;
    result["standard_error"] = report.standard_error;
    std::vector<std::string> warnings = report.warnings;
    warnings.insert(warnings.end(), report.problems.begin(), report.problems.end());
    result["warnings"] = warnings;
    result["ignored_extensions"] = report.ignored_extensions;
    return result;
}

} // namespace burnish
