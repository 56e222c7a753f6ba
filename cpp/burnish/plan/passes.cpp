#include "burnish/plan/passes.h"

#include <algorithm>

#include "burnish/error.h"
#include "burnish/plan/plan.h"

namespace burnish {

const char* pass_name(PassKind kind) {
    switch (kind) {
    case PassKind::pyramid:
        return "pyramid";
    case PassKind::prefilter:
        return "prefilter";
    case PassKind::irradiance:
        return "irradiance";
    case PassKind::pack:
        return "pack";
    case PassKind::surface:
        return "surface";
    case PassKind::tiles:
        return "tiles";
    case PassKind::light_lists:
        return "light lists";
    case PassKind::shade:
        return "shade";
    case PassKind::reference:
        return "reference";
    case PassKind::background:
        return "background";
    case PassKind::accumulate:
        return "accumulate";
    case PassKind::read_back:
        return "read back";
    }
    return "";
}

std::string PassLine::name() const {
    return number ? message(pass_name(kind), " ", *number) : pass_name(kind);
}

std::vector<PassLine> passes_of(const Plan& plan) {
    std::vector<PassLine> passes;
    const auto add = [&](PassKind kind, std::string reason, std::optional<uint32_t> number = {}) {
        passes.push_back({kind, std::move(reason), number});
    };
    const bool is_reference = plan.sampler.is_truth;
    if (plan.has_lookups && plan.sampler.levels != MapLevels::none)
        add(PassKind::pyramid,
            message(row_of(plan.settings.filter).name, " levels of ", plan.environments.size(),
                    plan.environments.size() == 1 ? " map" : " maps", ", once per map"));
    if (plan.has_lookups && !plan.sampler.levels_reason.empty())
        add(PassKind::prefilter, plan.sampler.levels_reason);
    if (!plan.diffuse_environments.empty() && !is_reference)
        add(PassKind::irradiance,
            message("cosine sums over every texel of ", plan.diffuse_environments.size(),
                    plan.diffuse_environments.size() == 1 ? " map" : " maps",
                    ", which something diffuse sees; on the host, once per map"));
    if (std::ranges::any_of(plan.map_sets,
                            [](const MapSet& set) { return set.lookup != MapLookup::sampler; }))
        add(PassKind::pack, "pairs of texels for the software lookup, once per map");
    add(PassKind::surface, plan.has_varying ? "rasterises into the wide G-buffer: textures or vertex colours "
                                              "vary over a surface"
                                            : "rasterises into 8 bytes a pixel and depth");
    if (plan.lists_lights)
        add(PassKind::light_lists,
            message("of ", plan.lights.size(), plan.lights.size() == 1 ? " light" : " lights",
                    " those that reach each tile: some end somewhere"));
    add(PassKind::tiles, message("lists the 8x8 tiles of ", plan.classes.size(),
                                 plan.classes.size() == 1 ? " shade class" : " shade classes",
                                 plan.has_background ? " and of the background" : "",
                                 plan.lists_lights ? ", those that no light reaches apart" : ""));
    for (uint32_t k = 0; k < plan.classes.size(); ++k)
        add(is_reference ? PassKind::reference : PassKind::shade, plan.classes[k].reason, k);
    if (plan.has_background) add(PassKind::background, "the environment where no object is");
    if (plan.settings.spp > 1) add(PassKind::accumulate, message("mean of ", plan.settings.spp, " pictures"));
    add(PassKind::read_back, "picture, depth and normals to the host");
    return passes;
}

} // namespace burnish
