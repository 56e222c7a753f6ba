// The samplers a user chooses from, as plain settings. Their tables are made in sample_table.h.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace burnish {

constexpr uint32_t MAX_SAMPLES = 1024;

enum class Footprint { published, exact };
enum class Normalization { published, projected, furnace };
enum class PointSet { hammersley, fibonacci };
enum class ReferenceMethod { automatic, quadrature, progressive };

/// Half-vectors on equally spaced circles (RS section 5). A budget: the pattern whose count comes closest is
/// used.
struct Regular {
    uint32_t samples = 14;
    float threshold = 0.2f; ///< xi0: half-vectors of q below it are dropped, in (0, 1)
    Footprint footprint = Footprint::exact;
    Normalization normalization = Normalization::furnace;
    float mip_bias = 0.0f; ///< added to the mip level
};

/// Filtered importance sampling (GPU Gems 3, ch. 20) of the lobe's half-vectors.
struct Importance {
    uint32_t samples = 14;
    PointSet points = PointSet::hammersley;
    float mip_bias = 0.0f;
};

/// The truth: every level-0 texel, or progressive multiple importance sampling until the standard error is
/// reached.
struct Reference {
    float standard_error = 0.002f; ///< relative to the mean radiance of the glossy part, > 0
    ReferenceMethod method = ReferenceMethod::automatic;
    uint32_t max_samples = 1u << 16; ///< per pixel; a warning says so when it stops a progressive run
};

using Sampler = std::variant<Regular, Importance, Reference>;

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Sampler& sampler);
/// "regular:14", "importance:14", "reference": for reports.
std::string describe(const Sampler& sampler);

} // namespace burnish
