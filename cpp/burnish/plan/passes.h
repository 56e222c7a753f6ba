// Passes of a plan, in their order: reports list them, and the renderer runs them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace burnish {

struct Plan;

enum class PassKind {
    // When a map or what is seen of it has changed.
    pyramid,
    prefilter,
    irradiance,
    pack,
    // In every frame.
    surface,
    light_lists,
    tiles,
    shade,
    reference,
    background,
    accumulate,
    read_back
};

const char* pass_name(PassKind kind);

struct PassLine {
    PassKind kind = PassKind::surface;
    std::string reason;
    std::optional<uint32_t> number; ///< of the shade class

    std::string name() const;
};

/// A plan calls for these, in order.
std::vector<PassLine> passes_of(const Plan& plan);

} // namespace burnish
