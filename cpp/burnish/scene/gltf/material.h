// Materials, textures and pictures of a glTF file; used by the gltf_*.cpp files only.
#pragma once

#include <map>

#include "burnish/scene/gltf/accessor.h"
#include "burnish/scene/scene.h"

namespace burnish::gltf {

class MaterialLoader {
public:
    MaterialLoader(const Document& document, const AccessorReader& reader, MaterialModel model, Scene& scene)
        : document_(document), reader_(reader), model_(model), scene_(scene) {}

    /// Appends all materials of the file to the scene, in its order.
    void load();

    /// Index in the scene of a file's material (-1: glTF's default) for a mesh with or without vertex
    /// colours.
    uint32_t find(int material, bool has_vertex_color);

private:
    Material convert(const tinygltf::Material& from, const std::string& where);
    void read_extensions(const tinygltf::Material& from, Material& material, const std::string& where);
    TextureUse convert_texture(int index, int uv_set, const tinygltf::ExtensionMap& extensions,
                               const std::string& where);
    TextureUse texture_of(const tinygltf::Value& extension, const char* name, const std::string& where);
    float factor_of(const tinygltf::Value& extension, const char* name, float fallback, float low, float high,
                    const std::string& where);
    float bounded(double value, float low, float high, const std::string& where);
    glm::vec3 bounded(const std::vector<double>& values, float high, const std::string& where);
    int32_t load_image(int image);
    void warn(const std::string& sentence) { scene_.warnings.push_back(sentence); }

    const Document& document_;
    const AccessorReader& reader_;
    MaterialModel model_;
    Scene& scene_;
    std::map<int, int32_t> images_; ///< file's image to scene's, -1 where it cannot be used
    uint64_t texels_ = 0;           ///< decoded so far
    std::map<std::pair<int, bool>, uint32_t> variants_;
};

} // namespace burnish::gltf
