// Frames, shaded points, captured maps and plans.
#include <limits>
#include <optional>

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "burnish/plan/effects.h"
#include "burnish/render/capture.h"
#include "burnish/render/renderer.h"
#include "interpreter.h"
#include "numpy.h"
#include "report_values.h"
#include "scene_values.h"

namespace burnish {
namespace {

using ProgressFunction = std::function<void(double, const std::string&)>;

/// Tells Python how far the work is, and lets Ctrl-C end it. Called without the interpreter's lock.
render::Progress interruptible(const std::optional<ProgressFunction>& progress) {
    return [&progress](double fraction, const std::string& text) {
        stop_where_interpreter_ends();
        {
            const Held held;
            if (progress) (*progress)(fraction, text);
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        }
        stop_where_interpreter_ends();
    };
}

PlanSettings plan_settings(const Sampler& sampler, int64_t spp, const std::string& filter) {
    if (spp < 1 || spp > 65536) throw std::invalid_argument(message("spp: expected 1..65536, got ", spp));
    PlanSettings settings;
    settings.sampler = sampler;
    settings.spp = uint32_t(spp);
    settings.filter = pyramid_filter(filter);
    return settings;
}

py::dict plan_dict(const Scene& scene, const Sampler& sampler, int64_t spp, const std::string& filter,
                   bool is_software, std::optional<float> display_exposure, const render::Renderer* device) {
    SunCache suns;
    PlanSettings settings = plan_settings(sampler, spp, filter);
    settings.display_exposure = display_exposure;
    constexpr uint64_t no_limit = std::numeric_limits<uint64_t>::max();
    settings.lookup = device ? device->lookup() : choose_lookup(is_software, {}, no_limit, no_limit);
    const Plan plan = make_plan(scene, settings, suns);
    py::list passes, classes;
    for (const PassLine& line : plan.passes)
        passes.append(py::dict(py::arg("name") = line.name(), py::arg("kind") = pass_name(line.kind),
                               py::arg("reason") = line.reason));
    for (const ShadeClass& one : plan.classes) {
        classes.append(py::dict(
            py::arg("effects") = effect_names(one.variant), py::arg("values") = values_dict(one.variant),
            py::arg("table") = render::table_name(one.table), py::arg("reason") = one.reason));
    }
    py::dict result;
    result["passes"] = passes;
    result["effects"] = effects_list(plan.effects);
    result["classes"] = classes;
    result["warnings"] = plan.warnings;
    return result;
}

std::vector<py::ssize_t> picture_shape(const render::Frame& frame, py::ssize_t channels) {
    std::vector<py::ssize_t> shape = {py::ssize_t(frame.height), py::ssize_t(frame.width)};
    if (channels > 1) shape.push_back(channels);
    return shape;
}

using FramePointer = std::shared_ptr<render::Frame>;

/// Channels of the frame's pixels from `first` on, without a copy: they live as long as the array.
py::array_t<float> view_channels(const FramePointer& frame, py::ssize_t first, py::ssize_t channels) {
    const std::span<const glm::vec4> pixels = frame->radiance();
    const py::ssize_t pixel_bytes = sizeof(glm::vec4), channel_bytes = sizeof(float);
    std::vector<py::ssize_t> strides = {pixel_bytes * frame->width, pixel_bytes};
    if (channels > 1) strides.push_back(channel_bytes);
    return {picture_shape(*frame, channels), strides, reinterpret_cast<const float*>(pixels.data()) + first,
            py::cast(frame)};
}

/// Pixels of display output, without a copy: they live as long as the array.
py::array_t<uint8_t> view_display(const FramePointer& frame) {
    if (!frame->has_display)
        throw std::invalid_argument("display: expected a frame of display output, got one of linear output");
    return py::array_t<uint8_t>(picture_shape(*frame, 4),
                                reinterpret_cast<const uint8_t*>(frame->display().data()), py::cast(frame));
}

py::array_t<double> position_of(render::Frame& frame) {
    const std::vector<glm::dvec3> positions = frame.positions();
    std::vector<double> values(positions.size() * 3);
    std::memcpy(values.data(), positions.data(), values.size() * sizeof(double));
    return make_array(std::move(values), picture_shape(frame, 3));
}

py::array_t<float> normal_of(render::Frame& frame) {
    const std::vector<glm::vec3> normals = frame.normals();
    std::vector<float> values(normals.size() * 3);
    std::memcpy(values.data(), normals.data(), values.size() * sizeof(float));
    return make_array(std::move(values), picture_shape(frame, 3));
}

/// In strict mode nothing comes back where a value was stopped.
void raise_if_stopped(const render::Report& report) {
    if (report.stopped.empty()) return;
    std::string text;
    for (const render::StoppedValues& one : report.stopped)
        text += (text.empty() ? "" : "; ") + one.sentence;
    PyErr_SetString(PyExc_FloatingPointError, text.c_str());
    throw py::error_already_set();
}

std::span<const glm::vec3> directions(const py::array_t<float, py::array::c_style>& array) {
    return {reinterpret_cast<const glm::vec3*>(array.data()), size_t(array.shape(0))};
}

py::tuple shade_points(render::Renderer& renderer, const std::shared_ptr<Environment>& environment,
                       const Material& material, const Sampler& sampler, const py::array& normals,
                       const py::array& tangents, const py::array& views, const std::string& filter,
                       bool is_strict, bool wants_report, const std::optional<py::array>& positions,
                       const Scene* scene) {
    const auto normal_array = require_array<float>(normals, "normals", {any, 3});
    const auto tangent_array = require_array<float>(tangents, "tangents", {any, 3});
    const auto view_array = require_array<float>(views, "views", {any, 3});
    render::ShadePoints points{directions(normal_array), directions(tangent_array), directions(view_array)};
    py::array_t<double, py::array::c_style | py::array::forcecast> places;
    if (positions) {
        places = *positions;
        points.positions = {reinterpret_cast<const glm::dvec3*>(places.data()), size_t(places.shape(0))};
    }
    if (scene) points.lights = &scene->lights;
    const PlanSettings settings = plan_settings(sampler, 1, filter);
    std::vector<glm::vec3> radiance;
    render::Report report;
    {
        const Released release;
        radiance = renderer.shade(environment, material, points, settings, &report, interruptible({}));
    }
    if (is_strict) raise_if_stopped(report);
    std::vector<float> values(radiance.size() * 3);
    std::memcpy(values.data(), radiance.data(), values.size() * sizeof(float));
    return py::make_tuple(make_array(std::move(values), {py::ssize_t(radiance.size()), 3}), report.problems,
                          wants_report ? py::object(report_dict(report)) : py::none());
}

std::shared_ptr<render::Frame> render_scene(render::Renderer& renderer, const Scene& scene,
                                            const Camera* camera, uint32_t height, uint32_t width,
                                            const Sampler& sampler, int64_t spp, const std::string& filter,
                                            const std::optional<ProgressFunction>& progress, bool is_strict,
                                            std::optional<float> display_exposure) {
    render::RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.plan = plan_settings(sampler, spp, filter);
    settings.plan.display_exposure = display_exposure;
    settings.progress = interruptible(progress);
    FramePointer frame;
    {
        const Released release;
        frame = std::make_shared<render::Frame>(
            renderer.render(scene, camera ? *camera : scene.default_camera(), settings));
    }
    if (is_strict) raise_if_stopped(frame->report);
    return frame;
}

} // namespace

void bind_render(py::module_& m) {
    py::class_<render::Frame, std::shared_ptr<render::Frame>>(m, "FrameData",
                                                              "Pictures of one frame, made when asked for.")
        .def_property_readonly(
            "color", [](const FramePointer& frame) { return view_channels(frame, 0, 3); },
            "(h, w, 3) float32, linear radiance; a view of four channels side by side.")
        .def_property_readonly(
            "alpha", [](const FramePointer& frame) { return view_channels(frame, 3, 1); },
            "(h, w) float32, coverage by objects; a view of the same.")
        .def_property_readonly("display", &view_display,
                               "(h, w, 4) uint8, sRGB and coverage, of display output; a view.")
        .def_property_readonly(
            "depth", [](render::Frame& frame) { return make_array(frame.depth(), picture_shape(frame, 1)); },
            "(h, w) float32, distance along the camera's axis; infinity where nothing is.")
        .def_property_readonly(
            "position", &position_of,
            "(h, w, 3) float64, where the pixels' rays meet objects, in the world; NaN where "
            "nothing is.")
        .def_property_readonly("normal", &normal_of, "(h, w, 3) float32, world space; 0 where nothing is.")
        .def_property_readonly(
            "report", [](const render::Frame& frame) { return report_dict(frame.report); },
            "dict: what it cost.");

    m.def("render", &render_scene, py::arg("device"), py::arg("scene"), py::arg("camera").none(true),
          py::arg("height"), py::arg("width"), py::arg("sampler"), py::arg("spp"), py::arg("filter"),
          py::arg("progress").none(true), py::arg("is_strict") = false,
          py::arg("display_exposure").none(true) = py::none(),
          "Render one frame; burnish.render documents the arguments.");
    m.def("shade", &shade_points, py::arg("device"), py::arg("environment"), py::arg("material"),
          py::arg("sampler"), py::arg("normals"), py::arg("tangents"), py::arg("views"), py::arg("filter"),
          py::arg("is_strict") = false, py::arg("wants_report") = false,
          py::arg("positions").none(true) = py::none(), py::arg("scene").none(true) = py::none(),
          "(radiance, problems, report or None) of points; burnish.shade documents the arguments.");
    m.def(
        "time_lookups",
        [](render::Renderer& renderer, const std::shared_ptr<Environment>& environment,
           const Regular& sampler, float roughness,
           uint32_t repeats) { return renderer.time_lookups(environment, sampler, roughness, repeats); },
        py::arg("device"), py::arg("environment"), py::arg("sampler"), py::arg("roughness"),
        py::arg("repeats"),
        "List of milliseconds: the lookups of a 1920x1080 picture and nothing else, for benchmarks.");
    m.def(
        "time_shading",
        [](render::Renderer& renderer, const Scene& scene, const Camera& camera, const Sampler& sampler,
           bool has_lookups, bool is_written_out) {
            render::RenderSettings settings;
            settings.width = 1920;
            settings.height = 1080;
            settings.plan.sampler = sampler;
            settings.plan.has_lookups = has_lookups;
            if (!is_written_out) settings.plan.sample_loop = SampleLoop::loop;
            return report_dict(renderer.render(scene, camera, settings).report);
        },
        py::arg("device"), py::arg("scene"), py::arg("camera"), py::arg("sampler"), py::arg("has_lookups"),
        py::arg("is_written_out") = true,
        "dict: the report of a 1920x1080 frame, for benchmarks. Its lookups may be left out, and its samples "
        "taken in a loop.");
    m.def(
        "plan", &plan_dict, py::arg("scene"), py::arg("sampler"), py::arg("spp"), py::arg("filter"),
        py::arg("is_software"), py::arg("display_exposure").none(true) = py::none(),
        py::arg("device").none(true) = py::none(),
        "dict: passes, effects and shade classes with their reasons; nothing is rendered. A device tells its "
        "own lookup, is_software that of an unknown one.");
    m.def(
        "capture",
        [](render::Renderer& renderer, const Scene& scene, const Place& point, uint32_t face_size,
           std::optional<uint32_t> without_object) {
            const Released release;
            return render::capture(renderer, scene, dvec3_of(point), face_size, without_object);
        },
        py::arg("device"), py::arg("scene"), py::arg("point"), py::arg("face_size"),
        py::arg("without_object").none(true),
        "Environment seen from a point; Scene.capture documents the arguments.");
}

} // namespace burnish
