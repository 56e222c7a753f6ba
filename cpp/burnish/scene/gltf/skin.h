// Vertices that joints place (glTF 2.0, section 3.7.3.3); used by the gltf_*.cpp files only.
#pragma once

#include <string>
#include <vector>

#include "burnish/scene/gltf/nodes.h"
#include "burnish/scene/mesh.h"

namespace burnish::gltf {

/// The joints of a skin in the pose that the file's nodes stand in.
class Skin {
public:
    /// Throws FileError where there are fewer inverse bind matrices than joints, or a matrix is not affine.
    Skin(const Document& document, AccessorReader& reader, const NodeTree& nodes, int skin);

    /// World transform of joint times inverse bind matrix, per joint.
    const std::vector<glm::dmat4>& world_from_bind() const { return world_from_bind_; }
    /// Where the first joint stands: vertices are kept relative to it, so that 32-bit floats hold them.
    const glm::dvec3& origin() const { return origin_; }

private:
    std::vector<glm::dmat4> world_from_bind_;
    glm::dvec3 origin_{0.0};
};

/// The vertices of one primitive, as the joints of a skin place them.
class SkinnedVertices {
public:
    /// Throws FileError where joints or weights contradict the skin or the number of vertices.
    SkinnedVertices(const Document& document, AccessorReader& reader, const Skin& skin,
                    const tinygltf::Primitive& primitive, size_t vertex_count, const std::string& where,
                    std::vector<std::string>& warnings);

    /// Mean of the joints' matrices by their weights, relative to the skin's origin.
    glm::dmat4 matrix(size_t vertex) const;

private:
    const Skin& skin_;
    std::vector<std::vector<glm::vec4>> joints_, weights_; // by set of four
};

bool has_joints(const tinygltf::Primitive& primitive);

/// Moves the vertices. Normals go by the cofactors of the matrix, tangents by the matrix; a triangle whose
/// corners are all mirrored is turned around, so that its front stays its front.
void place_by_joints(Mesh& mesh, const SkinnedVertices& skinned);

} // namespace burnish::gltf
