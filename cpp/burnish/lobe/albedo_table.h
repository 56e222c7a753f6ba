// Directional albedo of a lobe, tabulated where a sampler's estimate is scaled to it.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/lobe/facts.h"
#include "shared/constants.h"

namespace burnish {

using shared::ALBEDO_COS_NODES;

/// E(omega_o) = weight (r0 E1 + (f90 - r0) Es), of Kurt's lobe times cos_o^-alpha, with
///   E1 = int D cos_i^(1-alpha) dh,   Es = int D (1 - o.h)^5 cos_i^(1-alpha) dh   over {h : o.h > 0, cos_i >
///   0}.
/// Without cos_o^-alpha both stay bounded and smooth. Node i of the cosine is at cos_o =
/// (i/(ALBEDO_COS_NODES-1))^2; interpolation between two is linear in cos_o for alpha = 0, in its root else.
/// How E depends on the azimuth of omega_o is how it depends on the lobe's width as seen from there, w = |(ox
/// mx, oy my)|/|(ox, oy)|: node j is at w = low + (high - low) (j/(width_nodes-1))^2 between the two slopes.
/// Within 1e-3 of E for aspects up to 6 (3.4e-3 at an aspect of 100), from 3 degrees above the horizon.
struct AlbedoTable {
    uint32_t width_nodes = 1;       ///< 1 for isotropic lobes
    std::vector<glm::vec2> entries; ///< [width][cos] -> (E1, Es)
};

AlbedoTable build_albedo_table(const LobeShape& shape);

/// (E1, Es) of round lobes like `shape` whose roughness varies over a surface, [roughness][cos]: roughness k
/// is (k/(ALBEDO_ROUGHNESS_NODES-1))^2. Within 3e-3 of E from 3 degrees above the horizon.
std::vector<glm::vec2> build_varying_albedo_table(const LobeShape& shape);

/// The same of brushed lobes, [along][across][correlation][cos]. Slopes have the covariance C/2; with x in
/// the plane of view and y across it, E depends on C_xx, C_yy and C_xy^2 alone. Nodes are
///   sqrt(C_xx) = (k/(ALBEDO_ALONG_NODES-1))^2,  sqrt(C_yy) = (k/(ALBEDO_ACROSS_NODES-1))^2,
///   C_xy^2/(C_xx C_yy) = k/(ALBEDO_CORRELATION_NODES-1),  cos_o = (k/(ALBEDO_BRUSHED_COS_NODES-1))^2.
/// Within 5e-3 of E for slopes from .02 to 1 and aspects up to 10, from 3 degrees above the horizon.
std::vector<glm::vec2> build_brushed_albedo_table(const LobeShape& shape);

/// (E1, Es) of Kurt's lobe for one omega_o (unit, z = normal, z > 0); the quadrature behind the tables.
/// `is_quick`: with fewer nodes, within 1e-3 for r0 = 1, 3e-3 for .04.
glm::dvec2 directional_albedo(glm::dvec3 omega_o, glm::dvec2 roughness, double alpha, bool is_quick = false);

} // namespace burnish
