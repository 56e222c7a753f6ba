// Lobes: values that do not change once made, so that no copy can go stale unseen.
#include "burnish/lobe/lobe.h"
#include "scene_values.h"

namespace burnish {
namespace {

KurtLobe make_kurt_lobe(const Pair& roughness, const Color& r0, float alpha, const Color& weight,
                        float rotation, bool conserve_energy) {
    KurtLobe lobe{vec2_of(roughness), vec3_of(r0), alpha, vec3_of(weight), rotation, conserve_energy};
    validate(lobe);
    return lobe;
}

std::string repr(const KurtLobe& lobe) {
    return message("KurtLobe(roughness=(", lobe.roughness.x, ", ", lobe.roughness.y, "), r0=(", lobe.r0.x,
                   ", ", lobe.r0.y, ", ", lobe.r0.z, "), alpha=", lobe.alpha, ", weight=(", lobe.weight.x,
                   ", ", lobe.weight.y, ", ", lobe.weight.z, "), rotation=", lobe.rotation,
                   ", conserve_energy=", lobe.conserve_energy ? "True" : "False", ")");
}

GgxLobe make_ggx_lobe(const Pair& roughness, const Color& r0, const Color& f90, const Color& weight,
                      float rotation, const std::string& compensate) {
    if (compensate != "none" && compensate != "scale")
        throw std::invalid_argument(
            message("compensate: expected 'none' or 'scale', got '", compensate, "'"));
    GgxLobe lobe{vec2_of(roughness), vec3_of(r0), vec3_of(f90),
                 vec3_of(weight),    rotation,    compensate == "scale"};
    validate(lobe);
    return lobe;
}

const char* compensate_of(const GgxLobe& lobe) {
    return lobe.compensates ? "scale" : "none";
}

std::string repr(const GgxLobe& lobe) {
    return message("GgxLobe(roughness=(", lobe.roughness.x, ", ", lobe.roughness.y, "), r0=(", lobe.r0.x,
                   ", ", lobe.r0.y, ", ", lobe.r0.z, "), f90=(", lobe.f90.x, ", ", lobe.f90.y, ", ",
                   lobe.f90.z, "), weight=(", lobe.weight.x, ", ", lobe.weight.y, ", ", lobe.weight.z,
                   "), rotation=", lobe.rotation, ", compensate='", compensate_of(lobe), "')");
}

void bind_kurt_lobe(py::module_& m) {
    py::class_<KurtLobe>(m, "KurtLobe",
                         R"(One glossy lobe after Kurt et al. 2010. It does not change once made.

f = weight F(u) D / (4 (o.h) ((i.n)(o.n))^alpha) with F(u) = r0 + (1 - r0)(1 - u)^5 and Beckmann's D.

Parameters
----------
roughness : float or (float, float)
    Beckmann slopes along tangent and bitangent, in 1e-6..1. One number is an isotropic lobe.
r0 : float or (float, float, float)
    Reflectance at normal incidence, in 0..1. 1 switches Fresnel off.
alpha : float
    Grazing exponent, in 0..1. Above 0.5 the model gains energy.
weight : float or (float, float, float)
    Colour, >= 0.
rotation : float
    Radians; turns the tangent counter-clockwise about the normal.
conserve_energy : bool
    Divide by the albedo for r0 = 1 where that exceeds 1. glTF's materials do; the published model does not.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_kurt_lobe), py::arg("roughness") = Pair(0.2f), py::arg("r0") = Color(1.0f),
             py::arg("alpha") = 0.0f, py::arg("weight") = Color(1.0f), py::arg("rotation") = 0.0f,
             py::arg("conserve_energy") = false)
        .def_property_readonly(
            "roughness", [](const KurtLobe& l) { return tuple_of(l.roughness); },
            "(float, float): Beckmann slopes along tangent and bitangent.")
        .def_property_readonly(
            "r0", [](const KurtLobe& l) { return tuple_of(l.r0); },
            "(float, float, float): reflectance at normal incidence.")
        .def_readonly("alpha", &KurtLobe::alpha, "Grazing exponent.")
        .def_property_readonly(
            "weight", [](const KurtLobe& l) { return tuple_of(l.weight); }, "(float, float, float): colour.")
        .def_readonly("rotation", &KurtLobe::rotation, "Radians about the normal.")
        .def_readonly("conserve_energy", &KurtLobe::conserve_energy,
                      "Whether albedos above 1 are divided out.")
        .def_property_readonly("is_anisotropic", &KurtLobe::is_anisotropic, "Whether the two slopes differ.")
        .def_property_readonly("has_fresnel", &KurtLobe::has_fresnel, "Whether r0 is below 1 anywhere.")
        .def("__repr__", [](const KurtLobe& l) { return repr(l); });
}

void bind_ggx_lobe(py::module_& m) {
    py::class_<GgxLobe>(
        m, "GgxLobe",
        R"(One glossy lobe after Trowbridge and Reitz 1975 (GGX). It does not change once made.

f = weight F(u) D V with F(u) = r0 + (f90 - r0)(1 - u)^5, u = o.h,
D = 1/(pi ax ay ((hx/ax)^2 + (hy/ay)^2 + hz^2)^2) and Smith's height-correlated
V = 1/(2 (co a(i) + ci a(o))), a(v)^2 = vz^2 + (ax vx)^2 + (ay vy)^2.

Parameters
----------
roughness : float or (float, float)
    alpha along tangent and bitangent, in 1e-6..1, the square of glTF's perceptual roughness. One number is an
    isotropic lobe.
r0 : float or (float, float, float)
    Reflectance at normal incidence, in 0..1.
f90 : float or (float, float, float)
    Reflectance along the surface, in 0..1. r0 = f90 switches Fresnel off.
weight : float or (float, float, float)
    Colour, >= 0.
rotation : float
    Radians; turns the tangent counter-clockwise about the normal.
compensate : str
    "scale" puts back what light loses between facets that it meets more than once: times
    1 + r0/f90 (1/E1 - 1), E1 the albedo for r0 = f90 = 1, which then is 1 (Turquin 2019). "none": glTF's lobe.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_ggx_lobe), py::arg("roughness") = Pair(0.2f), py::arg("r0") = Color(1.0f),
             py::arg("f90") = Color(1.0f), py::arg("weight") = Color(1.0f), py::arg("rotation") = 0.0f,
             py::arg("compensate") = "none")
        .def_property_readonly(
            "roughness", [](const GgxLobe& l) { return tuple_of(l.roughness); },
            "(float, float): alpha along tangent and bitangent.")
        .def_property_readonly(
            "r0", [](const GgxLobe& l) { return tuple_of(l.r0); },
            "(float, float, float): reflectance at normal incidence.")
        .def_property_readonly(
            "f90", [](const GgxLobe& l) { return tuple_of(l.f90); },
            "(float, float, float): reflectance along the surface.")
        .def_property_readonly(
            "weight", [](const GgxLobe& l) { return tuple_of(l.weight); }, "(float, float, float): colour.")
        .def_readonly("rotation", &GgxLobe::rotation, "Radians about the normal.")
        .def_property_readonly("compensate", &compensate_of, "'none' or 'scale'.")
        .def_property_readonly("is_anisotropic", &GgxLobe::is_anisotropic, "Whether the two alphas differ.")
        .def_property_readonly("has_fresnel", &GgxLobe::has_fresnel, "Whether r0 is not f90 anywhere.")
        .def("__repr__", [](const GgxLobe& l) { return repr(l); });
}

LafortuneLobe make_lafortune_lobe(const Triple& c, float exponent, const Color& weight, float rotation) {
    LafortuneLobe lobe{vec3_of(c), exponent, vec3_of(weight), rotation};
    validate(lobe);
    return lobe;
}

SheenLobe make_sheen_lobe(float roughness, const Color& weight) {
    SheenLobe lobe{roughness, vec3_of(weight)};
    validate(lobe);
    return lobe;
}

/// Widths of a lobe's plane, whichever model it is of.
template <typename Model>
py::tuple width_of(const Model& lobe) {
    return tuple_of(facts(lobe).width());
}

void bind_lafortune_lobe(py::module_& m) {
    py::class_<LafortuneLobe>(m, "LafortuneLobe",
                              R"(One lobe after Lafortune et al. 1997. It does not change once made.

f = weight max(cx ox ix + cy oy iy + cz oz iz, 0)^exponent: a power of the cosine around p = (cx ox, cy oy, cz oz),
|p|^exponent at its peak. c = (-1, -1, 1) is Phong's lobe around the mirrored view, (1, 1, 1) lies around the view
itself; |cz| below the others leans to the horizon. Nothing limits its energy: |c| = ((n + 2)/(2 pi))^(1/n) gives
back all that comes along the normal.

Parameters
----------
c : (float, float, float)
    Along tangent, bitangent and normal, each in -1000..1000.
exponent : float
    In 0..1e6.
weight : float or (float, float, float)
    Colour, >= 0.
rotation : float
    Radians; turns the tangent counter-clockwise about the normal.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_lafortune_lobe), py::arg("c") = Triple{-1.0f, -1.0f, 1.0f},
             py::arg("exponent") = 10.0f, py::arg("weight") = Color(1.0f), py::arg("rotation") = 0.0f)
        .def_property_readonly(
            "c", [](const LafortuneLobe& l) { return tuple_of(l.c); },
            "(float, float, float): along tangent, bitangent and normal.")
        .def_readonly("exponent", &LafortuneLobe::exponent, "Power of the cosine.")
        .def_property_readonly(
            "weight", [](const LafortuneLobe& l) { return tuple_of(l.weight); },
            "(float, float, float): colour.")
        .def_readonly("rotation", &LafortuneLobe::rotation, "Radians about the normal.")
        .def_property_readonly("width", &width_of<LafortuneLobe>,
                               "(float, float): (1/2/(exponent + 1))^(1/2), how wide it is as a slope of "
                               "half-vectors.")
        .def_property_readonly("is_anisotropic", &LafortuneLobe::is_anisotropic, "Whether cx and cy differ.")
        .def("__repr__", [](const LafortuneLobe& l) {
            return message("LafortuneLobe(c=(", l.c.x, ", ", l.c.y, ", ", l.c.z, "), exponent=", l.exponent,
                           ", weight=(", l.weight.x, ", ", l.weight.y, ", ", l.weight.z,
                           "), rotation=", l.rotation, ")");
        });
}

void bind_sheen_lobe(py::module_& m) {
    py::class_<SheenLobe>(m, "SheenLobe", R"(The glow of cloth toward grazing. It does not change once made.

f = weight D V of KHR_materials_sheen (Estevez and Kulla 2017): D = (2 + 1/a) sin_h^(1/a)/(2 pi), a = roughness^2
but at least .001, and the fitted V; divided by its albedo where that exceeds 1, which the fit does where smooth
cloth grazes. Last among layered lobes it lies over the others, which get what it leaves.

Parameters
----------
roughness : float
    Perceptual, as glTF's sheenRoughness, in 0..1.
weight : float or (float, float, float)
    Colour, >= 0.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_sheen_lobe), py::arg("roughness") = 0.3f, py::arg("weight") = Color(1.0f))
        .def_readonly("roughness", &SheenLobe::roughness, "Perceptual.")
        .def_property_readonly(
            "weight", [](const SheenLobe& l) { return tuple_of(l.weight); }, "(float, float, float): colour.")
        .def_property_readonly("width", &width_of<SheenLobe>,
                               "(float, float): of its plane, that of a cosine about the normal.")
        .def("__repr__", [](const SheenLobe& l) {
            return message("SheenLobe(roughness=", l.roughness, ", weight=(", l.weight.x, ", ", l.weight.y,
                           ", ", l.weight.z, "))");
        });
}

} // namespace

void bind_lobes(py::module_& m) {
    bind_kurt_lobe(m);
    bind_ggx_lobe(m);
    bind_lafortune_lobe(m);
    bind_sheen_lobe(m);
}

} // namespace burnish
