// Which glTF extensions are read, and what a file that uses another one is drawn as; used by the gltf_*.cpp
// files only.
#pragma once

#include <string>
#include <vector>

#include "burnish/scene/gltf/document.h"

namespace burnish::gltf {

/// Throws FileError where an extension is required that is not read. Of those that are used and not read,
/// notes the names in the document, and warns of each that changes the picture, saying what is drawn instead.
void check_extensions(Document& document, const std::vector<std::string>& required,
                      const std::vector<std::string>& used);

} // namespace burnish::gltf
