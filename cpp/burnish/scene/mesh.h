// Triangles as plain data. One mesh is one glTF primitive: one material.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions; ///< object space, finite
    std::vector<glm::vec3> normals;   ///< as many as positions, unit length
    std::vector<glm::vec4>
        tangents; ///< as many as positions, or empty; w = +-1: bitangent = w cross(normal, tangent)
    std::vector<glm::vec2> uv0;    ///< as many as positions, or empty
    std::vector<glm::vec2> uv1;    ///< as many as positions, or empty
    std::vector<glm::vec4> colors; ///< linear RGBA, as many as positions, or empty
    std::vector<uint32_t>
        indices; ///< three per triangle, counter-clockwise seen from the front, all < positions.size()
};

/// Throws std::invalid_argument, naming the array, unless sizes agree, indices are in range and numbers
/// finite.
void validate(const Mesh& mesh);

/// Normals as the area-weighted mean of the faces around each vertex; a vertex in no face of area gets +z.
void compute_normals(Mesh& mesh);

/// One normal per face, as glTF asks where normals are absent: every triangle gets vertices of its own.
/// Triangles without area are left out.
void compute_flat_normals(Mesh& mesh);

/// Tangents along growing u by MikkTSpace's rules (maths in the .cpp). Splits vertices where they must
/// differ. w = -1 where v grows along cross(normal, tangent): glTF's green points up. Needs uv (`uv_set` 0 or
/// 1) and normals; throws std::invalid_argument where they are absent. (u, v) = uv_scale_rotation * uv, as a
/// texture reads them (TextureUse): where it is turned or mirrored, so are its tangents.
void compute_tangents(Mesh& mesh, uint32_t uv_set, const glm::mat2& uv_scale_rotation = glm::mat2(1.0f));

/// Tangents for meshes without texture coordinates: around the object's y axis (longitude), as turned metal
/// is brushed.
void compute_tangents_around_y(Mesh& mesh);

Mesh make_sphere(float radius,
                 uint32_t segments); ///< latitude-longitude, poles on y, tangents along longitude, uv
Mesh make_plane(float size, uint32_t segments); ///< in xz, normal +y, tangent +x, uv
Mesh make_torus(float radius, float tube_radius, uint32_t segments);
/// A body of revolution about y with a groove and a foot, in the spirit of look-development balls.
Mesh make_shader_ball(uint32_t segments);

} // namespace burnish
