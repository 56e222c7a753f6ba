// The lobes a material may have: each model is one file, and a name in this list.
#pragma once

#include <string>
#include <variant>

#include "burnish/lobe/ggx.h"
#include "burnish/lobe/kurt.h"
#include "burnish/lobe/lafortune.h"
#include "burnish/lobe/sheen.h"

namespace burnish {

using Lobe = std::variant<KurtLobe, GgxLobe, LafortuneLobe, SheenLobe>;

/// Throws std::invalid_argument, naming field, range and value; `prefix` goes before the field's name.
inline void validate(const Lobe& lobe, const std::string& prefix = "") {
    std::visit([&](const auto& one) { validate(one, prefix); }, lobe);
}
inline LobeFacts facts(const Lobe& lobe) {
    return std::visit([](const auto& one) { return facts(one); }, lobe);
}
/// Kernels read this of it, besides its tables.
inline shared::LobeRecord record(const Lobe& lobe) {
    return std::visit([](const auto& one) { return record(one); }, lobe);
}
/// The same lobe of another colour.
inline Lobe with_weight(const Lobe& lobe, glm::vec3 weight) {
    return std::visit(
        [&](auto one) {
            one.weight = weight;
            return Lobe(one);
        },
        lobe);
}

} // namespace burnish
