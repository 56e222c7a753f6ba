// Plan and renderer ask this of a sampler; each answers for itself in its own file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "shared/constants.h"

namespace burnish {

constexpr uint32_t MAX_SAMPLES = 1024;

/// How samplers see the light on diffuse surfaces.
enum class DiffuseForm {
    cube,     ///< exact sums in a small cube map, read by one bilinear lookup (irradiance_cube.h)
    harmonics ///< nine harmonics (spherical_harmonics.h), as published: several per cent off
};

/// Where lookups of a lobe come from.
enum class Placing {
    none,     ///< the reference: every texel, or random ones
    pattern,  ///< half-vectors that a roughness fixes
    mixtures, ///< fitted mixtures, over the lobe as a view sees it
    mirror    ///< one lookup about the mirrored direction
};

/// What is made of a map before it is looked up.
enum class MapLevels {
    none,      ///< level 0 alone
    pyramid,   ///< levels by the plan's filter
    spherical, ///< levels that are round on the sphere
    lobe       ///< each level the map as one roughness sees it
};

struct SamplerFacts {
    std::string text{};                   ///< "regular:14", "matched:14:diffuse=harmonics": for reports
    std::optional<DiffuseForm> diffuse{}; ///< none of the truth, which takes no such form
    Placing placing = Placing::none;
    MapLevels levels = MapLevels::pyramid;
    std::string levels_reason{}; ///< why a plan makes them; empty of the pyramid alone
    uint32_t samples = 1;        ///< lookups of a lobe, as asked for
    bool is_truth = false;       ///< exact within a standard error that it tells
    bool takes_suns_out = false; ///< suns are split off the map and shaded directly
    bool needs_albedo = false;   ///< radiance is a mean times the lobe's albedo
    bool is_round = false;       ///< brushed lobes reflect as round ones
    // Of patterns, as the shade kernel names them.
    uint32_t footprint = shared::FOOTPRINT_EXACT;
    uint32_t normalization = shared::NORMALIZATION_CONSTANT;
    uint32_t scaled_normalization = shared::NORMALIZATION_CONSTANT; ///< where roughness varies
    uint32_t scaled_table = shared::TABLE_BUFFER;
    float threshold_log = 0.0f; ///< -ln xi0
};

/// Throws std::invalid_argument unless it is 1..MAX_SAMPLES.
void require_samples(uint32_t samples);
/// Throws std::invalid_argument unless it is within 16 levels.
void require_mip_bias(float bias);
/// ":diffuse=harmonics", or nothing of the default.
std::string diffuse_text(DiffuseForm form);

} // namespace burnish
