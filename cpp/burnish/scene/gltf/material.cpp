#include "burnish/scene/gltf/material.h"

#include <algorithm>

#include "burnish/error.h"
#include "burnish/scene/gltf/image.h"

namespace burnish::gltf {
namespace {

/// Stands for "no upper limit": sums with 1 and small multiples stay finite.
constexpr float LARGEST = 3e38f;

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

double number_or(const tinygltf::Value& object, const char* name, double fallback) {
    return object.Has(name) ? object.Get(name).GetNumberAsDouble() : fallback;
}

std::vector<double> numbers_or(const tinygltf::Value& object, const char* name,
                               std::vector<double> fallback) {
    if (!object.Has(name)) return fallback;
    for (size_t i = 0; i < fallback.size(); ++i)
        fallback[i] = object.Get(name).Get(static_cast<int>(i)).GetNumberAsDouble();
    return fallback;
}

WrapMode wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return WrapMode::clamp_to_edge;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? WrapMode::mirrored_repeat : WrapMode::repeat;
}

TextureSampler sampler_of(const tinygltf::Sampler& from) {
    TextureSampler sampler;
    sampler.wrap_u = wrap_of(from.wrapS);
    sampler.wrap_v = wrap_of(from.wrapT);
    if (from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) sampler.magnify = TextureFilter::nearest;
    switch (from.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
        sampler.minify = TextureFilter::nearest;
        break;
    default:
        break;
    }
    switch (from.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
        sampler.mip = MipFilter::none;
        break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        sampler.mip = MipFilter::nearest;
        break;
    default:
        break;
    }
    return sampler;
}

} // namespace

void MaterialLoader::load() {
    for (size_t i = 0; i < document_.model.materials.size(); ++i) {
        const tinygltf::Material& from = document_.model.materials[i];
        scene_.materials.push_back(convert(from, from.name.empty() ? message("materials[", i, "]")
                                                                   : "material \"" + from.name + "\""));
    }
}

uint32_t MaterialLoader::find(int material, bool has_vertex_color) {
    auto known = variants_.find({material, has_vertex_color});
    if (known != variants_.end()) return known->second;
    uint32_t index;
    auto other = variants_.find({material, !has_vertex_color});
    if (other != variants_.end()) {
        index = static_cast<uint32_t>(scene_.materials.size());
        Material copy = scene_.materials[other->second];
        scene_.materials.push_back(std::move(copy));
    } else if (material >= 0) {
        index = static_cast<uint32_t>(material);
    } else {
        index = static_cast<uint32_t>(scene_.materials.size());
        scene_.materials.push_back(convert(tinygltf::Material{}, "default material"));
        scene_.materials.back().name = "default";
    }
    scene_.materials[index].source->has_vertex_color = has_vertex_color;
    variants_[{material, has_vertex_color}] = index;
    return index;
}

float MaterialLoader::bounded(double value, float low, float high, const std::string& where) {
    float number = static_cast<float>(value);
    if (number >= low && number <= high) return number;
    float clamped = std::clamp(number, low, high);
    warn(message(where, ": expected ", low, "..", high, ", got ", number, ": taken as ", clamped));
    return clamped;
}

glm::vec3 MaterialLoader::bounded(const std::vector<double>& values, float high, const std::string& where) {
    return {bounded(values[0], 0.0f, high, where), bounded(values[1], 0.0f, high, where),
            bounded(values[2], 0.0f, high, where)};
}

float MaterialLoader::factor_of(const tinygltf::Value& extension, const char* name, float fallback, float low,
                                float high, const std::string& where) {
    return bounded(number_or(extension, name, fallback), low, high, where + "." + name);
}

int32_t MaterialLoader::load_image(int index) {
    auto known = images_.find(index);
    if (known != images_.end()) return known->second;
    const tinygltf::Image& from = document_.model.images[index];
    std::string where = message("images[", index, "]");
    if (!from.name.empty()) where += " \"" + from.name + "\"";
    if (!from.uri.empty()) where += " " + short_uri(from.uri);
    int32_t found = -1;
    try {
        std::vector<uint8_t> bytes = from.bufferView >= 0
                                         ? reader_.read_view(from.bufferView, where)
                                         : read_uri(document_.folder, from.uri, MAX_IMAGE_BYTES);
        if (bytes.size() > MAX_IMAGE_BYTES)
            throw std::runtime_error(
                message("expected at most ", MAX_IMAGE_BYTES, " bytes, got ", bytes.size()));
        std::string converted;
        TextureImage image =
            decode_image(bytes, std::min(MAX_IMAGE_TEXELS, MAX_SCENE_TEXELS - texels_), converted);
        if (!converted.empty()) warn(where + ": " + converted);
        image.name = !from.name.empty()     ? from.name
                     : from.bufferView >= 0 ? message("image.", index)
                                            : short_uri(from.uri);
        texels_ += uint64_t{image.width} * image.height;
        found = static_cast<int32_t>(scene_.images.size());
        scene_.images.push_back(std::move(image));
    } catch (const FileError&) {
        throw; // the file contradicts itself
    } catch (const std::runtime_error& error) {
        warn(where + ": " + error.what() + ": its textures are left out, factors alone apply");
    }
    images_[index] = found;
    return found;
}

TextureUse MaterialLoader::convert_texture(int index, int uv_set, const tinygltf::ExtensionMap& extensions,
                                           const std::string& where) {
    TextureUse use;
    if (index < 0) return use;
    const tinygltf::Texture& texture = document_.model.textures[index];
    if (texture.source < 0) {
        warn(message(where, ": textures[", index,
                     "] has no PNG or JPEG source: left out, the factor alone applies"));
        return use;
    }
    if (texture.sampler >= 0) use.sampler = sampler_of(document_.model.samplers[texture.sampler]);
    if (const tinygltf::Value* transform = find_extension(extensions, "KHR_texture_transform")) {
        // uv' = offset + rotation * scale * uv. Seen with v downward the coordinates turn counter-clockwise,
        // as the extension says in words and as viewers draw its test scene; its GLSL, read by columns, would
        // turn the other way.
        std::vector<double> offset = numbers_or(*transform, "offset", {0, 0}),
                            scale = numbers_or(*transform, "scale", {1, 1});
        double rotation = number_or(*transform, "rotation", 0.0), c = std::cos(rotation),
               s = std::sin(rotation);
        use.uv_offset = {offset[0], offset[1]};
        use.uv_scale_rotation =
            glm::mat2(c * scale[0], -s * scale[0], s * scale[1], c * scale[1]); // by columns
        uv_set = static_cast<int>(number_or(*transform, "texCoord", uv_set));
    }
    if (uv_set > 1) {
        warn(message(where, ": expected texture coordinate set 0 or 1, got ", uv_set,
                     ": left out, the factor alone applies"));
        return TextureUse{};
    }
    use.uv_set = static_cast<uint32_t>(uv_set);
    use.image = load_image(texture.source);
    return use;
}

TextureUse MaterialLoader::texture_of(const tinygltf::Value& extension, const char* name,
                                      const std::string& where) {
    if (!extension.Has(name)) return {};
    const tinygltf::Value& info = extension.Get(name);
    tinygltf::ExtensionMap extensions;
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
        extensions["KHR_texture_transform"] = info.Get("extensions").Get("KHR_texture_transform");
    return convert_texture(info.Get("index").GetNumberAsInt(),
                           static_cast<int>(number_or(info, "texCoord", 0)), extensions, where + "." + name);
}

Material MaterialLoader::convert(const tinygltf::Material& from, const std::string& where) {
    Material material;
    material.name = from.name;
    MetallicRoughness source;
    source.model = model_;
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    source.base_color = glm::vec4(bounded(pbr.baseColorFactor, 1.0f, where + ".baseColorFactor"),
                                  bounded(pbr.baseColorFactor[3], 0.0f, 1.0f, where + ".baseColorFactor"));
    source.metallic = bounded(pbr.metallicFactor, 0.0f, 1.0f, where + ".metallicFactor");
    source.roughness = bounded(pbr.roughnessFactor, 0.0f, 1.0f, where + ".roughnessFactor");
    source.normal_scale = static_cast<float>(from.normalTexture.scale);
    source.occlusion_strength =
        bounded(from.occlusionTexture.strength, 0.0f, 1.0f, where + ".occlusionTexture.strength");
    auto texture = [&](const auto& info, const char* name) {
        return convert_texture(info.index, info.texCoord, info.extensions, where + "." + name);
    };
    source.base_color_texture = texture(pbr.baseColorTexture, "baseColorTexture");
    source.metallic_roughness_texture = texture(pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
    source.normal_texture = texture(from.normalTexture, "normalTexture");
    source.occlusion_texture = texture(from.occlusionTexture, "occlusionTexture");
    source.emissive_texture = texture(from.emissiveTexture, "emissiveTexture");

    if (!from.emissiveFactor.empty())
        material.emissive = bounded(from.emissiveFactor, 1.0f, where + ".emissiveFactor");
    material.double_sided = from.doubleSided;
    if (from.alphaMode == "MASK") {
        material.alpha_mode = AlphaMode::mask;
        material.alpha_cutoff = bounded(from.alphaCutoff, 0.0f, LARGEST, where + ".alphaCutoff");
    } else if (from.alphaMode == "BLEND") {
        material.alpha_mode = AlphaMode::blend;
        warn(where + ": alphaMode BLEND is drawn as MASK with cutoff 0.5");
    }
    material.source = source;
    read_extensions(from, material, where);
    map_metallic_roughness(material);
    return material;
}

void MaterialLoader::read_extensions(const tinygltf::Material& from, Material& material,
                                     const std::string& where) {
    MetallicRoughness& source = *material.source;
    if (auto* extension = find_extension(from.extensions, "KHR_materials_ior")) {
        double ior = number_or(*extension, "ior", 1.5);
        source.ior = ior == 0.0 ? 0.0f : bounded(ior, 1.0f, LARGEST, where + ".ior");
    }
    if (auto* extension = find_extension(from.extensions, "KHR_materials_specular")) {
        source.specular = factor_of(*extension, "specularFactor", 1.0f, 0.0f, 1.0f, where);
        source.specular_color = bounded(numbers_or(*extension, "specularColorFactor", {1, 1, 1}), LARGEST,
                                        where + ".specularColorFactor");
        source.specular_texture = texture_of(*extension, "specularTexture", where);
        source.specular_color_texture = texture_of(*extension, "specularColorTexture", where);
    }
    if (auto* extension = find_extension(from.extensions, "KHR_materials_anisotropy")) {
        source.anisotropy = factor_of(*extension, "anisotropyStrength", 0.0f, 0.0f, 1.0f, where);
        source.anisotropy_rotation = static_cast<float>(number_or(*extension, "anisotropyRotation", 0.0));
        source.anisotropy_texture = texture_of(*extension, "anisotropyTexture", where);
    }
    if (auto* extension = find_extension(from.extensions, "KHR_materials_clearcoat")) {
        source.clearcoat = factor_of(*extension, "clearcoatFactor", 0.0f, 0.0f, 1.0f, where);
        source.clearcoat_roughness =
            factor_of(*extension, "clearcoatRoughnessFactor", 0.0f, 0.0f, 1.0f, where);
        source.clearcoat_texture = texture_of(*extension, "clearcoatTexture", where);
        source.clearcoat_roughness_texture = texture_of(*extension, "clearcoatRoughnessTexture", where);
        source.clearcoat_normal_texture = texture_of(*extension, "clearcoatNormalTexture", where);
        if (extension->Has("clearcoatNormalTexture"))
            source.clearcoat_normal_scale =
                static_cast<float>(number_or(extension->Get("clearcoatNormalTexture"), "scale", 1.0));
    }
    if (auto* extension = find_extension(from.extensions, "KHR_materials_sheen")) {
        const std::vector<double> color = numbers_or(*extension, "sheenColorFactor", {0, 0, 0});
        source.sheen_color = bounded(color, 1.0f, where + ".sheenColorFactor");
        source.sheen_roughness = factor_of(*extension, "sheenRoughnessFactor", 0.0f, 0.0f, 1.0f, where);
        for (const char* name : {"sheenColorTexture", "sheenRoughnessTexture"})
            if (extension->Has(name)) warn(where + "." + name + ": not read, its factor holds everywhere");
        if (model_ == MaterialModel::kurt) warn(where + ": model \"kurt\" is drawn without sheen");
    }
    if (auto* extension = find_extension(from.extensions, "KHR_materials_emissive_strength")) {
        float strength = factor_of(*extension, "emissiveStrength", 1.0f, 0.0f, LARGEST, where);
        material.emissive = glm::min(material.emissive * strength, glm::vec3(LARGEST));
    }
    if (find_extension(from.extensions, "KHR_materials_unlit")) {
        // The base colour shines and nothing reflects; its texture stays for the coverage in its alpha.
        // Vertex colours multiply what shines (`is_unlit`).
        material.emissive = glm::vec3(source.base_color);
        MetallicRoughness dark;
        dark.base_color = glm::vec4(0.0f, 0.0f, 0.0f, source.base_color.w);
        dark.metallic = dark.specular = 0.0f;
        dark.is_unlit = true;
        dark.base_color_texture = dark.emissive_texture = source.base_color_texture;
        source = dark;
    }
}

} // namespace burnish::gltf
