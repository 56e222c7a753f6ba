// A lobe lies elsewhere once it is weighed by what it reflects: this says where.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "burnish/sampler/matched_view_table.h"

namespace burnish {

/// F over all channels times the base of a point.
double grey_of(const LobeShape& shape, const LobePoint& point);

/// Moments are of places in the lobe's plane, of density exp(-|p|^2)/pi there.
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

/// The middle of a mixture moves by this, a slope along and across, for a unit of the view's o_x and o_y
/// around the normal; each is a half. Slopes less that differ least from one row of a table by view to the
/// next.
glm::vec2 lobe_drift(const LobeShape& shape);

/// Moments for all views: at grazing ones the horizon cuts a lobe, and the Fresnel factor pulls it there. How
/// far mixtures follow them its model says: all the way they would leave a lobe's tails to too few samples.
/// Where they don't follow, nothing is summed.
class WeightedLobe {
public:
    /// Sums over MATCHED_MOMENT_NODES lines of views, on all cores for a brushed lobe.
    explicit WeightedLobe(const LobeShape& shape);

    /// Between those of the nodes; of a round lobe along the plane of view and across it.
    Moments at(glm::dvec2 square) const;
    /// Of the way from the lobe's own moments, 0 and 1/2.
    double share() const { return share_; }

private:
    Moments node(int x, int y) const;

    bool is_round_;
    double share_;
    std::vector<Moments> nodes_;
};

} // namespace burnish
