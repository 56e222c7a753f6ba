// Direct lights: values that do not change once made.
#include "burnish/light/direct_light.h"
#include "scene_values.h"

namespace burnish {
namespace {

PointLight make_point(const Place& position, const Color& intensity, float radius,
                      std::optional<float> range) {
    PointLight light{dvec3_of(position), vec3_of(intensity), radius, range};
    validate(light);
    return light;
}

DirectionalLight make_directional(const Place& direction, const Color& irradiance, float angle) {
    DirectionalLight light{dvec3_of(direction), vec3_of(irradiance), angle};
    validate(light);
    return light;
}

SpotLight make_spot(const Place& position, const Place& direction, const Color& intensity, float inner_angle,
                    float outer_angle, float radius, std::optional<float> range) {
    SpotLight light{{dvec3_of(position), vec3_of(intensity), radius, range},
                    dvec3_of(direction),
                    inner_angle,
                    outer_angle};
    validate(light);
    return light;
}

} // namespace

void bind_lights(py::module_& m) {
    py::class_<PointLight>(m, "PointLight",
                           R"(A sphere that radiates evenly, or a point. It does not change once made.

At a distance d of its middle it gives an irradiance of intensity/d^2 across its way, at the sphere's surface and
inside that of the surface.

Parameters
----------
position : (3,) floats
    World frame.
intensity : float or (float, float, float)
    W/sr, >= 0.
radius : float
    >= 0. Lobes are as wide as the sphere is seen; of a point, a highlight is as narrow as its lobe.
range : float or None
    Where the light ends, above the radius: times max(1 - (d/range)^4, 0). It costs nothing beyond. None: nowhere.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_point), py::arg("position"), py::arg("intensity") = Color(1.0f),
             py::arg("radius") = 0.0f, py::arg("range") = py::none())
        .def_property_readonly(
            "position", [](const PointLight& x) { return tuple_of(x.position); }, "(float, float, float).")
        .def_property_readonly(
            "intensity", [](const PointLight& x) { return tuple_of(x.intensity); },
            "(float, float, float), W/sr.")
        .def_readonly("radius", &PointLight::radius, "Of the sphere.")
        .def_readonly("range", &PointLight::range, "Where it ends, or None.")
        .def("__repr__", [](const PointLight& x) {
            return message("PointLight(position=(", x.position.x, ", ", x.position.y, ", ", x.position.z,
                           "))");
        });
    py::class_<DirectionalLight>(m, "DirectionalLight", R"(Light from far away. It does not change once made.

Parameters
----------
direction : (3,) floats
    World frame: where the light goes, of any length but 0.
irradiance : float or (float, float, float)
    Across its way, >= 0.
angle : float
    That the disc is seen under, radians, from 0 to below pi. The sun's is .0093.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_directional), py::arg("direction"), py::arg("irradiance") = Color(1.0f),
             py::arg("angle") = 0.0f)
        .def_property_readonly(
            "direction", [](const DirectionalLight& x) { return tuple_of(x.direction); },
            "(float, float, float): where the light goes.")
        .def_property_readonly(
            "irradiance", [](const DirectionalLight& x) { return tuple_of(x.irradiance); },
            "(float, float, float), across its way.")
        .def_readonly("angle", &DirectionalLight::angle, "That its disc is seen under, radians.")
        .def("__repr__", [](const DirectionalLight& x) {
            return message("DirectionalLight(direction=(", x.direction.x, ", ", x.direction.y, ", ",
                           x.direction.z, "))");
        });
    py::class_<SpotLight>(m, "SpotLight",
                          R"(A point light that shines into a cone. It does not change once made.

Its light is that of a `PointLight` times clamp((cos - cos outer)/(cos inner - cos outer), 0, 1)^2, cos that of the
angle to its axis, as KHR_lights_punctual says.

Parameters
----------
position : (3,) floats
    World frame.
direction : (3,) floats
    Where it shines, of any length but 0.
intensity : float or (float, float, float)
    W/sr, >= 0, along the axis.
inner_angle, outer_angle : float
    From the axis, radians: full light up to the one, none from the other on; 0 <= inner <= outer <= pi/2.
radius, range : float
    As of `PointLight`.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_spot), py::arg("position"), py::arg("direction"),
             py::arg("intensity") = Color(1.0f), py::arg("inner_angle") = 0.0f,
             py::arg("outer_angle") = 0.785398163f, py::arg("radius") = 0.0f, py::arg("range") = py::none())
        .def_property_readonly(
            "position", [](const SpotLight& x) { return tuple_of(x.light.position); },
            "(float, float, float).")
        .def_property_readonly(
            "direction", [](const SpotLight& x) { return tuple_of(x.direction); },
            "(float, float, float): where it shines.")
        .def_property_readonly(
            "intensity", [](const SpotLight& x) { return tuple_of(x.light.intensity); },
            "(float, float, float), W/sr along the axis.")
        .def_readonly("inner_angle", &SpotLight::inner_angle, "Radians.")
        .def_readonly("outer_angle", &SpotLight::outer_angle, "Radians.")
        .def_property_readonly(
            "radius", [](const SpotLight& x) { return x.light.radius; }, "Of the sphere.")
        .def_property_readonly(
            "range", [](const SpotLight& x) { return x.light.range; }, "Where it ends, or None.")
        .def("__repr__", [](const SpotLight& x) {
            return message("SpotLight(position=(", x.light.position.x, ", ", x.light.position.y, ", ",
                           x.light.position.z, "))");
        });
}

} // namespace burnish
