// Material and Camera: values that do not change once made, so that no copy can go stale unseen.
#include "burnish/plan/material_traits.h"
#include "burnish/scene/idle_parts.h"
#include "burnish/scene/scene.h"
#include "scene_values.h"

namespace burnish {
namespace {

Material make_material(const Color& diffuse, std::vector<Lobe> lobes, const Color& emissive, std::string name,
                       bool double_sided, bool layered) {
    Material material;
    material.diffuse = vec3_of(diffuse);
    material.lobes = std::move(lobes);
    material.emissive = vec3_of(emissive);
    material.name = std::move(name);
    material.double_sided = double_sided;
    if (layered) make_layers(material);
    validate(material);
    leave_out_idle_lobes(material);
    return material;
}

Material make_metallic_roughness(const Color& base_color, float metallic, float roughness, float clearcoat,
                                 float clearcoat_roughness, const Color& sheen, float sheen_roughness,
                                 float anisotropy, float anisotropy_rotation, float ior, float specular,
                                 const Color& specular_color, const Color& emissive, const std::string& model,
                                 std::string name, bool double_sided) {
    Material material;
    MetallicRoughness& source = material.source.emplace();
    source.model = material_model_of(model);
    source.base_color = glm::vec4(vec3_of(base_color), 1.0f);
    source.metallic = metallic;
    source.roughness = roughness;
    source.ior = ior;
    source.specular = specular;
    source.specular_color = vec3_of(specular_color);
    source.anisotropy = anisotropy;
    source.anisotropy_rotation = anisotropy_rotation;
    source.clearcoat = clearcoat;
    source.clearcoat_roughness = clearcoat_roughness;
    source.sheen_color = vec3_of(sheen);
    source.sheen_roughness = sheen_roughness;
    material.emissive = vec3_of(emissive);
    material.name = std::move(name);
    material.double_sided = double_sided;
    validate(material);
    map_metallic_roughness(material);
    return material;
}

Material replaced(const Material& from, const std::optional<Color>& diffuse,
                  const std::optional<std::vector<Lobe>>& lobes, const std::optional<Color>& emissive,
                  const std::optional<std::string>& name, std::optional<bool> double_sided,
                  std::optional<bool> layered) {
    Material material = from;
    if (diffuse || lobes || layered) {
        if (is_varying(material))
            throw std::invalid_argument(
                "diffuse, lobes, layered: expected none for a material whose textures or "
                "vertex colours say what they are, got one");
        material.source.reset(); // it is no longer what a file described
        material.left_out.clear();
    }
    if (diffuse) material.diffuse = vec3_of(*diffuse);
    if (lobes) material.lobes = *lobes;
    const bool has_layers = layered.value_or(!material.covers.empty());
    if (lobes || layered) {
        material.covers.clear();
        if (has_layers) make_layers(material);
    }
    if (emissive) material.emissive = vec3_of(*emissive);
    if (name) material.name = *name;
    if (double_sided) material.double_sided = *double_sided;
    validate(material);
    if (lobes) leave_out_idle_lobes(material);
    return material;
}

/// (E1's share, Es's share) of each lobe that takes a fixed share, None of others.
py::object covers_of(const Material& material) {
    if (material.covers.empty()) return py::none();
    py::list covers;
    for (const Cover& cover : material.covers)
        covers.append(py::make_tuple(
            cover.albedo ? py::object(py::make_tuple(cover.albedo->x, cover.albedo->y)) : py::none(),
            cover.is_over_emission));
    return py::tuple(covers);
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

void bind_material(py::module_& m) {
    py::class_<Material>(m, "Material",
                         R"(Diffuse plus one to four glossy lobes. It does not change once made.

Parameters
----------
diffuse : float or (float, float, float)
    Diffuse reflectance, in 0..1.
lobes : list of KurtLobe, GgxLobe, LafortuneLobe or SheenLobe
    At most four. One that reflects nothing is left out.
emissive : float or (float, float, float)
    Radiance given off, >= 0.
name : str
    Shown in reports.
double_sided : bool
    Whether back faces are drawn, with the normal turned over.
layered : bool
    Lobes lie over each other and over the diffuse part in their order: what one reflects toward the eye, its
    albedo's largest channel, is missing from what lies below, so that no more comes back than came in. The
    lowest lobe is of the surface that emits. Else all parts add up.

Raises
------
ValueError
    If a number is out of its range.)")
        .def(py::init(&make_material), py::arg("diffuse") = Color(0.0f),
             py::arg("lobes") = std::vector<Lobe>{}, py::arg("emissive") = Color(0.0f), py::arg("name") = "",
             py::arg("double_sided") = false, py::arg("layered") = false)
        .def_static("metallic_roughness", &make_metallic_roughness, py::arg("base_color") = Color(1.0f),
                    py::arg("metallic") = 0.0f, py::arg("roughness") = 0.5f, py::arg("clearcoat") = 0.0f,
                    py::arg("clearcoat_roughness") = 0.0f, py::arg("sheen") = Color(0.0f),
                    py::arg("sheen_roughness") = 0.0f, py::arg("anisotropy") = 0.0f,
                    py::arg("anisotropy_rotation") = 0.0f, py::arg("ior") = 1.5f, py::arg("specular") = 1.0f,
                    py::arg("specular_color") = Color(1.0f), py::arg("emissive") = Color(0.0f),
                    py::arg("model") = "ggx", py::arg("name") = "", py::arg("double_sided") = false,
                    R"(The material that glTF's numbers mean.

With f0 = min(((ior - 1)/(ior + 1))^2 specular_color, 1) specular and m = max(roughness^2, 1e-3) the base lobe
reflects mix(f0, base_color, metallic) along the normal, mix(specular, 1, metallic) along the surface; anisotropy
makes it mix(m, 1, anisotropy^2) wide along the tangent. "ggx" takes m for alpha; the diffuse part, base_color
(1 - metallic), lies below the dielectric's share of the lobe, both below a clear coat of r0 .04. "kurt" takes m
for the slope of lobes that add up; the diffuse part lacks what a dielectric reflects along the normal.

Parameters
----------
base_color : float or (float, float, float)
    Linear, in 0..1.
metallic, roughness, clearcoat, clearcoat_roughness, sheen_roughness, anisotropy, specular : float
    In 0..1; roughness is perceptual.
sheen : float or (float, float, float)
    Colour of the glow of cloth, in 0..1, between base and coat; "kurt" has none.
anisotropy_rotation : float
    Radians, counter-clockwise from the tangent.
ior : float
    1 or more; 0 stands for infinity.
specular_color : float or (float, float, float)
    >= 0.
emissive : float or (float, float, float)
    Radiance given off, >= 0; below a clear coat.
model : str
    "ggx" or "kurt".
name : str
    Shown in reports.
double_sided : bool
    Whether back faces are drawn, with the normal turned over.

Returns
-------
material : Material

Raises
------
ValueError
    If a number is out of its range, or there is no such model.)")
        .def("replace", &replaced, py::kw_only(), py::arg("diffuse") = py::none(),
             py::arg("lobes") = py::none(), py::arg("emissive") = py::none(), py::arg("name") = py::none(),
             py::arg("double_sided") = py::none(), py::arg("layered") = py::none(),
             R"(The same material but for what is given.

Parameters
----------
diffuse, lobes, emissive, name, double_sided, layered : as of Material, or None
    None stays as it is. Layers of other lobes take what they reflect.

Returns
-------
material : Material

Raises
------
ValueError
    If a number is out of its range, or diffuse part, lobes or layers are to be others than textures say.)")
        .def_readonly(
            "left_out", &Material::left_out,
            "List of str: parts that change no pixel and are not drawn, and why: lobes that reflect "
            "nothing, textures of one value, flat normal maps, white vertex colours.")
        .def_property_readonly(
            "layered", [](const Material& x) { return !x.covers.empty(); },
            "Whether lobes take light from what lies below them.")
        .def_property_readonly("covers", &covers_of,
                               "None, or of each lobe ((a, b) or None, bool): the share a E_1 + b E_s of its "
                               "albedo that what lies below it lacks, None for all that it reflects; and "
                               "whether emission lies below.")
        .def_property_readonly(
            "diffuse", [](const Material& x) { return tuple_of(x.diffuse); },
            "(float, float, float): diffuse reflectance.")
        .def_property_readonly(
            "lobes", [](const Material& x) { return py::tuple(py::cast(x.lobes)); }, "Tuple of lobes.")
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
    bind_lobes(m);
    bind_lights(m);
    bind_material(m);
    bind_mesh(m);
    bind_camera(m);
}

} // namespace burnish
