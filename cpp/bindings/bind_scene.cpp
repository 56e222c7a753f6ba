#include <filesystem>

#include <pybind11/stl/filesystem.h>

#include "burnish/check.h"
#include "burnish/scene/scene.h"
#include "interpreter.h"
#include "scene_values.h"

namespace burnish {

namespace {

/// An object by its place in a scene, which it keeps alive.
struct ObjectHandle {
    std::shared_ptr<Scene> scene;
    uint32_t index;
    Object& get() const { return scene->objects.at(index); }
};

uint32_t require_index(const char* name, int64_t index, size_t count) {
    if (index < 0 || static_cast<uint64_t>(index) >= count)
        throw std::invalid_argument(message(name, ": expected an index below ", count, ", got ", index));
    return static_cast<uint32_t>(index);
}

glm::dmat4 transform_of(const py::object& transform, const char* name) {
    glm::dmat4 matrix = dmat4_of(transform, name);
    if (!is_finite(glm::mat4(matrix)) || matrix[0].w != 0.0 || matrix[1].w != 0.0 || matrix[2].w != 0.0 ||
        matrix[3].w != 1.0)
        throw std::invalid_argument(
            message(name, ": expected finite numbers with a last row of 0 0 0 1, got others"));
    return matrix;
}

uint32_t add(Scene& scene, const std::shared_ptr<Mesh>& mesh, const Material& material,
             const std::optional<py::object>& transform, std::string name) {
    Object object;
    object.world_from_object = transform ? transform_of(*transform, "transform") : glm::dmat4(1.0);
    object.name = name.empty() ? message("object.", scene.objects.size()) : std::move(name);
    for (const Object& other : scene.objects)
        if (other.name == object.name)
            throw std::invalid_argument(
                message("name: expected a new name, got \"", object.name, "\" again"));
    object.mesh = static_cast<uint32_t>(scene.meshes.size());
    object.material = static_cast<uint32_t>(scene.materials.size());
    scene.meshes.push_back(std::shared_ptr<const Mesh>(mesh)); // Python cannot change it
    scene.materials.push_back(material);
    scene.objects.push_back(std::move(object));
    return static_cast<uint32_t>(scene.objects.size() - 1);
}

/// Python has no const.
std::shared_ptr<Environment> mutable_of(const std::shared_ptr<const Environment>& environment) {
    return std::const_pointer_cast<Environment>(environment);
}

py::tuple bounds_of(const Bounds& bounds) {
    return py::make_tuple(tuple_of(bounds.low), tuple_of(bounds.high));
}

void bind_object(py::module_& m) {
    py::class_<ObjectHandle>(m, "Object",
                             "One mesh placed in a scene. It stays valid as long as the scene does.")
        .def_property_readonly(
            "name", [](const ObjectHandle& x) { return x.get().name; }, "Unique within the scene.")
        .def_property_readonly(
            "mesh", [](const ObjectHandle& x) { return x.get().mesh; }, "Index into scene.meshes.")
        .def_property(
            "material", [](const ObjectHandle& x) { return x.get().material; },
            [](const ObjectHandle& x, int64_t index) {
                x.get().material = require_index("material", index, x.scene->materials.size());
            },
            "Index into scene.materials.")
        .def_property(
            "world_from_object", [](const ObjectHandle& x) { return array_of(x.get().world_from_object); },
            [](const ObjectHandle& x, const py::object& transform) {
                x.get().world_from_object = transform_of(transform, "world_from_object");
            },
            "(4, 4) float64, a copy: assign a whole matrix to change it.")
        .def_property(
            "reflects", [](const ObjectHandle& x) { return mutable_of(x.get().reflects); },
            [](const ObjectHandle& x, std::shared_ptr<Environment> environment) {
                x.get().reflects = std::move(environment);
            },
            "The Environment its lobes reflect; None is the scene's.")
        .def(
            "bounds", [](const ObjectHandle& x) { return bounds_of(x.scene->object_bounds(x.index)); },
            "Box in the world.\n\nReturns\n-------\nlow, high : (3,) tuples of float")
        .def("__repr__", [](const ObjectHandle& x) { return message("Object(name='", x.get().name, "')"); });
}

} // namespace

void bind_scene(py::module_& m) {
    bind_scene_parts(m);
    bind_object(m);
    py::class_<Scene, std::shared_ptr<Scene>>(
        m, "Scene", R"(What there is to render: objects, materials, cameras and distant light.

`Scene()` is empty; `add` fills it. Materials and cameras are values: the tuples hold copies. Meshes, which do
not change, are shared.)")
        .def(py::init<>())
        .def_static(
            "from_file",
            [](const std::filesystem::path& path, const std::string& model, bool leave_out_idle) {
                const MaterialModel chosen = material_model_of(model);
                const Released release;
                return std::make_shared<Scene>(load_gltf(path.string(), chosen, leave_out_idle));
            },
            py::arg("path"), py::arg("model") = "ggx", py::arg("leave_out_idle") = true,
            R"(Read a glTF 2.0 file.

Parameters
----------
path : str or os.PathLike
    .gltf or .glb; files it refers to lie in or below its folder.
model : str
    Lobes that its materials become: "ggx", in layers as glTF means it, or "kurt", Kurt's lobes that add up; see
    `Material.metallic_roughness`.
leave_out_idle : bool
    Leave out what changes no pixel: textures of one value become factors, flat normal maps and white vertex
    colours go; `Material.left_out` and reports say which. Without it they are drawn, at their price.

Returns
-------
scene : Scene
    `warnings` says what was repaired or left out, `ignored_extensions` what has no effect.

Raises
------
FileError
    If the file is missing, damaged, or requires an extension that is not supported.
ValueError
    If there is no such model.)")
        .def_static(
            "sphere",
            [](const Material& material) { return std::make_shared<Scene>(Scene::sphere(material)); },
            py::arg("material"),
            "A unit sphere at the origin.\n\nParameters\n----------\nmaterial : Material")
        .def_static(
            "spheres",
            [](const std::vector<Material>& materials, int64_t columns) {
                if (columns < 1)
                    throw std::invalid_argument(message("columns: expected a number >= 1, got ", columns));
                return std::make_shared<Scene>(
                    Scene::spheres(materials, static_cast<uint32_t>(std::min<int64_t>(columns, UINT32_MAX))));
            },
            py::arg("materials"), py::arg("columns"),
            "Unit spheres in a grid, one material each, row by row from the top "
            "left.\n\nParameters\n----------\n"
            "materials : list of Material\ncolumns : int\n    >= 1.")
        .def_static(
            "plane", [](const Material& material) { return std::make_shared<Scene>(Scene::plane(material)); },
            py::arg("material"),
            "A square of side 2 in the xz plane, normal +y.\n\nParameters\n----------\nmaterial : Material")
        .def_static(
            "shader_ball",
            [](const Material& material, const std::optional<Material>& ground) {
                Material grey;
                grey.name = "ground";
                grey.diffuse = glm::vec3(0.18f);
                return std::make_shared<Scene>(Scene::shader_ball(material, ground.value_or(grey)));
            },
            py::arg("material"), py::arg("ground") = py::none(),
            "A ball with a groove, on a foot, over a ground plane.\n\nParameters\n----------\nmaterial : "
            "Material\n"
            "ground : None or Material\n    None is diffuse grey.")
        .def("add", &add, py::arg("mesh").none(false), py::arg("material"), py::arg("transform") = py::none(),
             py::arg("name") = "",
             R"(Place a mesh.

Parameters
----------
mesh : Mesh
material : Material
transform : None or (4, 4) array
    world_from_object; None is the identity.
name : str
    New to the scene; empty makes one up.

Returns
-------
index : int
    Of the object.)")
        .def(
            "set_material",
            [](Scene& scene, int64_t index, const Material& material) {
                scene.materials[require_index("index", index, scene.materials.size())] = material;
            },
            py::arg("index"), py::arg("material"),
            "Replace a material.\n\nParameters\n----------\nindex : int\n    Into materials.\nmaterial : "
            "Material")
        .def(
            "add_camera", [](Scene& scene, const Camera& camera) { scene.cameras.push_back(camera); },
            py::arg("camera"), "Append a camera.\n\nParameters\n----------\ncamera : Camera")
        .def(
            "find_object",
            [](const std::shared_ptr<Scene>& scene, const std::string& name) {
                return ObjectHandle{scene, scene->find_object(name)};
            },
            py::arg("name"),
            "The object of that name.\n\nParameters\n----------\nname : str\n\nReturns\n-------\nobject : "
            "Object")
        .def("default_camera", &Scene::default_camera,
             "A camera that sees everything, from the front and a little above.\n\nReturns\n-------\ncamera "
             ": Camera")
        .def(
            "bounds", [](const Scene& scene) { return bounds_of(scene.bounds()); },
            "Box around all objects in the world.\n\nReturns\n-------\nlow, high : (3,) tuples of float")
        .def_readwrite("name", &Scene::name, "Shown in reports.")
        .def_property_readonly(
            "meshes",
            [](const Scene& x) {
                py::tuple meshes(x.meshes.size());
                for (size_t i = 0; i < x.meshes.size(); ++i)
                    meshes[i] = std::const_pointer_cast<Mesh>(x.meshes.shared()[i]);
                return meshes;
            },
            "Tuple of Mesh.")
        .def_property_readonly(
            "materials", [](const Scene& x) { return py::tuple(py::cast(x.materials)); },
            "Tuple of Material; `set_material` replaces one.")
        .def_property_readonly(
            "cameras", [](const Scene& x) { return py::tuple(py::cast(x.cameras)); }, "Tuple of Camera.")
        .def_property_readonly(
            "objects",
            [](const std::shared_ptr<Scene>& scene) {
                py::tuple objects(scene->objects.size());
                for (uint32_t i = 0; i < scene->objects.size(); ++i)
                    objects[i] = ObjectHandle{scene, i};
                return objects;
            },
            "Tuple of Object.")
        .def_property_readonly(
            "image_count", [](const Scene& x) { return x.images.size(); }, "Pictures its materials read.")
        .def_property_readonly(
            "triangle_count",
            [](const Scene& x) {
                size_t count = 0;
                for (const Object& object : x.objects)
                    count += x.meshes.at(object.mesh).indices.size() / 3;
                return count;
            },
            "Triangles of all objects.")
        .def_property(
            "environment", [](const Scene& x) { return mutable_of(x.environment); },
            [](Scene& x, std::shared_ptr<Environment> environment) {
                x.environment = std::move(environment);
            },
            "The distant light, an Environment or None.")
        .def_property(
            "lights", [](const Scene& x) { return py::tuple(py::cast(x.lights)); },
            [](Scene& x, std::vector<DirectLight> lights) { x.lights = std::move(lights); },
            "Tuple of PointLight, DirectionalLight and SpotLight, which light all objects and are not seen "
            "themselves; assign a list. Nothing hides their light.")
        .def_readwrite("show_background", &Scene::show_background,
                       "Whether the environment is drawn where no object is.")
        .def_property_readonly(
            "warnings", [](const Scene& x) { return x.warnings; },
            "List of str: what was repaired or left out while loading.")
        .def_property_readonly(
            "ignored_extensions", [](const Scene& x) { return x.ignored_extensions; },
            "List of str: optional glTF extensions without effect here.")
        .def("__repr__", [](const Scene& x) {
            return message("Scene(name='", x.name, "', objects=", x.objects.size(),
                           ", materials=", x.materials.size(), ")");
        });
}

} // namespace burnish
