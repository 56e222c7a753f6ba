#include "burnish/sampling/albedo_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;
constexpr uint32_t PHI_NODES = 9;
constexpr int RADII = 96;
constexpr int AZIMUTHS = 64;

/// Unit-roughness slopes of equal probability under D cos_h: radius sqrt(-ln x) at the midpoints of RADII strata.
const std::array<double, RADII>& radii() {
    static const std::array<double, RADII> values = [] {
        std::array<double, RADII> result;
        for (int k = 0; k < RADII; ++k) result[k] = std::sqrt(-std::log((k + 0.5) / RADII));
        return result;
    }();
    return values;
}

} // namespace

glm::dvec2 directional_albedo(glm::dvec3 omega_o, glm::dvec2 roughness, double alpha) {
    glm::dvec2 sum(0.0);
    for (int j = 0; j < AZIMUTHS; ++j) {
        const double phi = 2.0 * PI * (j + 0.5) / AZIMUTHS;
        const glm::dvec2 direction = roughness * glm::dvec2(std::cos(phi), std::sin(phi));
        for (const double radius : radii()) {
            const glm::dvec2 slope = direction * radius;
            const double cos_h = 1.0 / std::sqrt(1.0 + glm::dot(slope, slope));
            const double cos_d = (omega_o.z + slope.x * omega_o.x + slope.y * omega_o.y) * cos_h;
            const double cos_i = 2.0 * cos_d * cos_h - omega_o.z;
            if (cos_d <= 0.0 || cos_i <= 0.0) continue;
            const double value = std::pow(cos_i, 1.0 - alpha) / cos_h; // the density D cos_h is in the strata
            const double back = 1.0 - cos_d;
            sum += glm::dvec2(value, value * back * back * back * back * back);
        }
    }
    return sum / double(RADII * AZIMUTHS);
}

AlbedoTable build_albedo_table(glm::vec2 roughness, float alpha) {
    AlbedoTable table;
    table.phi_nodes = roughness.x == roughness.y ? 1 : PHI_NODES;
    table.entries.resize(table.phi_nodes * ALBEDO_COS_NODES);
    for (uint32_t j = 0; j < table.phi_nodes; ++j) {
        const double phi = table.phi_nodes == 1 ? 0.0 : j * PI / 2.0 / (table.phi_nodes - 1);
        for (uint32_t i = 0; i < ALBEDO_COS_NODES; ++i) {
            const double root = double(i) / (ALBEDO_COS_NODES - 1);
            const double cos_o = std::max(root * root, 1e-4);
            const double sin_o = std::sqrt(1.0 - cos_o * cos_o);
            table.entries[j * ALBEDO_COS_NODES + i] =
                directional_albedo({sin_o * std::cos(phi), sin_o * std::sin(phi), cos_o}, roughness, alpha);
        }
    }
    return table;
}

} // namespace burnish
