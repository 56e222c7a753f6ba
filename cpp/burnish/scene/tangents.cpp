// Tangent frames by the rules of MikkTSpace (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited",
// 2008), written from the rules:
//   1. corners with equal position, normal and uv are one point;
//   2. a face's tangent is dP/du; its handedness is the sign of its area in uv;
//   3. around a point, faces of equal handedness that share an edge form a group; a face without area in uv
//   joins a
//      neighbouring group of either handedness;
//   4. a group's tangent is the sum of its faces' tangents, each projected into the plane of the point's
//   normal, made
//      unit and weighted by the angle the face spans at the point, measured in that plane.
// Differences from the reference code: an edge shared by more than two faces joins all of them, and a group
// that holds only faces without area in uv gets any unit vector across the normal.
#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

#include "burnish/check.h"
#include "burnish/scene/mesh.h"

namespace burnish {
namespace {

enum class Handedness : uint8_t { same, mirrored, unknown }; // of (u, v) and the face's winding

struct Face {
    glm::dvec3 tangent{0.0};
    Handedness handedness = Handedness::unknown;
};

struct ArrayHash {
    template <size_t N>
    size_t operator()(const std::array<uint32_t, N>& words) const {
        uint64_t hash = 0xcbf29ce484222325u;
        for (uint32_t word : words)
            hash = (hash ^ word) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
        return hash;
    }
};

class DisjointSets {
public:
    explicit DisjointSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    uint32_t find(uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(uint32_t a, uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<uint32_t> parent_;
};

/// For every vertex the number of its point.
std::vector<uint32_t> weld(const Mesh& mesh, const std::vector<glm::vec2>& uv) {
    std::unordered_map<std::array<uint32_t, 8>, uint32_t, ArrayHash> seen;
    seen.reserve(mesh.positions.size());
    std::vector<uint32_t> points(mesh.positions.size());
    for (size_t i = 0; i < points.size(); ++i) {
        float numbers[8] = {mesh.positions[i].x,
                            mesh.positions[i].y,
                            mesh.positions[i].z,
                            mesh.normals[i].x,
                            mesh.normals[i].y,
                            mesh.normals[i].z,
                            uv[i].x,
                            uv[i].y};
        for (float& number : numbers)
            number += 0.0f; // -0 and 0 are one point
        std::array<uint32_t, 8> key;
        std::memcpy(key.data(), numbers, sizeof numbers);
        points[i] = seen.emplace(key, static_cast<uint32_t>(seen.size())).first->second;
    }
    return points;
}

Face make_face(const Mesh& mesh, const std::vector<glm::vec2>& uv, const uint32_t* corners) {
    glm::dvec3 edge1 = glm::dvec3(mesh.positions[corners[1]]) - glm::dvec3(mesh.positions[corners[0]]);
    glm::dvec3 edge2 = glm::dvec3(mesh.positions[corners[2]]) - glm::dvec3(mesh.positions[corners[0]]);
    glm::dvec2 uv1 = glm::dvec2(uv[corners[1]]) - glm::dvec2(uv[corners[0]]);
    glm::dvec2 uv2 = glm::dvec2(uv[corners[2]]) - glm::dvec2(uv[corners[0]]);
    double area = uv1.x * uv2.y - uv2.x * uv1.y;
    glm::dvec3 tangent = (edge1 * uv2.y - edge2 * uv1.y) * (area < 0.0 ? -1.0 : 1.0);
    double length = glm::length(tangent);
    if (area == 0.0 || !(length > 0.0)) return {};
    return {tangent / length, area > 0.0 ? Handedness::same : Handedness::mirrored};
}

glm::dvec3 project(const glm::dvec3& v, const glm::dvec3& normal) {
    glm::dvec3 across = v - normal * glm::dot(normal, v);
    double length = glm::length(across);
    return length > 1e-12 * glm::length(v) && length > 0.0 ? across / length : glm::dvec3(0.0);
}

/// One side of one face: its two points in order, and the face's corners there.
struct Side {
    uint32_t low_point, high_point, low_corner, high_corner;
    uint32_t face() const { return low_corner / 3; }
    bool is_along(const Side& other) const {
        return low_point == other.low_point && high_point == other.high_point;
    }
};

/// All sides, those along one edge next to each other.
std::vector<Side> sort_sides(const std::vector<uint32_t>& corner_points) {
    std::vector<Side> sides;
    sides.reserve(corner_points.size());
    for (uint32_t corner = 0; corner < corner_points.size(); ++corner) {
        uint32_t next = corner - corner % 3 + (corner + 1) % 3;
        uint32_t a = corner_points[corner], b = corner_points[next];
        if (a < b) sides.push_back({a, b, corner, next});
        if (b < a) sides.push_back({b, a, next, corner});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low_point, a.high_point, a.low_corner) <
               std::tie(b.low_point, b.high_point, b.low_corner);
    });
    return sides;
}

/// Gives faces without area in uv the handedness of the nearest neighbour that has one (rule 3).
void spread_handedness(const std::vector<Side>& sides, std::vector<Face>& faces) {
    std::vector<std::vector<uint32_t>> neighbours(faces.size());
    bool has_unknown = false;
    for (size_t begin = 0, end; begin < sides.size(); begin = end) {
        for (end = begin + 1; end < sides.size() && sides[end].is_along(sides[begin]);)
            ++end;
        for (size_t i = begin + 1; i < end; ++i) { // a chain is enough to pass the handedness along
            uint32_t a = sides[i - 1].face(), b = sides[i].face();
            if (faces[a].handedness != Handedness::unknown && faces[b].handedness != Handedness::unknown)
                continue;
            neighbours[a].push_back(b);
            neighbours[b].push_back(a);
            has_unknown = true;
        }
    }
    if (!has_unknown) return;
    std::vector<uint32_t> queue;
    for (uint32_t face = 0; face < faces.size(); ++face)
        if (faces[face].handedness != Handedness::unknown && !neighbours[face].empty()) queue.push_back(face);
    for (size_t i = 0; i < queue.size(); ++i) {
        for (uint32_t other : neighbours[queue[i]]) {
            if (faces[other].handedness != Handedness::unknown) continue;
            faces[other].handedness = faces[queue[i]].handedness;
            queue.push_back(other);
        }
    }
}

/// The groups of rule 3: one set number per corner, over corners of one point.
DisjointSets group_corners(const std::vector<uint32_t>& corner_points, std::vector<Face>& faces) {
    std::vector<Side> sides = sort_sides(corner_points);
    spread_handedness(sides, faces);
    DisjointSets groups(corner_points.size());
    for (size_t begin = 0, end; begin < sides.size(); begin = end) {
        const Side* last[3] = {}; // per handedness
        for (end = begin; end < sides.size() && sides[end].is_along(sides[begin]); ++end) {
            const Side*& previous = last[static_cast<size_t>(faces[sides[end].face()].handedness)];
            if (previous) {
                groups.join(sides[end].low_corner, previous->low_corner);
                groups.join(sides[end].high_corner, previous->high_corner);
            }
            previous = &sides[end];
        }
    }
    return groups;
}

glm::dvec3 any_across(const glm::dvec3& normal) {
    return glm::normalize(
        glm::cross(normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

/// Splits vertices so that corners of different groups differ, and stores the tangents.
void assign(Mesh& mesh, DisjointSets& groups, const std::vector<glm::dvec3>& sums,
            const std::vector<Face>& faces) {
    constexpr uint32_t NONE = ~0u;
    size_t vertex_count = mesh.positions.size();
    struct Copy {
        uint32_t group = NONE, vertex = NONE, next = NONE; ///< a list per original vertex
    };
    std::vector<Copy> copies(vertex_count);
    mesh.tangents.assign(vertex_count, glm::vec4(0.0f));
    auto append_copy = [&](uint32_t vertex) {
        mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
        mesh.normals.push_back(glm::vec3(mesh.normals[vertex]));
        mesh.tangents.emplace_back();
        if (!mesh.uv0.empty()) mesh.uv0.push_back(glm::vec2(mesh.uv0[vertex]));
        if (!mesh.uv1.empty()) mesh.uv1.push_back(glm::vec2(mesh.uv1[vertex]));
        if (!mesh.colors.empty()) mesh.colors.push_back(glm::vec4(mesh.colors[vertex]));
        return static_cast<uint32_t>(mesh.positions.size() - 1);
    };
    for (uint32_t corner = 0; corner < mesh.indices.size(); ++corner) {
        uint32_t vertex = mesh.indices[corner], group = groups.find(corner), entry = vertex;
        while (copies[entry].group != group && copies[entry].next != NONE)
            entry = copies[entry].next;
        if (copies[entry].group != group) {
            if (copies[entry].group == NONE) {
                copies[entry] = {group, vertex, NONE};
            } else {
                copies[entry].next = static_cast<uint32_t>(copies.size());
                entry = static_cast<uint32_t>(copies.size());
                copies.push_back({group, append_copy(vertex), NONE});
            }
            glm::dvec3 normal = mesh.normals[vertex];
            glm::dvec3 tangent = project(sums[group], normal);
            if (tangent == glm::dvec3(0.0)) tangent = any_across(normal);
            // Green of a glTF normal map points to the picture's top, where v falls: the sign is opposite to
            // (u, v)'s.
            float w = faces[corner / 3].handedness == Handedness::same ? -1.0f : 1.0f;
            mesh.tangents[copies[entry].vertex] = glm::vec4(glm::vec3(tangent), w);
        }
        mesh.indices[corner] = copies[entry].vertex;
    }
    for (size_t i = 0; i < vertex_count; ++i)
        if (copies[i].group == NONE) // in no triangle, yet every vertex has a frame
            mesh.tangents[i] = glm::vec4(glm::vec3(any_across(mesh.normals[i])), 1.0f);
}

} // namespace

void compute_tangents(Mesh& mesh, uint32_t uv_set, const glm::mat2& uv_scale_rotation) {
    std::vector<glm::vec2> uv = uv_set == 0 ? mesh.uv0 : mesh.uv1;
    if (uv_set > 1) throw std::invalid_argument(message("uv_set: expected 0 or 1, got ", uv_set));
    if (uv.size() != mesh.positions.size() || uv.empty())
        throw std::invalid_argument(
            message("uv", uv_set, ": expected as many as positions, got ", uv.size()));
    if (mesh.normals.size() != mesh.positions.size())
        throw std::invalid_argument(
            message("normals: expected as many as positions, got ", mesh.normals.size()));

    std::vector<uint32_t> points =
        weld(mesh, uv); // before the texture's turn, which may bring points together
    for (glm::vec2& entry : uv)
        entry = glm::vec2(glm::dmat2(uv_scale_rotation) * glm::dvec2(entry));
    std::vector<uint32_t> corner_points(mesh.indices.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i)
        corner_points[i] = points[mesh.indices[i]];
    std::vector<Face> faces(mesh.indices.size() / 3);
    for (size_t face = 0; face < faces.size(); ++face)
        faces[face] = make_face(mesh, uv, &mesh.indices[face * 3]);
    DisjointSets groups = group_corners(corner_points, faces);

    std::vector<glm::dvec3> sums(mesh.indices.size(), glm::dvec3(0.0));
    for (uint32_t corner = 0; corner < mesh.indices.size(); ++corner) {
        uint32_t face = corner / 3;
        glm::dvec3 here = mesh.positions[mesh.indices[corner]];
        glm::dvec3 next = mesh.positions[mesh.indices[face * 3 + (corner + 1) % 3]];
        glm::dvec3 last = mesh.positions[mesh.indices[face * 3 + (corner + 2) % 3]];
        glm::dvec3 normal = mesh.normals[mesh.indices[corner]];
        double cosine = glm::dot(project(next - here, normal), project(last - here, normal));
        sums[groups.find(corner)] +=
            std::acos(std::clamp(cosine, -1.0, 1.0)) * project(faces[face].tangent, normal);
    }
    assign(mesh, groups, sums, faces);
}

} // namespace burnish
