// Mesh: it does not change once made, like the other parts of a scene.
#include "burnish/scene/scene.h"
#include "scene_values.h"

namespace burnish {
namespace {

template <typename Vector>
std::vector<Vector> vectors_of(const py::array& array, const char* name) {
    constexpr py::ssize_t COMPONENTS = sizeof(Vector) / sizeof(float);
    const auto checked = require_array<float>(array, name, {any, COMPONENTS});
    const auto* first = reinterpret_cast<const Vector*>(checked.data());
    return {first, first + checked.shape(0)};
}

Mesh make_mesh(const py::array& positions, const py::array& indices, const std::optional<py::array>& normals,
               const std::optional<py::array>& tangents, const std::optional<py::array>& uv0,
               std::string name) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.positions = vectors_of<glm::vec3>(positions, "positions");
    const auto triangles = require_array<uint32_t>(indices, "indices", {any, 3});
    mesh.indices.assign(triangles.data(), triangles.data() + triangles.size());
    if (normals) mesh.normals = vectors_of<glm::vec3>(*normals, "normals");
    if (tangents) mesh.tangents = vectors_of<glm::vec4>(*tangents, "tangents");
    if (uv0) mesh.uv0 = vectors_of<glm::vec2>(*uv0, "uv0");
    if (!normals) {
        // Indices must be right before they are followed.
        mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
        validate(mesh);
        compute_normals(mesh);
    }
    validate(mesh);
    return mesh;
}

py::array_t<uint32_t> triangles_of(const Mesh& mesh) {
    return make_array(std::vector<uint32_t>(mesh.indices),
                      {static_cast<py::ssize_t>(mesh.indices.size() / 3), 3});
}

} // namespace

void bind_mesh(py::module_& m) {
    py::class_<Mesh, std::shared_ptr<Mesh>>(m, "Mesh", R"(Triangles. It does not change once made.

Parameters
----------
positions : (n, 3) float32
    Vertices in object space.
indices : (m, 3) uint32
    A triangle per row, counter-clockwise seen from the front.
normals : None or (n, 3) float32
    Unit vectors; None takes the mean of the faces around each vertex, weighted by area.
tangents : None or (n, 4) float32
    Unit vectors along growing u and the bitangent's sign, +1 or -1. Where a brushed lobe needs them, None
    takes them from `uv0`; without that they follow the longitude around y, and the report warns.
uv0 : None or (n, 2) float32
    Texture coordinates.
name : str
    Shown in reports.

Raises
------
ValueError
    If an array has another type, shape or layout, or holds numbers that are not finite or not in range.)")
        .def(py::init(&make_mesh), py::arg("positions"), py::arg("indices"), py::arg("normals") = py::none(),
             py::arg("tangents") = py::none(), py::arg("uv0") = py::none(), py::arg("name") = "")
        .def_property_readonly(
            "positions", [](const Mesh& x) { return array_of(x.positions); }, "(n, 3) float32, a copy.")
        .def_property_readonly(
            "normals", [](const Mesh& x) { return array_of(x.normals); }, "(n, 3) float32, a copy.")
        .def_property_readonly(
            "tangents", [](const Mesh& x) { return array_of(x.tangents); },
            "(n, 4) float32, a copy, or None.")
        .def_property_readonly(
            "uv0", [](const Mesh& x) { return array_of(x.uv0); }, "(n, 2) float32, a copy, or None.")
        .def_property_readonly("indices", &triangles_of, "(m, 3) uint32, a copy.")
        .def_property_readonly(
            "triangle_count", [](const Mesh& x) { return x.indices.size() / 3; }, "Number of triangles.")
        .def_readonly("name", &Mesh::name, "Shown in reports.")
        .def_static(
            "sphere", &make_sphere, py::arg("radius") = 1.0f, py::arg("segments") = 128u,
            "A sphere by latitude and longitude, poles on y.\n\nParameters\n----------\nradius : float\n"
            "segments : int\n    Around the equator, 3..4096.")
        .def_static("torus", &make_torus, py::arg("radius") = 1.0f, py::arg("tube_radius") = 0.4f,
                    py::arg("segments") = 128u,
                    "A torus around y.\n\nParameters\n----------\nradius : float\ntube_radius : float\n    "
                    "Below radius.\n"
                    "segments : int\n    Around the axis, 3..4096.")
        .def_static(
            "plane", &make_plane, py::arg("size") = 2.0f, py::arg("segments") = 1u,
            "A square in the xz plane, normal +y.\n\nParameters\n----------\nsize : float\nsegments : int\n"
            "    Along each side, 1..4096.")
        .def("__repr__", [](const Mesh& x) {
            return message("Mesh(name='", x.name, "', vertices=", x.positions.size(),
                           ", triangles=", x.indices.size() / 3, ")");
        });
}

} // namespace burnish
