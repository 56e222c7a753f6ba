#include "burnish/scene/gltf/extensions.h"

#include <algorithm>
#include <map>
#include <set>

#include "burnish/error.h"

namespace burnish::gltf {
namespace {

const std::set<std::string> SUPPORTED = {"KHR_materials_specular",
                                         "KHR_materials_ior",
                                         "KHR_materials_clearcoat",
                                         "KHR_materials_anisotropy",
                                         "KHR_materials_unlit",
                                         "KHR_texture_transform",
                                         "KHR_materials_emissive_strength",
                                         "KHR_mesh_quantization",
                                         "EXT_mesh_gpu_instancing",
                                         "KHR_lights_punctual",
                                         "KHR_materials_sheen"};

/// They hold metadata, other choices than the file's own, behaviour over time, or a second encoding of data
/// that the file has to give plainly too where it does not require the extension.
const std::set<std::string> WITHOUT_EFFECT = {"AGI_articulations",
                                              "AGI_stk_metadata",
                                              "EXT_feature_metadata",
                                              "EXT_instance_features",
                                              "EXT_mesh_features",
                                              "EXT_mesh_manifold",
                                              "EXT_meshopt_compression",
                                              "EXT_structural_metadata",
                                              "EXT_texture_avif",
                                              "EXT_texture_webp",
                                              "FB_ngon_encoding",
                                              "GODOT_single_root",
                                              "KHR_animation_pointer",
                                              "KHR_audio_emitter",
                                              "KHR_draco_mesh_compression",
                                              "KHR_implicit_shapes",
                                              "KHR_interactivity",
                                              "KHR_materials_variants",
                                              "KHR_meshopt_compression",
                                              "KHR_node_hoverability",
                                              "KHR_node_selectability",
                                              "KHR_physics_rigid_bodies",
                                              "KHR_texture_basisu",
                                              "KHR_xmp",
                                              "KHR_xmp_json_ld",
                                              "MSFT_lod",
                                              "MSFT_packing_normalRoughnessMetallic",
                                              "MSFT_packing_occlusionRoughnessMetallic",
                                              "MSFT_texture_dds",
                                              "VRMC_node_constraint",
                                              "VRMC_springBone"};

const char* const BY_METALLIC_ROUGHNESS =
    "its materials are drawn by their metallic-roughness factors, glTF's defaults where the file gives none";

const std::map<std::string, std::string> DRAWN_INSTEAD = {
    {"ADOBE_materials_clearcoat_specular", "coats are drawn with the reflectance of ior 1.5"},
    {"ADOBE_materials_clearcoat_tint", "coats are drawn without colour"},
    {"ADOBE_materials_thin_transparency", "its materials are drawn opaque"},
    {"CESIUM_primitive_outline", "outlines are not drawn"},
    {"EXT_lights_ies", "its lights are not drawn: the scene's environment is all its light"},
    {"EXT_lights_image_based", "its environment is not read: the scene's environment is all its light"},
    {"KHR_gaussian_splatting", "splats are not drawn"},
    {"KHR_materials_diffuse_transmission", "its materials are drawn opaque"},
    {"KHR_materials_dispersion", "its materials are drawn without dispersion"},
    {"KHR_materials_iridescence", "its materials are drawn without the colours of a thin film"},
    {"KHR_materials_pbrSpecularGlossiness", BY_METALLIC_ROUGHNESS},
    {"KHR_materials_subsurface", "its materials are drawn opaque"},
    {"KHR_materials_transmission", "its materials are drawn opaque"},
    {"KHR_materials_volume", "its materials are drawn as surfaces, nothing is refracted or absorbed inside"},
    {"KHR_materials_volume_scatter", "its materials are drawn as surfaces, nothing is scattered inside"},
    {"KHR_node_visibility", "hidden nodes are drawn like all others"},
    {"KHR_techniques_webgl", BY_METALLIC_ROUGHNESS},
    {"NV_materials_mdl", BY_METALLIC_ROUGHNESS},
    {"VRMC_materials_mtoon", BY_METALLIC_ROUGHNESS}};

/// The end of a sentence that begins with the extension's name; empty for those that change no picture.
std::string drawn_instead_of(const std::string& name) {
    if (WITHOUT_EFFECT.count(name)) return "";
    const auto known = DRAWN_INSTEAD.find(name);
    return known != DRAWN_INSTEAD.end() ? known->second : "not known here, drawn as if it were not there";
}

} // namespace

void check_extensions(Document& document, const std::vector<std::string>& required,
                      const std::vector<std::string>& used) {
    std::string refused;
    for (const std::string& name : required)
        if (!SUPPORTED.count(name)) refused += (refused.empty() ? "" : ", ") + name;
    if (!refused.empty())
        throw FileError(document.path,
                        "extensionsRequired: expected only extensions Burnish knows, got " + refused);
    std::vector<std::string>& ignored = document.ignored_extensions;
    for (const std::string& name : used) {
        if (SUPPORTED.count(name) || std::count(ignored.begin(), ignored.end(), name)) continue;
        ignored.push_back(name);
        const std::string instead = drawn_instead_of(name);
        if (!instead.empty()) document.warnings.push_back(name + ": " + instead);
    }
}

} // namespace burnish::gltf
