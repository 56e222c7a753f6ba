#include "burnish/scene/gltf/schema.h"

namespace burnish::gltf {
namespace {

Property required(Property property) {
    property.is_required = true;
    return property;
}
Property text(std::string name, std::vector<std::string> words = {}) {
    return {.name = std::move(name), .kind = Kind::text, .words = std::move(words)};
}
Property boolean(std::string name) {
    return {.name = std::move(name), .kind = Kind::boolean};
}
Property number(std::string name) {
    return {.name = std::move(name), .kind = Kind::number};
}
Property count(std::string name, int minimum = 0) {
    return {.name = std::move(name), .kind = Kind::count, .minimum = minimum};
}
Property choice(std::string name, std::vector<long long> choices) {
    return {.name = std::move(name), .kind = Kind::count, .choices = std::move(choices)};
}
Property index(std::string name, std::string target) {
    return {.name = std::move(name), .kind = Kind::index, .target = std::move(target)};
}
Property indices(std::string name, std::string target) {
    return {.name = std::move(name), .kind = Kind::indices, .target = std::move(target)};
}
Property numbers(std::string name, unsigned length) {
    return {.name = std::move(name), .kind = Kind::numbers, .length = length};
}
Property object(std::string name, Properties members) {
    return {.name = std::move(name), .kind = Kind::object, .members = std::move(members)};
}
Property objects(std::string name, Properties members) {
    return {.name = std::move(name), .kind = Kind::objects, .members = std::move(members)};
}

Property texture(std::string name, Properties more = {}) {
    Properties members = {
        required(index("index", "textures")), count("texCoord"),
        object("extensions", {object("KHR_texture_transform", {numbers("offset", 2), number("rotation"),
                                                               numbers("scale", 2), count("texCoord")})})};
    members.insert(members.end(), more.begin(), more.end());
    return object(std::move(name), std::move(members));
}

Property material_extensions() {
    return object(
        "extensions",
        {object("KHR_materials_unlit", {}), object("KHR_materials_ior", {number("ior")}),
         object("KHR_materials_emissive_strength", {number("emissiveStrength")}),
         object("KHR_materials_specular",
                {number("specularFactor"), texture("specularTexture"), numbers("specularColorFactor", 3),
                 texture("specularColorTexture")}),
         object("KHR_materials_anisotropy",
                {number("anisotropyStrength"), number("anisotropyRotation"), texture("anisotropyTexture")}),
         object("KHR_materials_sheen", {numbers("sheenColorFactor", 3), texture("sheenColorTexture"),
                                        number("sheenRoughnessFactor"), texture("sheenRoughnessTexture")}),
         object("KHR_materials_clearcoat",
                {number("clearcoatFactor"), texture("clearcoatTexture"), number("clearcoatRoughnessFactor"),
                 texture("clearcoatRoughnessTexture"),
                 texture("clearcoatNormalTexture", {number("scale")})})});
}

Property materials() {
    return objects(
        "materials",
        {text("name"),
         object("pbrMetallicRoughness",
                {numbers("baseColorFactor", 4), texture("baseColorTexture"), number("metallicFactor"),
                 number("roughnessFactor"), texture("metallicRoughnessTexture")}),
         texture("normalTexture", {number("scale")}), texture("occlusionTexture", {number("strength")}),
         texture("emissiveTexture"), numbers("emissiveFactor", 3),
         text("alphaMode", {"OPAQUE", "MASK", "BLEND"}), number("alphaCutoff"), boolean("doubleSided"),
         material_extensions()});
}

Property accessors() {
    const std::vector<long long> index_types = {5121, 5123, 5125};
    return objects(
        "accessors",
        {index("bufferView", "bufferViews"), count("byteOffset"),
         required(choice("componentType", {5120, 5121, 5122, 5123, 5125, 5126})), boolean("normalized"),
         required(count("count", 1)),
         required(text("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"})),
         object("sparse", {required(count("count", 1)),
                           required(object("indices",
                                           {required(index("bufferView", "bufferViews")), count("byteOffset"),
                                            required(choice("componentType", index_types))})),
                           required(object("values", {required(index("bufferView", "bufferViews")),
                                                      count("byteOffset")}))})});
}

Property meshes() {
    return objects(
        "meshes",
        {text("name"), numbers("weights", 0),
         required(objects("primitives",
                          {required({.name = "attributes", .kind = Kind::index_map, .target = "accessors"}),
                           index("indices", "accessors"),
                           index("material", "materials"),
                           choice("mode", {0, 1, 2, 3, 4, 5, 6}),
                           {.name = "targets", .kind = Kind::index_maps, .target = "accessors"}}))});
}

Property nodes() {
    const Property instancing = object(
        "EXT_mesh_gpu_instancing", {{.name = "attributes", .kind = Kind::index_map, .target = "accessors"}});
    return objects(
        "nodes",
        {text("name"), index("camera", "cameras"), indices("children", "nodes"), index("skin", "skins"),
         index("mesh", "meshes"), numbers("matrix", 16), numbers("rotation", 4), numbers("scale", 3),
         numbers("translation", 3), numbers("weights", 0),
         object("extensions",
                {instancing, object("KHR_lights_punctual", {required(index("light", "lights"))})})});
}

Property root_extensions() {
    return object(
        "extensions",
        {object(
            "KHR_lights_punctual",
            {objects("lights", {text("name"), required(text("type")), numbers("color", 3),
                                number("intensity"), number("range"),
                                object("spot", {number("innerConeAngle"), number("outerConeAngle")})})})});
}

Property cameras() {
    return objects("cameras",
                   {text("name"), required(text("type", {"perspective", "orthographic"})),
                    object("perspective", {required(number("yfov")), required(number("znear")),
                                           number("zfar"), number("aspectRatio")}),
                    object("orthographic", {required(number("xmag")), required(number("ymag")),
                                            required(number("znear")), required(number("zfar"))})});
}

} // namespace

const Properties& root_properties() {
    static const Properties properties = {
        required(object("asset", {required(text("version")), text("minVersion")})),
        {.name = "extensionsUsed", .kind = Kind::texts},
        {.name = "extensionsRequired", .kind = Kind::texts},
        objects("buffers", {text("uri"), required(count("byteLength", 1)), text("name")}),
        objects("bufferViews", {required(index("buffer", "buffers")), count("byteOffset"),
                                required(count("byteLength", 1)), count("byteStride", 1)}),
        accessors(),
        objects("images", {text("uri"), text("mimeType"), index("bufferView", "bufferViews"), text("name")}),
        objects("samplers",
                {choice("magFilter", {9728, 9729}), choice("minFilter", {9728, 9729, 9984, 9985, 9986, 9987}),
                 choice("wrapS", {10497, 33071, 33648}), choice("wrapT", {10497, 33071, 33648})}),
        objects("textures", {index("sampler", "samplers"), index("source", "images"), text("name")}),
        materials(),
        meshes(),
        nodes(),
        cameras(),
        root_extensions(),
        objects("scenes", {indices("nodes", "nodes"), text("name")}),
        index("scene", "scenes"),
        objects("skins", {text("name"), index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                          required(indices("joints", "nodes"))}),
        // Only counted: they make a note that they are not played.
        objects("animations", {})};
    return properties;
}

} // namespace burnish::gltf
