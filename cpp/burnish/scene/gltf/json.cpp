// From JSON text to a checked model. tinygltf trusts indices and sizes and drops what it does not understand,
// so the text is held against gltf_schema.cpp first, and buffers and pictures are kept away from it.
#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "burnish/error.h"
#include "burnish/scene/gltf/document.h"
#include "burnish/scene/gltf/extensions.h"
#include "burnish/scene/gltf/schema.h"

namespace burnish::gltf {
namespace {

using nlohmann::json;

constexpr size_t MAX_DEPTH = 64;
constexpr long long MAX_COUNT = 2147483647;
constexpr size_t MAX_ENTITIES = 1u << 17; ///< of one kind; tinygltf's structures take up to 2 KB each
constexpr size_t MAX_NODES = 1u << 19;

/// Bounds nesting and the number of values before anything is built from the text.
void scan(const std::string& path, const std::string& text) {
    if (text.size() > MAX_JSON_BYTES)
        throw FileError(path,
                        message("JSON: expected at most ", MAX_JSON_BYTES, " bytes, got ", text.size()));
    size_t depth = 0, values = 0;
    bool is_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (is_string) {
            if (c == '\\') ++i;
            if (c == '"') is_string = false;
            continue;
        }
        if (c == '"') is_string = true;
        if (c == '{' || c == '[') ++depth, ++values;
        if (c == ',') ++values;
        if ((c == '}' || c == ']') && depth > 0) --depth;
        if (depth > MAX_DEPTH)
            throw FileError(path, message("JSON: expected at most ", MAX_DEPTH, " levels, got more"));
        if (values > MAX_JSON_VALUES)
            throw FileError(path, message("JSON: expected at most ", MAX_JSON_VALUES, " values, got more"));
    }
}

/// Holds a value against its property; drops what is not listed.
class Checker {
public:
    Checker(const std::string& path, const json& root) : path_(path) {
        // Sizes are taken first: checking changes the values.
        for (const auto& [name, value] : root.items())
            if (value.is_array()) sizes_[name] = value.size();
        const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
        if (root.contains(lights) && root[lights].is_array()) sizes_["lights"] = root[lights].size();
    }

    void check_members(json& object, const Properties& members, const std::string& where) const {
        for (const Property& member : members) {
            auto found = object.find(member.name);
            std::string name = where.empty() ? member.name : where + "." + member.name;
            if (found != object.end())
                check(*found, member, name);
            else if (member.is_required)
                fail(name, "a value", "none");
        }
        for (auto entry = object.begin(); entry != object.end();) {
            bool is_listed = std::any_of(members.begin(), members.end(),
                                         [&](const Property& member) { return member.name == entry.key(); });
            entry = is_listed ? std::next(entry) : object.erase(entry);
        }
    }

private:
    [[noreturn]] void fail(const std::string& where, const std::string& expected,
                           const std::string& got) const {
        throw FileError(path_, where + ": expected " + expected + ", got " + got);
    }

    void require(bool is_right, const std::string& where, const char* expected, const json& value) const {
        if (is_right) return;
        std::string got = value.dump(-1, ' ', false, json::error_handler_t::replace);
        fail(where, expected, got.size() > 60 ? got.substr(0, 57) + "..." : got);
    }

    void check_number(json& value, const std::string& where) const {
        require(value.is_number() && std::isfinite(value.get<double>()), where, "a finite number", value);
        require(std::abs(value.get<double>()) <= 3.4e38, where, "a number that fits 32-bit floats", value);
        value = value.get<double>(); // tinygltf would cut large integers
    }

    void check_index(const json& value, const std::string& target, const std::string& where) const {
        auto size = sizes_.find(target);
        size_t count = size == sizes_.end() ? 0 : size->second;
        require(value.is_number_unsigned() && value.get<uint64_t>() < count, where,
                message("an index below ", count, " ", target).c_str(), value);
    }

    void check_index_map(const json& value, const std::string& target, const std::string& where) const {
        require(value.is_object(), where, "an object", value);
        for (const auto& [key, index] : value.items())
            check_index(index, target, where + "." + key);
    }

    void check_array(json& value, const Property& property, const std::string& where) const {
        require(value.is_array(), where, "an array", value);
        size_t limit = property.name == "nodes" || property.kind != Kind::objects ? MAX_NODES : MAX_ENTITIES;
        if (property.kind != Kind::indices && value.size() > limit)
            fail(where, message("at most ", limit, " entries"), message(value.size()));
        for (size_t i = 0; i < value.size(); ++i) {
            std::string item = message(where, "[", i, "]");
            switch (property.kind) {
            case Kind::numbers:
                check_number(value[i], item);
                break;
            case Kind::indices:
                check_index(value[i], property.target, item);
                break;
            case Kind::index_maps:
                check_index_map(value[i], property.target, item);
                break;
            case Kind::texts:
                require(value[i].is_string(), item, "a string", value[i]);
                break;
            default:
                require(value[i].is_object(), item, "an object", value[i]);
                check_members(value[i], property.members, item);
            }
        }
    }

    void check_count(const json& value, const Property& property, const std::string& where) const {
        require(value.is_number_integer(), where, "an integer", value);
        require(value.is_number_unsigned() && value.get<uint64_t>() <= MAX_COUNT &&
                    value.get<int64_t>() >= property.minimum,
                where, message("an integer in ", property.minimum, "..", MAX_COUNT).c_str(), value);
        if (property.choices.empty()) return;
        std::string list;
        for (long long choice : property.choices)
            list += message(list.empty() ? "one of " : ", ", choice);
        require(std::count(property.choices.begin(), property.choices.end(), value.get<int64_t>()) > 0, where,
                list.c_str(), value);
    }

    void check_text(const json& value, const Property& property, const std::string& where) const {
        require(value.is_string(), where, "a string", value);
        if (property.words.empty()) return;
        std::string list;
        for (const std::string& word : property.words)
            list += (list.empty() ? "one of " : ", ") + word;
        require(std::count(property.words.begin(), property.words.end(), value.get<std::string>()) > 0, where,
                list.c_str(), value);
    }

    void check(json& value, const Property& property, const std::string& where) const {
        switch (property.kind) {
        case Kind::text:
            check_text(value, property, where);
            break;
        case Kind::boolean:
            require(value.is_boolean(), where, "true or false", value);
            break;
        case Kind::number:
            check_number(value, where);
            break;
        case Kind::count:
            check_count(value, property, where);
            break;
        case Kind::index:
            check_index(value, property.target, where);
            break;
        case Kind::index_map:
            check_index_map(value, property.target, where);
            break;
        case Kind::object:
            require(value.is_object(), where, "an object", value);
            check_members(value, property.members, where);
            break;
        case Kind::numbers:
            check_array(value, property, where);
            if (property.length && value.size() != property.length)
                fail(where, message(property.length, " numbers"), message(value.size()));
            break;
        default:
            check_array(value, property, where);
        }
    }

    const std::string& path_;
    std::map<std::string, size_t> sizes_;
};

void check_version(const std::string& path, const json& asset) {
    // "2.x", and a minVersion, where there is one, that this reader satisfies.
    std::string version = asset["version"];
    bool is_2 = version.rfind("2.", 0) == 0 && version.size() > 2 &&
                version.find_first_not_of("0123456789", 2) == std::string::npos;
    if (!is_2) throw FileError(path, "asset.version: expected 2.x, got \"" + version + "\"");
    std::string minimum = asset.value("minVersion", "2.0");
    if (minimum != "2.0")
        throw FileError(path, "asset.minVersion: expected at most 2.0, got \"" + minimum + "\"");
}

/// Takes buffers and pictures out of the JSON, so that tinygltf opens no files and decodes nothing, and
/// skins, of which it demands inverse bind matrices.
void move_sources(Document& document, json& root) {
    for (json& buffer : root.value("buffers", json::array())) {
        document.buffer_bytes.push_back(buffer["byteLength"]);
        tinygltf::Buffer entry;
        entry.uri = buffer.value("uri", "");
        document.model.buffers.push_back(std::move(entry));
    }
    for (json& image : root.value("images", json::array())) {
        tinygltf::Image entry;
        entry.uri = image.value("uri", "");
        entry.name = image.value("name", "");
        entry.bufferView = image.value("bufferView", -1);
        document.model.images.push_back(std::move(entry));
    }
    for (json& skin : root.value("skins", json::array())) {
        tinygltf::Skin entry;
        entry.inverseBindMatrices = skin.value("inverseBindMatrices", -1);
        entry.joints = skin["joints"].get<std::vector<int>>();
        document.model.skins.push_back(std::move(entry));
    }
    for (const char* name : {"buffers", "images", "skins", "animations"})
        root.erase(name);
}

/// Index accessors by mesh and primitive, taken out of the JSON: tinygltf refuses one without a buffer view,
/// which is valid glTF (all zero, or sparse).
std::vector<std::vector<int>> take_indices(json& root) {
    std::vector<std::vector<int>> taken;
    if (!root.count("meshes")) return taken;
    for (json& mesh : root["meshes"]) {
        taken.emplace_back();
        for (json& primitive : mesh["primitives"]) {
            taken.back().push_back(primitive.value("indices", -1));
            primitive.erase("indices");
        }
    }
    return taken;
}

} // namespace

Document parse_document(const std::string& path, const std::string& text) {
    scan(path, text);
    Document document;
    document.path = path;
    document.folder = std::filesystem::path(path).parent_path();
    json root;
    try {
        root = json::parse(text);
    } catch (const json::exception& error) {
        // The library's text begins with an identifier in brackets that says nothing to a reader.
        std::string reason = error.what();
        throw FileError(path, "JSON: " + reason.substr(reason.find("] ") + 2, 200));
    }
    if (!root.is_object()) throw FileError(path, "JSON: expected an object, got another value");
    Checker(path, root).check_members(root, root_properties(), "");
    check_version(path, root["asset"]);
    const std::vector<std::string> none;
    check_extensions(document, root.value("extensionsRequired", none), root.value("extensionsUsed", none));
    if (root.count("animations") && !root["animations"].empty())
        document.warnings.push_back("animations are not played: the scene is drawn as it stands");
    move_sources(document, root);
    std::vector<std::vector<int>> indices = take_indices(root);

    tinygltf::Model structure;
    tinygltf::TinyGLTF reader;
    std::string errors, warnings;
    std::string checked = root.dump(-1, ' ', false, json::error_handler_t::replace);
    root = {};
    bool is_read = reader.LoadASCIIFromString(&structure, &errors, &warnings, checked.data(),
                                              static_cast<unsigned>(checked.size()), "");
    if (!is_read || !errors.empty()) {
        while (!errors.empty() && (errors.back() == '\n' || errors.back() == ' '))
            errors.pop_back();
        std::replace(errors.begin(), errors.end(), '\n', ' ');
        throw FileError(path, errors.empty() ? "cannot be read as glTF" : errors);
    }
    for (size_t mesh = 0; mesh < indices.size(); ++mesh)
        for (size_t primitive = 0; primitive < indices[mesh].size(); ++primitive)
            structure.meshes.at(mesh).primitives.at(primitive).indices = indices[mesh][primitive];
    structure.buffers = std::move(document.model.buffers);
    structure.images = std::move(document.model.images);
    structure.skins = std::move(document.model.skins);
    document.model = std::move(structure);
    return document;
}

} // namespace burnish::gltf
