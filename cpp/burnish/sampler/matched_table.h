// Gaussian mixtures that stand for a lobe, fitted offline (maths: section 6;
// python/burnish/tables/fit_matched.py).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

/// The mixtures of one count, MATCHED_ROWS rows of (count + 1) / 2 entries (y1, y2, s, w): row j is for a
/// lobe whose aspect on the map is 2^(MATCHED_LOG2_LARGEST_RHO j / (MATCHED_ROWS - 1)). An entry stands for
/// two components, at (y1, y2) and (-y1, -y2); of an odd count the first is the one at 0. y1 is in units of
/// the lobe's major axis on the map, y2 and the width s in units of its minor axis, where the lobe is
/// exp(-|y|^2)/pi; the weights w of all components of a row sum to 1. `count` is one of MATCHED_COUNTS.
std::vector<glm::vec4> matched_mixtures(uint32_t count);

/// The row nearest to an aspect.
uint32_t matched_row(double rho);

} // namespace burnish
