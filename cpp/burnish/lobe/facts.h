// The engine asks this of a lobe; each model answers for itself in its own file.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "shared/constants.h"
#include "shared/records.h"

namespace burnish {

/// A lobe may be as narrow as this: the slope's fourth power, in areas and variances, is still a normal
/// float32.
constexpr float MIN_LOBE_ROUGHNESS = 1e-6f;

/// A lobe has this density in its plane, r in units of its widths: exp(-r^2)/pi, or Student's (1 +
/// r^2)^-2/pi, which has a tail.
enum class Density { gaussian, student };

/// A place in a lobe's plane reflects this.
struct LobePoint {
    glm::dvec3 omega_i; ///< unit, in the lobe's axes
    double base;        ///< f cos_i without Fresnel over density and stretch; 0 where nothing is reflected
    double schlick;     ///< (1 - o.h)^5
};

/// (1 - u)^5, the part of Schlick's Fresnel that grows toward grazing; u = o.h.
inline double schlick_weight(double u) {
    const double rest = std::clamp(1.0 - u, 0.0, 1.0), rest2 = rest * rest;
    return rest2 * rest2 * rest;
}

struct LobeModel;

/// All of a lobe that decides where it reflects light to: lobes of equal shapes share tables.
struct LobeShape {
    const LobeModel* model = nullptr;
    float width_x = 0.3f, width_y = 0.3f; ///< along tangent and bitangent, as slopes of half-vectors
    float alpha = 0.0f;                   ///< power of cosines, of models that have it
    /// F = specular + grazing (1 - o.h)^5 over all channels, of which the sum is 1: weighs directions.
    float specular = 1.0f, grazing = 0.0f;
    std::array<float, 4> own{}; ///< of models that have more than widths, see their files

    glm::dvec2 width() const { return {width_x, width_y}; }
    bool is_round() const { return width_x == width_y; }
    auto operator<=>(const LobeShape&) const = default;
};

/// The host asks this of models whose mixtures are placed once for every view of a material. A lobe is f
/// cos_i di = base K d^2p, K its density and p a place of its plane in units of its widths: samplers place
/// points there, and these functions say what a point is. Views are unit vectors in the lobe's axes.
struct ViewPlane {
    /// Power of cos_i in the base, which changes most from view to view.
    double (*lit_exponent)(const LobeShape& shape);
    LobePoint (*at)(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 p);
    /// Derivative of the direction at p, in any two unit vectors across it.
    glm::dmat2 (*linear_map)(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 p);
    /// Solid angle of directions over the area of the plane between two places.
    double (*stretch)(const LobeShape& shape, glm::dvec3 omega_o, glm::dvec2 one, glm::dvec2 other);
    /// How far mixtures follow the moments of what is reflected, see weighted_lobe.h.
    double (*moment_share)(const LobeShape& shape);
};

struct LobeModel {
    const char* name;
    uint32_t id; ///< MODEL_... of glsl/shared/constants.h
    Density density;
    /// A lobe's half-vectors are the same from everywhere, slopes p times the widths, and published samplers
    /// say what to do with them.
    bool has_fixed_half_vectors;
    const ViewPlane* view; ///< null: mixtures are placed at every point, by the kernels
    /// (E1, Es): integrals of f cos_i over light for F = 1 and for F = (1 - o.h)^5, without powers that
    /// change fast from view to view: cos_o^-alpha, |p|^n. `is_quick`: within 3e-3, for tables of a hundred
    /// thousand entries.
    glm::dvec2 (*albedo)(const LobeShape& shape, glm::dvec3 omega_o, bool is_quick);
    /// The albedo depends on the azimuth as these widths do.
    glm::dvec2 (*albedo_width)(const LobeShape& shape);
};

/// Albedo widths of models that have no others.
inline glm::dvec2 plane_width(const LobeShape& shape) {
    return shape.width();
}

struct LobeFacts {
    LobeShape shape;
    bool is_brushed = false;
    bool has_fresnel = false;
    bool scales_energy = false; ///< by its albedo, see ENERGY_...
    uint32_t alpha_form = shared::ALPHA_ZERO;

    glm::vec2 width() const { return {shape.width_x, shape.width_y}; }
};

/// Checks what every model has; throws std::invalid_argument, naming field, range and value.
void validate_shared(const std::string& prefix, glm::vec2 roughness, glm::vec3 r0, glm::vec3 weight,
                     float rotation);

/// Weighs directions by the reflectances along the normal and along the surface of all channels.
void set_fresnel(LobeFacts& facts, glm::vec3 weight, glm::vec3 r0, glm::vec3 f90);

/// Fills what kernels read of every model; tables and traits of the plan's follow.
shared::LobeRecord make_record(const LobeShape& shape, glm::vec3 weight, glm::vec3 r0, glm::vec3 f90,
                               float rotation);

} // namespace burnish
