// The matched sampler's lookups of one isotropic lobe, for every view: what its wide components need too many
// points for to be found at every pixel.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

struct MatchedLobe {
    uint32_t samples = 14;  ///< one of MATCHED_COUNTS
    float roughness = 0.3f; ///< slope, along both axes
    float alpha = 0.0f;
    float specular = 1.0f; ///< F = specular + grazing (1 - o.h)^5, over all channels: weighs directions
    float grazing = 0.0f;
    bool has_schlick = false; ///< rows hold Schlick terms
    uint32_t face_size = 256; ///< of the map, whose levels are round on the sphere

    auto operator<=>(const MatchedLobe&) const = default;
};

/// Entries of a row: one for each sample, then the Schlick terms of four samples each, if there are any.
uint32_t view_row_entries(const MatchedLobe& lobe);

/// MATCHED_ROWS rows; row j is for cos_o = (j/(MATCHED_ROWS-1))^2. An entry is (p1, p2, weight, level): the
/// lookup goes to 2 p1 T1 + 2 p2 T2 + (1 - p1^2 - p2^2) I, with I the mirror direction, T1 across it in the
/// plane of view, on the normal's side, and T2 across both. A Schlick term is the mean of (1 - o.h)^5 over a
/// component.
std::vector<glm::vec4> build_matched_view_table(const MatchedLobe& lobe);

} // namespace burnish
