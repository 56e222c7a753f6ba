// Triangles of a glTF file; used by the gltf_*.cpp files only.
#pragma once

#include <optional>

#include "burnish/scene/gltf/skin.h"
#include "burnish/scene/scene.h"

namespace burnish::gltf {

/// Reads positions, indices, normals, texture coordinates, colours and given tangents of a primitive:
/// triangles of its strips and fans, every normal of unit length. Nothing, and a warning, where there are no
/// triangles. With a skin (else null) vertices that have joints are placed by them, in the world's axes and
/// relative to the skin's origin.
std::optional<Mesh> load_primitive(const Document& document, AccessorReader& reader,
                                   const tinygltf::Primitive& primitive, const Skin* skin,
                                   const std::string& where, std::vector<std::string>& warnings);

/// Adds the texture coordinates and tangents that the material reads and the file lacks.
void complete_mesh(Mesh& mesh, const Material& material, AccessorReader& reader, const std::string& where,
                   std::vector<std::string>& warnings);

} // namespace burnish::gltf
