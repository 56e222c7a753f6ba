// KurtLobe, Material and Camera: values that do not change once made, so that no copy can go stale unseen.
#include "burnish/scene/scene.h"
#include "scene_values.h"

namespace burnish {
namespace {

KurtLobe make_lobe(const Pair& roughness, const Color& r0, float alpha, const Color& weight, float rotation,
                   bool conserve_energy) {
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

Material make_material(const Color& diffuse, std::vector<Lobe> lobes, const Color& emissive, std::string name,
                       bool double_sided) {
    Material material;
    material.diffuse = vec3_of(diffuse);
    material.lobes = std::move(lobes);
    material.emissive = vec3_of(emissive);
    material.name = std::move(name);
    material.double_sided = double_sided;
    validate(material);
    return material;
}

const char* alpha_mode_name(const Material& material) {
    switch (material.alpha_mode) {
    case AlphaMode::mask:
        return "mask";
    case AlphaMode::blend:
        return "blend";
    default:
        return "opaque";
    }
}

Camera make_look_at(const Place& eye, const Place& target, const Place& up, float vertical_fov,
                    float near_plane) {
    Camera camera = look_at(dvec3_of(eye), dvec3_of(target), dvec3_of(up));
    camera.vertical_fov = vertical_fov;
    camera.near_plane = near_plane;
    validate(camera);
    return camera;
}

Camera make_orthographic(const Place& eye, const Place& target, const Place& up, float half_height,
                         float near_plane, float far_plane) {
    Camera camera = look_at(dvec3_of(eye), dvec3_of(target), dvec3_of(up));
    camera.is_orthographic = true;
    camera.half_height = half_height;
    camera.near_plane = near_plane;
    camera.far_plane = far_plane;
    validate(camera);
    return camera;
}

Camera make_camera(const py::object& world_from_camera, float vertical_fov, float near_plane,
                   std::string name) {
    Camera camera;
    camera.world_from_camera = dmat4_of(world_from_camera, "world_from_camera");
    camera.vertical_fov = vertical_fov;
    camera.near_plane = near_plane;
    camera.name = std::move(name);
    validate(camera);
    return camera;
}

void bind_lobe(py::module_& m) {
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
        .def(py::init(&make_lobe), py::arg("roughness") = Pair(0.2f), py::arg("r0") = Color(1.0f),
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
        .def("__repr__", &repr);
}

void bind_material(py::module_& m) {
    py::class_<Material>(m, "Material",
                         R"(Diffuse plus one to four glossy lobes. It does not change once made.

Parameters
----------
diffuse : float or (float, float, float)
    Diffuse reflectance, in 0..1.
lobes : list of KurtLobe
    At most four.
emissive : float or (float, float, float)
    Radiance given off, >= 0.
name : str
    Shown in reports.
double_sided : bool
    Whether back faces are drawn, with the normal turned over.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_material), py::arg("diffuse") = Color(0.0f),
             py::arg("lobes") = std::vector<Lobe>{}, py::arg("emissive") = Color(0.0f), py::arg("name") = "",
             py::arg("double_sided") = false)
        .def_property_readonly(
            "diffuse", [](const Material& x) { return tuple_of(x.diffuse); },
            "(float, float, float): diffuse reflectance.")
        .def_property_readonly(
            "lobes", [](const Material& x) { return py::tuple(py::cast(x.lobes)); }, "Tuple of KurtLobe.")
        .def_property_readonly(
            "emissive", [](const Material& x) { return tuple_of(x.emissive); },
            "(float, float, float): radiance given off.")
        .def_readonly("name", &Material::name, "Shown in reports.")
        .def_readonly("double_sided", &Material::double_sided, "Whether back faces are drawn.")
        .def_property_readonly("alpha_mode", &alpha_mode_name,
                               "'opaque', 'mask' or 'blend' (drawn as a mask at 0.5).")
        .def_readonly("alpha_cutoff", &Material::alpha_cutoff,
                      "Coverage below it is left out, for alpha_mode 'mask'.")
        .def_property_readonly(
            "is_metallic_roughness", [](const Material& x) { return x.source.has_value(); },
            "Whether it came from a glTF file; textures then vary it over the surface.")
        .def("__repr__", [](const Material& x) {
            return message("Material(name='", x.name, "', lobes=", x.lobes.size(), ")");
        });
}

void bind_camera(py::module_& m) {
    py::class_<Camera>(m, "Camera", R"(A pinhole or orthographic camera. It does not change once made.

It looks along its own -z with y up, as in glTF; the far plane of a pinhole camera is at infinity.

Parameters
----------
world_from_camera : (4, 4) array
    Rotation and translation.
vertical_fov : float
    Radians, between 0 and pi.
near_plane : float
    > 0.
name : str
    Shown in reports.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_camera), py::arg("world_from_camera"), py::arg("vertical_fov") = 0.8f,
             py::arg("near_plane") = 0.01f, py::arg("name") = "")
        .def_static("look_at", &make_look_at, py::arg("eye"), py::arg("target"),
                    py::arg("up") = Place{0, 1, 0}, py::arg("vertical_fov") = 0.8f,
                    py::arg("near_plane") = 0.01f,
                    "A pinhole camera at a point, looking at another.\n\nParameters\n----------\neye, "
                    "target, up : (3,) floats\n"
                    "vertical_fov : float\n    Radians, between 0 and pi.\nnear_plane : float\n    > 0.")
        .def_static("orthographic", &make_orthographic, py::arg("eye"), py::arg("target"),
                    py::arg("up") = Place{0, 1, 0}, py::arg("half_height") = 1.0f,
                    py::arg("near_plane") = 0.0f, py::arg("far_plane") = 1000.0f,
                    "A camera without perspective.\n\nParameters\n----------\neye, target, up : (3,) "
                    "floats\nhalf_height : float\n"
                    "    Half of the height it sees, > 0.\nnear_plane, far_plane : float\n    Distances "
                    "along the view.")
        .def_property_readonly(
            "world_from_camera", [](const Camera& x) { return array_of(x.world_from_camera); },
            "(4, 4) float64, a copy.")
        .def_readonly("is_orthographic", &Camera::is_orthographic, "Whether it has no perspective.")
        .def_readonly("vertical_fov", &Camera::vertical_fov, "Radians; perspective only.")
        .def_readonly("half_height", &Camera::half_height, "Orthographic only.")
        .def_readonly("near_plane", &Camera::near_plane, "Distance along the view.")
        .def_readonly("far_plane", &Camera::far_plane, "Distance along the view; orthographic only.")
        .def_readonly("name", &Camera::name, "Shown in reports.")
        .def("__repr__", [](const Camera& x) {
            return x.is_orthographic
                       ? message("Camera(name='", x.name, "', half_height=", x.half_height, ")")
                       : message("Camera(name='", x.name, "', vertical_fov=", x.vertical_fov, ")");
        });
}

} // namespace

void bind_scene_parts(py::module_& m) {
    bind_lobe(m);
    bind_material(m);
    bind_mesh(m);
    bind_camera(m);
}

} // namespace burnish
