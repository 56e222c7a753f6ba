#include "burnish/sampler/matched.h"

#include <algorithm>
#include <stdexcept>

#include "burnish/error.h"

namespace burnish {

void validate(const Matched& sampler) {
    if (std::find(MATCHED_COUNTS.begin(), MATCHED_COUNTS.end(), sampler.samples) != MATCHED_COUNTS.end())
        return;
    std::string counts;
    for (const uint32_t count : MATCHED_COUNTS)
        counts += message(counts.empty() ? "" : ", ", count);
    throw std::invalid_argument(message("samples: expected one of ", counts, ", got ", sampler.samples));
}

SamplerFacts facts(const Matched& sampler) {
    return {
        .text = message("matched:", sampler.samples, diffuse_text(sampler.diffuse)),
        .diffuse = sampler.diffuse,
        .placing = Placing::mixtures,
        .levels = MapLevels::spherical,
        .levels_reason =
            "levels that are round on the sphere, so that a lookup has one width everywhere, once per map",
        .samples = sampler.samples,
        .takes_suns_out = true,
        .needs_albedo = true,
        .normalization = shared::NORMALIZATION_FURNACE};
}

} // namespace burnish
