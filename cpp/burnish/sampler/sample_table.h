// What the shade kernel reads for every sample of a lobe: all that depends on the pattern alone, made once.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"

namespace burnish {

/// One entry a sample: slopes of the half-vector hx/hz, hy/hz; weight; texel factor.
///
/// With g = cos_i^(1-alpha) cos_o^-alpha and F Fresnel, the lobe's radiance is sum(weight F g L), for furnace
/// divided by sum(weight F g) and multiplied by the albedo. The texel factor K times the lobe's view terms is
/// the count of level-0 texels a lookup covers; the level is half its log2:
///   exact, importance:  K (o.h)/hz r^3        published:  K sqrt((ox^2+oz^2)(oy^2+oz^2)) r / ((o.h)/hz)
/// with r = |i|/|i|_inf. (o.h)/hz is what the kernel has at hand, so K holds the power of hz.
///
/// Models whose half-vectors depend on the view have other entries: a place of the lobe's plane; weight; a
/// quarter of the face's texels times the area that it stands for there.
///
/// A scaled table serves every roughness of a textured material: slopes are in units of roughness, the weight
/// is q and the kernel applies D's other factors itself.
struct SampleTable {
    std::vector<glm::vec4> entries;
};

/// The pattern of scaled tables is placed at this width.
constexpr float SCALED_ROUGHNESS = 0.3f;

/// A pattern in the plane of a lobe, in units of its widths.
struct PlanePoints {
    std::vector<glm::dvec2> places;
    std::vector<double> areas;  ///< each stands for
    bool is_normalized = false; ///< weights sum to 1
};

SampleTable make_plane_table(const PlanePoints& points, Density density, uint32_t face_size, float mip_bias);

/// The density of a plane at a squared radius.
double plane_density(Density density, double r2);

enum class PointSet { hammersley, fibonacci };

/// Points in the unit square, x in [2^-24, 1).
std::vector<glm::dvec2> unit_points(PointSet points, uint32_t count);

/// Texels of a face, times four for every level of bias: half the log2 of what a lookup covers is its level.
double texels_of_face(uint32_t face_size, float mip_bias);

} // namespace burnish
