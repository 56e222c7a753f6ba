// A lobe lies elsewhere once it is weighed by what it reflects: this says where.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/sampler/matched_view_table.h"

namespace burnish {

/// A half-vector reflects this, in the lobe's axes.
struct Reflected {
    glm::dvec3 omega_i;
    double base;    ///< cos_i^(1-alpha)/cos_h
    double schlick; ///< (1 - o.h)^5
    double grey;    ///< F base
};

/// The half-vector of a slope at a view; nothing below the horizon.
std::optional<Reflected> reflect_slope(const MatchedLobe& lobe, glm::dvec3 omega_o, glm::dvec2 slope);

/// Moments are of slopes in units of roughness, in which the lobe's density is exp(-|p|^2)/pi.
struct Moments {
    glm::dvec2 mean;
    glm::dvec3 covariance; ///< xx, xy, yy
};

/// A view at a place of the square that views lie on, see build_matched_view_table.
struct SquareView {
    glm::dvec3 omega_o;
    glm::dvec2 e; ///< the plane of view, a unit vector in the lobe's axes
};
SquareView view_of_square(glm::dvec2 square);

/// How far mixtures follow the moments: all the way they would leave a lobe's tails to too few samples. Of
/// wide lobes, whose moments change most with the view, it is less.
double moment_share(const MatchedLobe& lobe);

/// The middle of a mixture moves by this, a slope along and across, for a unit of the view's o_x and o_y
/// around the normal; each is a half. Slopes less that differ least from one row of a table by view to the
/// next.
glm::vec2 lobe_drift(const MatchedLobe& lobe);

/// Moments for all views: at grazing ones the horizon cuts a lobe, and the Fresnel factor pulls it there.
class WeightedLobe {
public:
    /// Sums over MATCHED_MOMENT_NODES lines of views, on all cores for a brushed lobe.
    explicit WeightedLobe(const MatchedLobe& lobe);

    /// Between those of the nodes; of a round lobe along the plane of view and across it.
    Moments at(glm::dvec2 square) const;

private:
    Moments node(int x, int y) const;

    bool is_round_;
    std::vector<Moments> nodes_;
};

} // namespace burnish
