// The nodes of a glTF file: which are drawn, and where each stands in the world; used by the gltf_*.cpp files
// only.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/scene/gltf/accessor.h"

namespace burnish::gltf {

class NodeTree {
public:
    /// Throws FileError unless every node has at most one parent, none is among its own descendants, and the
    /// scene lists each of its roots once.
    explicit NodeTree(const Document& document);

    /// The nodes of the file's scene, depth first.
    std::vector<int> drawn() const;
    /// In double precision, parents multiplied in.
    const glm::dmat4& world_from_node(int node) const { return world_from_node_[node]; }

private:
    std::vector<int> find_roots() const;
    std::vector<int> scene_roots(const std::vector<int>& roots) const;

    const Document& document_;
    std::vector<int> scene_roots_;
    std::vector<glm::dmat4> world_from_node_;
};

/// Where the instances of a node stand relative to it (EXT_mesh_gpu_instancing); one identity where it has
/// none.
std::vector<glm::dmat4> node_from_instances(const Document& document, AccessorReader& reader, int node);

/// Throws FileError unless the matrix is affine and its numbers fit into 32-bit floats.
void require_affine(const Document& document, const glm::dmat4& matrix, const std::string& where);

} // namespace burnish::gltf
