#include "burnish/sampler/sample_table.h"

#include <cmath>
#include <numbers>

#include "burnish/sampler/regular_pattern.h"

namespace burnish {
namespace {

constexpr double PI = std::numbers::pi;

double radical_inverse(uint32_t index) {
    double result = 0.0;
    for (double digit = 0.5; index; index >>= 1, digit *= 0.5)
        if (index & 1u) result += digit;
    return result;
}

double texels_of_face(uint32_t face_size, float mip_bias) {
    // Half the log2 of the texel count is the level, so a bias of one level is a factor of four.
    return static_cast<double>(face_size) * face_size * std::exp2(2.0 * mip_bias);
}

/// Texel factor of a pattern of `count` samples before the view terms (maths: section 4); see SampleTable for
/// hz.
double regular_texel_factor(const Regular& sampler, glm::dvec2 roughness, uint32_t face_size, double count) {
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    if (sampler.footprint == Footprint::exact)
        return texels * lobe_solid_angle(roughness, sampler.threshold) / count;
    const double reach = std::sqrt(-std::log(double(sampler.threshold)));
    const double sin_u = std::sin(std::atan(reach * roughness.x));
    const double sin_v = std::sin(std::atan(reach * roughness.y));
    return texels * PI * sin_u * sin_v / count;
}

} // namespace

std::vector<glm::dvec2> unit_points(PointSet points, uint32_t count) {
    constexpr double smallest = 1.0 / (1 << 24);
    constexpr double golden = std::numbers::phi - 1.0;
    std::vector<glm::dvec2> result(count);
    for (uint32_t k = 0; k < count; ++k) {
        if (points == PointSet::hammersley)
            result[k] = {std::max(double(k) / count, smallest), radical_inverse(k)};
        else
            result[k] = {(k + 0.5) / count, std::fmod(k * golden, 1.0)};
    }
    return result;
}

SampleTable build_sample_table(const Regular& sampler, glm::vec2 roughness, uint32_t face_size) {
    const glm::dvec2 m = roughness;
    const std::vector<glm::dvec3> pattern = choose_regular_pattern(m, sampler.samples, sampler.threshold);
    const double texel_factor = regular_texel_factor(sampler, m, face_size, double(pattern.size()));

    // D without the constants that the quotient cancels; cos_h is the projection that makes D integrate to
    // one.
    std::vector<double> density(pattern.size());
    double sum = 0.0;
    for (size_t k = 0; k < pattern.size(); ++k) {
        const double cos_h = pattern[k].z;
        density[k] = lobe_q(pattern[k], m) / (cos_h * cos_h * cos_h * cos_h);
        sum += sampler.normalization == Normalization::published ? density[k] : density[k] * cos_h;
    }
    SampleTable table;
    for (size_t k = 0; k < pattern.size(); ++k) {
        const glm::dvec3 h = pattern[k];
        const double hz = sampler.footprint == Footprint::exact ? h.z : 1.0 / h.z;
        table.entries.emplace_back(h.x / h.z, h.y / h.z, density[k] / sum, texel_factor * hz);
    }
    return table;
}

SampleTable build_sample_table(const Importance& sampler, glm::vec2 roughness, uint32_t face_size) {
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    SampleTable table;
    for (const glm::dvec2& x : unit_points(sampler.points, sampler.samples)) {
        const double radius = std::sqrt(-std::log(x.x));
        const glm::dvec2 slope =
            glm::dvec2(roughness) * radius * glm::dvec2(std::cos(2 * PI * x.y), std::sin(2 * PI * x.y));
        const double cos_h = 1.0 / std::sqrt(1.0 + glm::dot(slope, slope));
        // p_h = D cos_h = q / (pi mx my cos_h^3), and q = x1 by construction.
        const double density = x.x / (PI * roughness.x * roughness.y * cos_h * cos_h * cos_h);
        table.entries.emplace_back(slope.x, slope.y, 1.0 / (sampler.samples * cos_h),
                                   texels / (sampler.samples * density) * cos_h);
    }
    return table;
}

SampleTable build_scaled_table(const Regular& sampler, uint32_t face_size) {
    const glm::dvec2 m(SCALED_ROUGHNESS);
    const std::vector<glm::dvec3> pattern = choose_regular_pattern(m, sampler.samples, sampler.threshold);
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    // The kernel multiplies by mx my (and, exact, by the narrowing of wide lobes).
    const double texel_factor = texels * PI * -std::log(double(sampler.threshold)) / double(pattern.size());
    SampleTable table;
    table.is_scaled = true;
    for (const glm::dvec3& h : pattern)
        table.entries.emplace_back(h.x / h.z / m.x, h.y / h.z / m.y, lobe_q(h, m), texel_factor);
    return table;
}

SampleTable build_scaled_table(const Importance& sampler, uint32_t face_size) {
    const double texels = texels_of_face(face_size, sampler.mip_bias);
    SampleTable table;
    table.is_scaled = true;
    for (const glm::dvec2& x : unit_points(sampler.points, sampler.samples)) {
        const double radius = std::sqrt(-std::log(x.x));
        table.entries.emplace_back(radius * std::cos(2 * PI * x.y), radius * std::sin(2 * PI * x.y),
                                   1.0 / sampler.samples, texels * PI / (sampler.samples * x.x));
    }
    return table;
}

} // namespace burnish
