// The matched sampler's lookups of one lobe, for every view: what would take too many points at every pixel
// is done once for a material.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"

namespace burnish {

struct MatchedLobe {
    uint32_t samples = 14; ///< one of MATCHED_COUNTS
    LobeShape shape;
    bool has_schlick = false; ///< rows hold Schlick terms
    uint32_t face_size = 256; ///< of the map, whose levels are round on the sphere

    auto operator<=>(const MatchedLobe&) const = default;
};

/// Whether views are dense enough for a lobe: samples of a very brushed one are narrower than what they move
/// by from one azimuth to the next.
bool fits_view_table(glm::vec2 roughness);

/// Views that rows are made for: MATCHED_ROWS angles of a round lobe, a grid of MATCHED_VIEW_NODES lines of
/// twice as many less one columns of a brushed one.
uint32_t view_count(const MatchedLobe& lobe);
uint32_t view_columns(const MatchedLobe& lobe); ///< 1 of a round lobe

/// Entries of a row: one for each sample, then the Schlick terms of four samples each, if there are any.
uint32_t view_row_entries(const MatchedLobe& lobe);

uint64_t view_table_entries(const MatchedLobe& lobe);

struct ViewTable {
    std::vector<glm::vec4> entries;
    uint32_t drift; ///< of slopes with the view, two halves: along and across
};

/// Rows for all views. They are even in a radius r, r^2 = 1 - (cos_o + sqrt(cos_o))/2: 0 along the normal,
/// around which it is as the angle, and 1 at the horizon, toward which it is as sqrt(cos_o). Row j of a round
/// lobe is for r = j/(MATCHED_ROWS-1). Those of a brushed lobe are a grid, columns innermost, over
/// x = -1..1 and y = 0..1 in steps of 1/(MATCHED_VIEW_NODES-1): (x, y) is for r = max(|x|, y) and the plane
/// of view (x, y)/|(x, y)| in the lobe's axes. That is half of the disc of views on half of a square, which
/// has no pole; a view from the other side has the same samples half a turn away.
///
/// An entry is (x, y, weight, level): the lookup goes to where the half-vector of slope s = (x, y) + d (o_x,
/// o_y) mirrors the view o of a point, in the lobe's axes, or, of a round lobe, along the plane of view and
/// across it, d the lobe's drift; its weight is still to be multiplied by ((1 + |s|^2) cos_i)^(1-alpha),
/// alpha 0 of models that have none. What is left of both vary less from view to view than directions and
/// weights do, so that the nearest row will do. A Schlick term is the mean of (1 - o.h)^5 over a component.
ViewTable build_matched_view_table(const MatchedLobe& lobe);

} // namespace burnish
