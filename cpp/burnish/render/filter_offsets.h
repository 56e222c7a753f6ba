// Where the rays of accumulated pictures pass a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace burnish {

/// Support of the pixel filter to either side of the centre, pixels: a Blackman-Harris window.
constexpr double FILTER_RADIUS_PX = 1.5;

/// Offsets from the pixel's centre, pixels, x right and y down, of `count` pictures of equal weight. Each
/// with its mirror image through the centre: their mean is the centre for every count, one alone passes
/// there. The first is the one nearest to the centre.
///
/// In units of the filter's distribution they are a lattice: along each axis one in the middle of each of
/// `count` shares of equal weight, in column k the row a k mod m, counted from the middle, a prime to m. Of
/// m = count and m = count + 1 (whose point at the corner is left out), and of all a, the lattice whose
/// shortest vector is longest for its m.
std::vector<glm::vec2> filter_offsets(uint32_t count);

} // namespace burnish
