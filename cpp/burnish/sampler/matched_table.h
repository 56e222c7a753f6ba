// Gaussian mixtures that stand for a lobe, fitted offline (maths: section 6;
// python/burnish/tables/fit_matched.py).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"

namespace burnish {

/// A table of mixtures stands for this density: a Gaussian, or Student's in a window (1 + r^2)^-2 exp(-r^2/(2
/// R^2)). The wider a lobe the narrower its window: what is beyond lies below the horizon.
struct MixtureTable {
    Density density = Density::gaussian;
    uint32_t window = 0; ///< of Student's density, 0 none

    /// The table that serves lobes of a density and a greater width.
    static MixtureTable of(Density density, double width);
    /// The lobe's density over the table's, at places (squares of radii) of the lobe and of the mixture.
    double ratio(double lobe_r2, double mixture_r2) const;
};

/// The mixtures of one count, MATCHED_ROWS rows of (count + 1) / 2 entries (y1, y2, s, w): row j is for a
/// lobe whose aspect on the map is 2^(MATCHED_LOG2_LARGEST_RHO j / (MATCHED_ROWS - 1)). An entry stands for
/// two components, at (y1, y2) and (-y1, -y2); of an odd count the first is the one at 0. y1 is in units of
/// the lobe's major axis on the map, y2 and the width s in units of its minor axis; the weights w of all
/// components of a row sum to 1. `count` is one of MATCHED_COUNTS.
std::vector<glm::vec4> matched_mixtures(uint32_t count, MixtureTable table = {});
/// Those of all windows of a density, one after the other.
std::vector<glm::vec4> all_matched_mixtures(uint32_t count, Density density);

/// The row nearest to an aspect.
uint32_t matched_row(double rho);

} // namespace burnish
