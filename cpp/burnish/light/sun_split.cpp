#include "burnish/light/sun_split.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "shared/constants.h"

namespace burnish {
namespace {

constexpr double LEAST_CONTRAST = 100.0;
constexpr double CAP_RADIUS = std::numbers::pi / 180.0;
constexpr double CAP_HALF_TEXELS = 4.0; ///< a half-texel is 1/N radian
constexpr double RING_EXCESS = 0.02;

class SunSearch {
public:
    explicit SunSearch(const CubeTexels& cube)
        : size_(require_texels(cube)), texels_(cube.radiance), solid_angles_(texel_solid_angles(size_)) {
        for (uint32_t face = 0; face < 6; ++face)
            axes_.push_back(face_axes(face));
        light_ = integral();
    }

    std::optional<Sun> take_brightest() {
        const size_t peak = brightest();
        if (!(grey(peak) > LEAST_CONTRAST * light_ / (4.0 * std::numbers::pi))) return {};

        std::vector<size_t> cap, ring;
        gather(direction(peak), cap, ring);
        if (ring.empty()) return {};
        const glm::dvec3 background = median(ring);
        const double dark = mean(background);
        double largest = 0.0;
        for (const size_t texel : ring)
            largest = std::max(largest, grey(texel));
        if (largest - dark > RING_EXCESS * (grey(peak) - dark)) return {};
        return take(cap, background);
    }

    /// The map without the suns taken; empty if there were none.
    std::vector<float> take_rest() { return std::move(rest_); }

private:
    double integral() const {
        double sum = 0.0;
        for (size_t row = 0; row < size_t{6} * size_; ++row) {
            const float* rgb = texels_.data() + 3 * size_ * row;
            const double* solid_angle = solid_angles_.data() + size_ * (row % size_);
            double of_row = 0.0;
            for (size_t column = 0; column < size_; ++column, rgb += 3)
                of_row += (double(rgb[0]) + rgb[1] + rgb[2]) * solid_angle[column];
            sum += of_row;
        }
        return sum / 3.0;
    }

    size_t brightest() const {
        size_t peak = 0;
        double most = -1.0;
        for (size_t texel = 0; texel < texels_.size() / 3; ++texel) {
            const float* rgb = texels_.data() + 3 * texel;
            const double sum = double(rgb[0]) + rgb[1] + rgb[2];
            if (sum > most) {
                most = sum;
                peak = texel;
            }
        }
        return peak;
    }

    static double mean(glm::dvec3 v) { return (v.x + v.y + v.z) / 3.0; }
    glm::dvec3 color(size_t texel) const {
        return {texels_[3 * texel], texels_[3 * texel + 1], texels_[3 * texel + 2]};
    }
    double grey(size_t texel) const { return mean(color(texel)); }
    double solid_angle(size_t texel) const { return solid_angles_[texel % solid_angles_.size()]; }
    glm::dvec3 direction(size_t texel) const {
        const size_t in_face = texel % solid_angles_.size();
        const FaceAxes& face = axes_[texel / solid_angles_.size()];
        const double u = (2.0 * double(in_face % size_) + 1.0) / size_ - 1.0;
        const double v = (2.0 * double(in_face / size_) + 1.0) / size_ - 1.0;
        return glm::normalize(face.axis + u * face.right + v * face.down);
    }

    void gather(glm::dvec3 middle, std::vector<size_t>& cap, std::vector<size_t>& ring) const {
        const double radius = std::max(CAP_RADIUS, CAP_HALF_TEXELS / size_);
        for (size_t texel = 0; texel < texels_.size() / 3; ++texel) {
            const glm::dvec3 chord = direction(texel) - middle;
            const double chord2 = glm::dot(chord, chord);
            if (chord2 <= radius * radius)
                cap.push_back(texel);
            else if (chord2 <= 4.0 * radius * radius)
                ring.push_back(texel);
        }
    }

    glm::dvec3 median(const std::vector<size_t>& texels) const {
        glm::dvec3 result;
        std::vector<double> values(texels.size());
        for (int c = 0; c < 3; ++c) {
            for (size_t k = 0; k < texels.size(); ++k)
                values[k] = texels_[3 * texels[k] + c];
            std::sort(values.begin(), values.end());
            result[c] = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
        }
        return result;
    }

    Sun take(const std::vector<size_t>& cap, glm::dvec3 background) {
        if (rest_.empty()) {
            rest_.assign(texels_.begin(), texels_.end());
            texels_ = rest_;
        }
        Sun sun;
        glm::dvec3 centroid(0.0);
        std::vector<double> weights;
        for (const size_t texel : cap) {
            const glm::dvec3 energy =
                glm::max(color(texel) - background, glm::dvec3(0.0)) * solid_angle(texel);
            sun.flux += energy;
            weights.push_back(mean(energy));
            centroid += mean(energy) * direction(texel);
        }
        sun.direction = glm::normalize(centroid);
        for (size_t k = 0; k < cap.size(); ++k) {
            const glm::dvec3 chord = direction(cap[k]) - sun.direction;
            sun.variance += 0.5 * weights[k] * glm::dot(chord, chord);
            light_ += (mean(background) - grey(cap[k])) * solid_angle(cap[k]);
            for (int c = 0; c < 3; ++c)
                rest_[3 * cap[k] + c] = float(background[c]);
        }
        sun.variance /= mean(sun.flux);
        return sun;
    }

    uint32_t size_;
    std::span<const float> texels_; ///< of the cube, and of rest_ once there is one
    std::vector<float> rest_;
    std::vector<double> solid_angles_;
    std::vector<FaceAxes> axes_;
    double light_ = 0.0; ///< integral of the map
};

} // namespace

SunSplit split_suns(const CubeTexels& cube) {
    SunSplit split;
    SunSearch search(cube);
    while (split.suns.size() < shared::MAX_SUNS) {
        const std::optional<Sun> sun = search.take_brightest();
        if (!sun) break;
        split.suns.push_back(*sun);
    }
    split.radiance = search.take_rest();
    return split;
}

} // namespace burnish
