#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "burnish/light/environment.h"
#include "interpreter.h"
#include "numpy.h"

namespace burnish {

namespace {

// None, degrees about +y (counter-clockwise seen from above), or a matrix as an array or nested lists.
glm::mat3 matrix_from(const py::object& rotation) {
    if (rotation.is_none()) {
        return glm::mat3(1.0f);
    }
    const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(rotation);
    if (!values) {
        PyErr_Clear();
    }
    if (values && values.ndim() == 0) {
        const double degrees = *values.data();
        if (!std::isfinite(degrees)) {
            throw std::invalid_argument(message("rotation: expected finite degrees about y, got ", degrees));
        }
        const double angle = degrees * std::numbers::pi / 180.0;
        const auto c = static_cast<float>(std::cos(angle));
        const auto s = static_cast<float>(std::sin(angle));
        return glm::mat3(c, 0, -s, 0, 1, 0, s, 0, c); // columns
    }
    if (!values || values.ndim() != 2 || values.shape(0) != 3 || values.shape(1) != 3) {
        throw std::invalid_argument(
            message("rotation: expected None, degrees about y or a (3, 3) array, got ",
                    std::string(py::repr(rotation))));
    }
    glm::mat3 matrix;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            matrix[column][row] = static_cast<float>(values.at(row, column));
        }
    }
    const glm::mat3 residue = glm::transpose(matrix) * matrix - glm::mat3(1.0f);
    const float error = std::max({glm::length(residue[0]), glm::length(residue[1]), glm::length(residue[2])});
    if (!(error < 1e-4f)) { // also refuses NaN
        throw std::invalid_argument(
            message("rotation: expected orthonormal columns, got columns off by ", error));
    }
    return matrix;
}

float checked_exposure(double exposure) {
    if (!(std::abs(exposure) <= 64.0)) {
        throw std::invalid_argument(message("exposure: expected stops in -64..64, got ", exposure));
    }
    return static_cast<float>(exposure);
}

std::shared_ptr<Environment> finish(Environment environment, double exposure, const py::object& rotation) {
    environment.exposure = checked_exposure(exposure);
    environment.rotation = matrix_from(rotation);
    return std::make_shared<Environment>(std::move(environment));
}

std::shared_ptr<Environment> environment_from_faces(const py::array& faces, double exposure,
                                                    const py::object& rotation) {
    const auto checked = require_array<float>(faces, "faces", {6, any, any, 3});
    if (checked.shape(1) != checked.shape(2)) {
        throw std::invalid_argument(
            message("faces: expected square faces, got ", checked.shape(1), " x ", checked.shape(2)));
    }
    const py::ssize_t size = checked.shape(1);
    require_face_size(static_cast<uint32_t>(std::min<py::ssize_t>(size, UINT32_MAX)));
    std::vector<float> radiance(checked.data(), checked.data() + checked.size());
    return finish(Environment::from_faces(static_cast<uint32_t>(size), std::move(radiance)), exposure,
                  rotation);
}

std::shared_ptr<Environment> environment_from_lat_long(const py::array& img, int64_t face_size,
                                                       double exposure, const py::object& rotation,
                                                       bool border_samples) {
    const auto checked = require_array<float>(img, "img", {any, any, 3});
    require_face_size(static_cast<uint32_t>(std::clamp<int64_t>(face_size, 0, UINT32_MAX)));
    const std::vector<float> radiance(checked.data(), checked.data() + checked.size());
    const auto height = static_cast<uint32_t>(checked.shape(0));
    const auto width = static_cast<uint32_t>(checked.shape(1));
    const LatLongGrid grid = border_samples ? LatLongGrid::samples : LatLongGrid::bands;
    Environment environment = [&] {
        const Released release;
        return Environment::from_lat_long(height, width, radiance, static_cast<uint32_t>(face_size), grid);
    }();
    return finish(std::move(environment), exposure, rotation);
}

py::array_t<float> faces_of(const Environment& environment) {
    const auto size = static_cast<py::ssize_t>(environment.face_size());
    return make_array<float>(environment.radiance(), {6, size, size, 3});
}

py::array_t<float> rotation_of(const Environment& environment) {
    py::array_t<float> rows(std::array<py::ssize_t, 2>{3, 3});
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            rows.mutable_at(row, column) = environment.rotation[column][row];
        }
    }
    return rows;
}

void bind_texel_report(py::module_& m) {
    py::class_<TexelReport>(m, "TexelReport",
                            R"(What was wrong with the texels of an environment, and was put right.

A texel counts once, under its worst fault in the order NaN, infinite, negative. ``str()`` gives one sentence, empty when
nothing was wrong.)")
        .def_readonly("negative", &TexelReport::negative, "Texels with a negative channel, set to 0.")
        .def_readonly("not_a_number", &TexelReport::not_a_number, "Texels with a NaN channel, set to 0.")
        .def_readonly("infinite", &TexelReport::infinite,
                      "Texels with an infinite channel, set to 65504, or to 0 if negative.")
        .def_readonly("above_half", &TexelReport::above_half,
                      "Texels with a finite channel above 65504: no fault, `half_range` makes room for them.")
        .def_readonly("largest", &TexelReport::largest, "Largest finite value given, before any repair.")
        .def_property_readonly("count", &TexelReport::count, "Texels repaired, of all kinds.")
        .def("__str__", &TexelReport::sentence)
        .def("__repr__", [](const TexelReport& report) {
            return message("TexelReport(negative=", report.negative, ", not_a_number=", report.not_a_number,
                           ", infinite=", report.infinite, ", above_half=", report.above_half,
                           ", largest=", report.largest, ")");
        });
}

void bind_half_range(py::module_& m) {
    py::class_<HalfRange>(m, "HalfRange",
                          R"(How half floats hold the texels of an environment, however bright or dim it is.

They hold radiance / 2**exponent, which is exact: light times a power of two gives the picture times that. ``str()`` gives
one sentence, empty when all of the map is held.)")
        .def_readonly("exponent", &HalfRange::exponent, "0 where that suffices: 2**0 = 1.")
        .def_readonly(
            "faint_texels", &HalfRange::faint_texels,
            "Texels with a channel over 2**30 times darker than the brightest, too faint to be held with "
            "all bits beside it.")
        .def_readonly("faint_sphere", &HalfRange::faint_sphere, "Share of the sphere that they cover, 0..1.")
        .def_readonly("lost_light", &HalfRange::lost_light,
                      "Share of the map's light that their rounding changes, 0..1.")
        .def("__str__", &HalfRange::sentence)
        .def("__repr__", [](const HalfRange& range) {
            return message("HalfRange(exponent=", range.exponent, ", faint_texels=", range.faint_texels,
                           ", faint_sphere=", range.faint_sphere, ", lost_light=", range.lost_light, ")");
        });
}

} // namespace

void bind_environment(py::module_& m) {
    bind_texel_report(m);
    bind_half_range(m);

    py::class_<Environment, std::shared_ptr<Environment>>(
        m, "Environment", R"(Distant light: six square faces of linear radiance.

Faces are in Vulkan's order, +X -X +Y -Y +Z -Z, right-handed with y up. Texel (row, column) of a face of N x N texels has
u = (2 column + 1)/N - 1 and v = (2 row + 1)/N - 1 and looks along (1, -v, -u), (-1, -v, u), (u, 1, v), (u, -1, -v),
(u, -v, 1), (-u, -v, -1) in that order. Made by `from_faces`, `from_lat_long` or `from_file`.)")
        .def_static("from_faces", &environment_from_faces, py::arg("faces"), py::arg("exposure") = 0.0,
                    py::arg("rotation") = py::none(), R"(An environment from its cube faces.

Parameters
----------
faces : (6, n, n, 3) float32
    Linear radiance, C-contiguous; n is a power of two in 1..2048. Copied.
exposure : float
    Stops; the radiance is multiplied by 2**exposure when it is looked up.
rotation : None, float or (3, 3) array
    Turns the map in the world: degrees about +y, or the matrix world_from_environment.

Returns
-------
environment : Environment
    Its `texel_report` counts texels that were negative, NaN or infinite.

Raises
------
ValueError
    If `faces` has another type, shape or layout: nothing is cast silently.)")
        .def_static("from_lat_long", &environment_from_lat_long, py::arg("img"), py::arg("face_size") = 512,
                    py::arg("exposure") = 0.0, py::arg("rotation") = py::none(),
                    py::arg("border_samples") = false,
                    R"(An environment from a latitude-longitude map, resampled by exact area.

Parameters
----------
img : (h, w, 3) float32
    Linear radiance, C-contiguous. Top row latitude +90 degrees; left edge longitude +180 falling to -180 at the right;
    longitude 0, in the middle, is +z, longitude +90 is +x.
face_size : int
    A power of two in 1..2048. About w/4 keeps the resolution of the map.
exposure : float
    Stops; the radiance is multiplied by 2**exposure when it is looked up.
rotation : None, float or (3, 3) array
    Turns the map in the world: degrees about +y, or the matrix world_from_environment.
border_samples : bool
    False: texels are bands of equal angle that end at the poles and at +-180 degrees. True: the centres of the outer
    texels lie there, as in OpenEXR's environment maps.

Returns
-------
environment : Environment
    Each texel holds the mean radiance over its solid angle, so the energy of every light is kept.

Raises
------
ValueError
    If `img` has another type, shape or layout: nothing is cast silently.)")
        .def_property_readonly("faces", &faces_of,
                               "(6, n, n, 3) float32: a new array of the radiance, repaired.")
        .def_property_readonly("face_size", &Environment::face_size, "Edge of a face in texels.")
        .def_property(
            "rotation", &rotation_of,
            [](Environment& environment, const py::object& rotation) {
                environment.rotation = matrix_from(rotation);
            },
            "(3, 3) float32: world_from_environment. May be set to degrees about +y, to an array, or to "
            "None.")
        .def_property(
            "exposure", [](const Environment& environment) { return environment.exposure; },
            [](Environment& environment, double exposure) {
                environment.exposure = checked_exposure(exposure);
            },
            "Stops: the radiance is multiplied by 2**exposure when it is looked up.")
        .def_readwrite("name", &Environment::name,
                       "Shown in reports; the file's name for environments from files.")
        .def_readwrite("notes", &Environment::notes, "List of str: what was done to the map on its way here.")
        .def_property_readonly("texel_report", &Environment::texel_report, "TexelReport: what was repaired.")
        .def_property_readonly("half_range", &Environment::half_range,
                               "HalfRange: how half floats hold it on the device.")
        .def("__repr__", [](const Environment& environment) {
            return message("Environment(name='", environment.name, "', face_size=", environment.face_size(),
                           ", exposure=", environment.exposure,
                           ", repaired_texels=", environment.texel_report().count(), ")");
        });
}

} // namespace burnish
