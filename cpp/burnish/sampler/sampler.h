// The samplers a user chooses from, as plain settings. Their tables are made in sample_table.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace burnish {

constexpr uint32_t MAX_SAMPLES = 1024;

enum class Footprint { published, exact };
enum class Normalization { published, projected, furnace };
enum class PointSet { hammersley, fibonacci };
/// How samplers see the light on diffuse surfaces.
enum class DiffuseForm {
    cube,     ///< exact sums in a small cube map, read by one bilinear lookup (irradiance_cube.h)
    harmonics ///< nine harmonics (spherical_harmonics.h), as published: several per cent off
};
enum class ReferenceMethod { automatic, quadrature, progressive };

/// Half-vectors on equally spaced circles (RS section 5). A budget: the pattern whose count comes closest is
/// used.
struct Regular {
    uint32_t samples = 14;
    float threshold = 0.2f; ///< xi0: half-vectors of q below it are dropped, in (0, 1)
    Footprint footprint = Footprint::exact;
    Normalization normalization = Normalization::furnace;
    float mip_bias = 0.0f; ///< added to the mip level
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// Filtered importance sampling (GPU Gems 3, ch. 20) of the lobe's half-vectors.
struct Importance {
    uint32_t samples = 14;
    PointSet points = PointSet::hammersley;
    float mip_bias = 0.0f;
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// Counts that mixtures were fitted for (see matched_table.h).
constexpr std::array<uint32_t, 19> MATCHED_COUNTS = {2,  3,  4,  5,  6,  7,  8,  9,  10, 12,
                                                     14, 16, 17, 20, 24, 30, 32, 48, 64};

/// Our own: lookups placed so that the covariance of their centres and their own widths together are the
/// lobe's (maths: section 6).
struct Matched {
    uint32_t samples = 14; ///< one of MATCHED_COUNTS
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// One lookup a lobe in a map prefiltered for its roughness, times the exact albedo: what engines ship.
struct Prefiltered {
    DiffuseForm diffuse = DiffuseForm::cube;
};

/// The truth, for the diffuse part and every lobe: every level-0 texel, or progressive multiple importance
/// sampling until the standard error is reached.
struct Reference {
    float standard_error = 0.002f; ///< relative to the mean radiance that is reflected, > 0
    ReferenceMethod method = ReferenceMethod::automatic;
    uint32_t max_samples = 1u << 16; ///< per pixel; a warning says so when it stops a progressive run
};

using Sampler = std::variant<Regular, Importance, Matched, Prefiltered, Reference>;

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Sampler& sampler);
/// "regular:14", "importance:14", "matched:14:diffuse=harmonics", "prefiltered", "reference": for reports.
std::string describe(const Sampler& sampler);
/// None for a reference, which takes no such form: it is exact.
std::optional<DiffuseForm> diffuse_form(const Sampler& sampler);

} // namespace burnish
