#include "burnish/scene/mesh.h"

#include <algorithm>
#include <stdexcept>

#include "burnish/check.h"

namespace burnish {
namespace {

template <typename Vector>
void require_array(const char* name, const std::vector<Vector>& values, size_t count, bool is_optional) {
    if (is_optional && values.empty()) return;
    if (values.size() != count)
        throw std::invalid_argument(
            message(name, ": expected as many as positions (", count, "), got ", values.size()));
    for (size_t i = 0; i < values.size(); ++i)
        if (!is_finite(values[i]))
            throw std::invalid_argument(
                message(name, ": expected finite numbers, got a non-finite one at ", i));
}

glm::dvec3 face_normal(const Mesh& mesh, size_t first_index) {
    glm::dvec3 a = mesh.positions[mesh.indices[first_index]];
    glm::dvec3 b = mesh.positions[mesh.indices[first_index + 1]];
    glm::dvec3 c = mesh.positions[mesh.indices[first_index + 2]];
    return glm::cross(b - a, c - a);
}

/// In double precision, so that triangles of 1e-20 units keep a direction.
glm::vec3 unit_or_z(const glm::dvec3& v) {
    double length = glm::length(v);
    return length > 0.0 ? glm::vec3(v / length) : glm::vec3(0.0f, 0.0f, 1.0f);
}

template <typename Vector>
std::vector<Vector> gather(const std::vector<Vector>& values, const std::vector<uint32_t>& from) {
    std::vector<Vector> gathered;
    if (values.empty()) return gathered;
    gathered.reserve(from.size());
    for (uint32_t i : from)
        gathered.push_back(values[i]);
    return gathered;
}

} // namespace

void validate(const Mesh& mesh) {
    size_t count = mesh.positions.size();
    require_array("positions", mesh.positions, count, false);
    require_array("normals", mesh.normals, count, false);
    require_array("tangents", mesh.tangents, count, true);
    require_array("uv0", mesh.uv0, count, true);
    require_array("uv1", mesh.uv1, count, true);
    require_array("colors", mesh.colors, count, true);
    for (size_t i = 0; i < count; ++i) {
        float length = glm::length(mesh.normals[i]);
        if (!(length > 0.99f && length < 1.01f))
            throw std::invalid_argument(message("normals: expected unit length, got ", length, " at ", i));
    }
    if (mesh.indices.size() % 3 != 0)
        throw std::invalid_argument(
            message("indices: expected three per triangle, got ", mesh.indices.size()));
    for (uint32_t index : mesh.indices)
        if (index >= count)
            throw std::invalid_argument(
                message("indices: expected each below the vertex count ", count, ", got ", index));
}

void compute_normals(Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        glm::dvec3 normal = face_normal(mesh, i); // twice the area long
        for (size_t corner = 0; corner < 3; ++corner)
            sums[mesh.indices[i + corner]] += normal;
    }
    mesh.normals.resize(sums.size());
    std::transform(sums.begin(), sums.end(), mesh.normals.begin(), unit_or_z);
}

void compute_flat_normals(Mesh& mesh) {
    std::vector<uint32_t> corners;
    std::vector<glm::vec3> normals;
    corners.reserve(mesh.indices.size());
    normals.reserve(mesh.indices.size());
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        glm::dvec3 normal = face_normal(mesh, i);
        if (!(glm::length(normal) > 0.0)) continue;
        corners.insert(corners.end(), mesh.indices.begin() + i, mesh.indices.begin() + i + 3);
        normals.insert(normals.end(), 3, unit_or_z(normal));
    }
    mesh.positions = gather(mesh.positions, corners);
    mesh.tangents.clear();
    mesh.uv0 = gather(mesh.uv0, corners);
    mesh.uv1 = gather(mesh.uv1, corners);
    mesh.colors = gather(mesh.colors, corners);
    mesh.normals = std::move(normals);
    mesh.indices.resize(corners.size());
    for (size_t i = 0; i < corners.size(); ++i)
        mesh.indices[i] = static_cast<uint32_t>(i);
}

void compute_tangents_around_y(Mesh& mesh) {
    if (mesh.normals.size() != mesh.positions.size())
        throw std::invalid_argument("normals: expected as many as positions, got none or too few");
    mesh.tangents.resize(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::dvec3 normal = mesh.normals[i];
        glm::dvec3 position = mesh.positions[i];
        // Growing longitude; on the axis, where it is undefined, level and across the normal; at a pole along
        // x.
        glm::dvec3 candidates[] = {
            {position.z, 0.0, -position.x}, {normal.z, 0.0, -normal.x}, {1, 0, 0}, {0, 0, 1}};
        for (glm::dvec3 candidate : candidates) {
            double length = glm::length(candidate);
            if (!(length > 1e-30)) continue;
            candidate /= length;
            candidate -= normal * glm::dot(normal, candidate);
            if (glm::length(candidate) < 1e-3) continue;
            mesh.tangents[i] = glm::vec4(glm::vec3(glm::normalize(candidate)), 1.0f);
            break;
        }
    }
}

} // namespace burnish
