// Which JSON properties of glTF 2.0 are read, and what each must be; used by gltf_json.cpp only.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace burnish::gltf {

enum class Kind {
    text,
    boolean,
    number,     ///< finite
    count,      ///< integer in minimum..2^31 - 1
    index,      ///< into the top-level array `target`
    numbers,    ///< array of `length` numbers; any length when 0
    indices,    ///< array of indices into `target`
    index_map,  ///< object of name: index into `target`
    index_maps, ///< array of those
    object,
    objects, ///< array of objects
    texts    ///< array of strings
};

struct Property;
using Properties = std::vector<Property>;

struct Property {
    std::string name;
    Kind kind;
    bool is_required = false;
    std::string target{};             ///< index kinds
    Properties members{};             ///< object kinds
    unsigned length = 0;              ///< numbers
    int minimum = 0;                  ///< count
    std::vector<long long> choices{}; ///< count: the values allowed; any when empty
    std::vector<std::string> words{}; ///< text: the values allowed; any when empty
};

/// The root object. Properties that are not listed have no effect here and are dropped.
const Properties& root_properties();

} // namespace burnish::gltf
