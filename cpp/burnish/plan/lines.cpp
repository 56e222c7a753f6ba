#include "burnish/plan/lines.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "burnish/error.h"
#include "burnish/plan/effects.h"
#include "burnish/plan/material_traits.h"
#include "burnish/sampler/matched_view_table.h"
#include "burnish/scene/texture_kinds.h"
#include "shared/constants.h"

namespace burnish {
namespace {

/// The materials that objects show, each once.
std::vector<const Material*> visible_materials(const Scene& scene) {
    std::set<uint32_t> used;
    for (const Object& object : scene.objects)
        used.insert(object.material);
    std::vector<const Material*> result;
    for (const uint32_t material : used)
        result.push_back(&scene.materials[material]);
    return result;
}

std::string listed(const std::vector<const Material*>& all, const std::vector<const Material*>& some) {
    std::string names;
    for (size_t k = 0; k < std::min<size_t>(some.size(), 3); ++k)
        if (!some[k]->name.empty()) names += (names.empty() ? ": " : ", ") + some[k]->name;
    if (!names.empty() && some.size() > 3) names += ", ...";
    return message(some.size(), " of ", all.size(), all.size() == 1 ? " material" : " materials", names);
}

/// One line that is on where some visible material asks for it.
void add_material_line(const Scene& scene, Plan& plan, const std::string& name, const std::string& off_reason,
                       const std::function<bool(const Material&)>& asks) {
    const std::vector<const Material*> all = visible_materials(scene);
    std::vector<const Material*> some;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some),
                 [&](const Material* one) { return asks(*one); });
    plan.effects.push_back({name, !some.empty(), some.empty() ? off_reason : listed(all, some)});
}

size_t set_count(const Plan& plan, MapLookup lookup) {
    return size_t(std::count_if(plan.map_sets.begin(), plan.map_sets.end(),
                                [&](const MapSet& set) { return set.lookup == lookup; }));
}

std::string lookup_reason(const Plan& plan) {
    const LookupChoice& lookup = plan.settings.lookup;
    const auto some = [&](MapLookup which, const char* text) {
        const size_t count = set_count(plan, which);
        return count ? message("; maps of ", count, " of ", plan.map_sets.size(), " sizes are ", text) : "";
    };
    if (lookup.wanted == MapLookup::sampler) return lookup.reason;
    return lookup.reason +
           some(MapLookup::software_stored,
                "read from storage buffers: they are too large for texel buffers") +
           some(MapLookup::sampler, "read by the device's sampler: they are too large for its buffers");
}

EffectLine light_line(const Scene& scene, const Plan& plan) {
    if (scene.lights.empty()) return {"direct lights", false, "the scene has none"};
    if (plan.lights.empty()) return {"direct lights", false, "none gives any light"};
    std::map<std::string, size_t> counts;
    for (const DirectLight& light : plan.lights)
        ++counts[kind_name(light)];
    std::string text;
    for (const auto& [kind, count] : counts)
        text += message(text.empty() ? "" : ", ", count, " ", kind);
    const size_t dark = scene.lights.size() - plan.lights.size();
    return {"direct lights", true,
            message(text, "; nothing hides their light",
                    dark ? message("; ", dark, " without light left out") : "")};
}

std::string why_at_every_point(const ShadeClass& one, const std::vector<const Material*>& materials) {
    if (one.variant[shared::SPEC_HAS_VARYING]) return "roughness varies over the surface";
    for (const Material* material : materials)
        for (const Lobe& shown : material->lobes) {
            const LobeFacts lobe = facts(shown);
            if (!lobe.shape.model->view)
                return message("a ", lobe.shape.model->name, " lobe has no table by view");
            if (!fits_view_table(lobe.width()))
                return "a table by view would be too coarse for so brushed a lobe";
        }
    return "tables by view of so many brushed lobes would take too much memory";
}

const char* why_in_loop(const ShadeClass& one, const Plan& plan) {
    switch (plan.settings.sample_loop) {
    case SampleLoop::written_out:
        return unrolls_samples(plan, one) ? "" : "; in a loop, too many samples to be written out";
    case SampleLoop::loop:
        return "; in a loop for a benchmark";
    case SampleLoop::one_by_one:
        return "; one after the other, which compiles soonest";
    }
    return "";
}

} // namespace

std::string describe(const ShadeClass& one, const Scene& scene, const Plan& plan) {
    std::vector<const Material*> some;
    for (const uint32_t instance : one.instances) {
        const Material* material = &scene.materials[plan.instances[instance].material];
        if (std::find(some.begin(), some.end(), material) == some.end()) some.push_back(material);
    }
    std::string text = listed(visible_materials(scene), some);
    switch (one.table) {
    case TableForm::none:
        break;
    case TableForm::buffer:
        text += message("; samples from a buffer", why_in_loop(one, plan));
        break;
    case TableForm::scaled:
        text += message("; roughness varies over the surface, samples scale with it", why_in_loop(one, plan));
        break;
    case TableForm::matched:
        text += "; mixtures placed at every point: " + why_at_every_point(one, some);
        break;
    case TableForm::matched_by_view:
        text += "; mixtures placed for every view when the material changes";
        break;
    case TableForm::prefiltered:
        text += "; one lookup a lobe in a prefiltered map";
        if (one.variant[shared::SPEC_HAS_TANGENT])
            text += ", brushed lobes as the round ones of slope sqrt(mx my)";
        break;
    }
    return text;
}

const char* describe_diffuse(const SamplerFacts& sampler) {
    const std::optional<DiffuseForm> form = sampler.diffuse;
    if (!form) return "the sum over every texel, or sampled";
    return *form == DiffuseForm::cube ? "one lookup in a cube of exact sums" : "nine spherical harmonics";
}

void add_effect_lines(const Scene& scene, Plan& plan) {
    const auto add = [&](const std::string& name, const std::string& off,
                         const std::function<bool(const Material&)>& asks) {
        add_material_line(scene, plan, name, off, asks);
    };
    for (const Effect& effect : effects()) {
        if (!effect.off) continue;
        // Lobes beyond the first have lines of their own.
        const uint32_t last = effect.constant == shared::SPEC_LOBE_COUNT ? MAX_LOBES : 1;
        for (uint32_t k = 1; k <= last; ++k) {
            const std::string name = k == 1 ? effect.name : message(effect.name, " ", k);
            if (effect.is_of_lobes && !plan.settings.has_lobes)
                plan.effects.push_back({name, false, "captured maps leave lobes out"});
            else
                add(name, k == 1 ? effect.off : message("no material has ", k, " lobes"),
                    [&effect, k](const Material& one) { return effect.wanted({one}) >= k; });
        }
        if (effect.constant == shared::SPEC_HAS_DIFFUSE && plan.effects.back().is_on)
            plan.effects.back().reason += message("; ", describe_diffuse(plan.sampler));
    }
    for (const TextureKind& kind : TEXTURE_KINDS)
        add(kind.name, "no material has one",
            [&](const Material& one) { return has_texture(one, kind.use); });
    add("vertex colour", "no material has vertex colours",
        [](const Material& one) { return one.source && one.source->has_vertex_color; });
    add("unlit", "every material is lit",
        [](const Material& one) { return one.source && one.source->is_unlit; });
    add("alpha mask", "every material is opaque",
        [](const Material& one) { return one.alpha_mode != AlphaMode::opaque; });

    const auto own = std::count_if(scene.objects.begin(), scene.objects.end(),
                                   [](const Object& object) { return object.reflects != nullptr; });
    plan.effects.push_back(
        {"own maps", own > 0,
         own > 0 ? message(own, " of ", scene.objects.size(), " objects reflect a map of their own")
                 : "every object reflects the scene's environment"});
    size_t sun_count = 0;
    for (const std::vector<Sun>& suns : plan.suns)
        sun_count += suns.size();
    plan.effects.push_back({"sun split", sun_count > 0,
                            sun_count > 0 ? message(sun_count, sun_count == 1 ? " sun is" : " suns are",
                                                    " taken out of the map and shaded directly")
                            : plan.sampler.takes_suns_out ? "no map has a sun"
                                                          : "only the matched sampler splits suns off"});
    plan.effects.push_back(light_line(scene, plan));
    const bool has_rotation = std::any_of(plan.environments.begin(), plan.environments.end(),
                                          [](const auto& one) { return one->rotation != glm::mat3(1.0f); });
    plan.effects.push_back({"map rotation", has_rotation,
                            has_rotation ? "an environment is turned" : "no environment is turned"});
    const bool is_software = set_count(plan, MapLookup::sampler) < plan.map_sets.size();
    plan.effects.push_back({"software lookup", is_software, lookup_reason(plan)});
    plan.effects.push_back({"background", plan.has_background,
                            plan.has_background     ? "the environment is shown where no object is"
                            : scene.show_background ? "the scene has no environment"
                                                    : "switched off for the scene"});
    const std::optional<float> exposure = plan.settings.display_exposure;
    plan.effects.push_back({"display output", exposure.has_value(),
                            !exposure ? "linear radiance is asked for"
                            : plan.settings.spp > 1
                                ? "after accumulation: the mean is stored as 8-bit sRGB"
                                : "fused into the store: 8-bit sRGB, nothing else needs linear radiance"});
    for (const Material& material : scene.materials)
        for (const std::string& part : material.left_out)
            plan.effects.push_back(
                {"part without effect", false,
                 message(material.name.empty() ? "a material" : material.name, ": left out, as ", part)});
    plan.effects.push_back(
        {"accumulation", plan.settings.spp > 1,
         plan.settings.spp > 1 ? message(plan.settings.spp, " jittered pictures are averaged") : "spp = 1"});
}

void warn_of_missing_tangents(const Scene& scene, Plan& plan) {
    if (!plan.settings.has_lobes) return;
    std::set<uint32_t> warned;
    for (const Object& object : scene.objects) {
        if (object.mesh >= scene.meshes.size()) continue; // points bring their tangents
        const Mesh& mesh = scene.meshes[object.mesh];
        const bool has_some = !mesh.tangents.empty() || !mesh.uv0.empty() || !mesh.uv1.empty();
        if (has_some || !needs_tangent(scene.materials[object.material])) continue;
        if (!warned.insert(object.mesh).second) continue;
        plan.warnings.push_back(message("mesh \"", mesh.name,
                                        "\": expected tangents or texture coordinates, got none: what is "
                                        "brushed on it follows the longitude around its y axis"));
    }
}

} // namespace burnish
