#include "burnish/sampler/prefiltered.h"

namespace burnish {

void validate(const Prefiltered&) {}

SamplerFacts facts(const Prefiltered& sampler) {
    return {.text = "prefiltered" + diffuse_text(sampler.diffuse),
            .diffuse = sampler.diffuse,
            .placing = Placing::mirror,
            .levels = MapLevels::lobe,
            .levels_reason =
                "each level the map as one roughness sees it, for one lookup a lobe, once per map",
            .needs_albedo = true,
            .is_round = true};
}

} // namespace burnish
