// The matched sampler's lookups of one lobe, for every view: what would take too many points at every pixel
// is done once for a material.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

struct MatchedLobe {
    uint32_t samples = 14;    ///< one of MATCHED_COUNTS
    float roughness_x = 0.3f; ///< slopes
    float roughness_y = 0.3f;
    float alpha = 0.0f;
    float specular = 1.0f; ///< F = specular + grazing (1 - o.h)^5, over all channels: weighs directions
    float grazing = 0.0f;
    bool has_schlick = false; ///< rows hold Schlick terms
    uint32_t face_size = 256; ///< of the map, whose levels are round on the sphere

    auto operator<=>(const MatchedLobe&) const = default;
};

/// Whether views are dense enough for a lobe: samples of a very brushed one are narrower than what they move
/// by from one azimuth to the next.
bool fits_view_table(glm::vec2 roughness);

/// Views that rows are made for: MATCHED_ROWS angles of a round lobe, MATCHED_BRUSHED_VIEWS times
/// MATCHED_AZIMUTHS azimuths of a brushed one.
uint32_t view_count(const MatchedLobe& lobe);
uint32_t view_azimuths(const MatchedLobe& lobe);

/// Entries of a row: one for each sample, then the Schlick terms of four samples each, if there are any.
uint32_t view_row_entries(const MatchedLobe& lobe);

uint64_t view_table_entries(const MatchedLobe& lobe);

/// Rows for views times azimuths, azimuths innermost: row j of the views is for cos_o = (j/(views-1))^2.
/// Azimuth k of a brushed lobe is where the plane of view, e with ey >= 0 in the lobe's axes, has (1 -
/// ex/(|ex| + ey))/2 = k/(MATCHED_AZIMUTHS-1); a view from the other side has the same samples half a turn
/// away. An entry is (x, y, weight, level): the lookup goes to where the half-vector of slope (x, y) mirrors
/// the view of a point, in the lobe's axes, or, of a round lobe, along the plane of view and across it.
/// Slopes vary less from view to view than directions do, so that the nearest row will do. A Schlick term is
/// the mean of (1 - o.h)^5 over a component.
std::vector<glm::vec4> build_matched_view_table(const MatchedLobe& lobe);

} // namespace burnish
