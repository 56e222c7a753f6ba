#include "burnish/plan/plan.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>

#include "burnish/error.h"
#include "burnish/plan/effects.h"
#include "burnish/plan/lines.h"
#include "burnish/plan/material_traits.h"
#include "burnish/sampler/matched_view_table.h"
#include "shared/constants.h"

namespace burnish {
namespace {

/// Stands in where a scene has no environment: nothing is lit, nothing crashes.
std::shared_ptr<const Environment> black_environment() {
    static const auto black =
        std::make_shared<const Environment>(Environment::from_faces(1, std::vector<float>(18, 0.0f)));
    return black;
}

uint32_t add_environment(Plan& plan, const std::shared_ptr<const Environment>& read,
                         const std::shared_ptr<const Environment>& whole, const std::vector<Sun>& suns) {
    const auto found = std::find(plan.environments.begin(), plan.environments.end(), read);
    if (found != plan.environments.end()) return uint32_t(found - plan.environments.begin());
    plan.environments.push_back(read);
    plan.whole_environments.push_back(whole);
    plan.suns.push_back(suns);
    return uint32_t(plan.environments.size() - 1);
}

/// The map that lobes look up, with its suns taken out where the sampler shades them directly.
uint32_t add_lit_environment(Plan& plan, const std::shared_ptr<const Environment>& whole, SunCache& suns) {
    if (!plan.settings.has_lobes || !plan.sampler.takes_suns_out)
        return add_environment(plan, whole, whole, {});
    const SplitEnvironment split = suns.split(whole);
    return add_environment(plan, split.rest, whole, split.suns);
}

/// Every pair of material and map that some object shows.
void add_instances(const Scene& scene, Plan& plan, SunCache& suns) {
    const auto far = scene.environment ? scene.environment : black_environment();
    // A background is drawn with its suns; where there is none, the map is not needed for it.
    if (plan.has_background || scene.objects.empty()) add_environment(plan, far, far, {});
    for (const Object& object : scene.objects) {
        const uint32_t environment = add_lit_environment(plan, object.reflects ? object.reflects : far, suns);
        const auto found =
            std::find_if(plan.instances.begin(), plan.instances.end(), [&](const MaterialInstance& instance) {
                return instance.material == object.material && instance.environment == environment;
            });
        plan.object_instance.push_back(uint32_t(found - plan.instances.begin()));
        if (found == plan.instances.end()) plan.instances.push_back({object.material, environment, 0});
    }
    // A surface point names its instance in 16 bits, and 0 means none.
    if (plan.instances.size() > 0xfffe)
        throw std::invalid_argument(
            message("scene: expected at most 65534 pairs of material and map, got ", plan.instances.size()));
}

void add_lights(const Scene& scene, Plan& plan) {
    for (const DirectLight& light : scene.lights) {
        if (!is_lit(light)) continue;
        plan.lights.push_back(light);
        plan.lists_lights |= is_bounded(light);
    }
}

void add_map_sets(Plan& plan) {
    for (uint32_t k = 0; k < plan.environments.size(); ++k) {
        const uint32_t face_size = plan.environments[k]->face_size();
        const auto found = std::find_if(plan.map_sets.begin(), plan.map_sets.end(),
                                        [&](const MapSet& set) { return set.face_size == face_size; });
        if (found == plan.map_sets.end())
            plan.map_sets.push_back({face_size, {k}, MapLookup::sampler});
        else
            found->environments.push_back(k);
    }
    for (MapSet& set : plan.map_sets)
        set.lookup = plan.settings.lookup.of(set.face_size, set.environments.size());
}

uint32_t map_set_of(const Plan& plan, uint32_t environment) {
    for (uint32_t k = 0; k < plan.map_sets.size(); ++k)
        if (plan.map_sets[k].face_size == plan.environments[environment]->face_size()) return k;
    throw std::logic_error("plan: an environment without a map set");
}

/// Slope from which a component of a mixture bends so much that its mean takes five points instead of two.
constexpr float WIDE_LOBE = 0.2f;

/// Entries of brushed lobes' tables by view that a scene may have: 256 MB.
constexpr uint64_t MOST_VIEW_ENTRIES = 16'000'000;

/// Whether the tables by view of all brushed lobes in the scene fit.
bool fit_view_tables(const Scene& scene, const Plan& plan) {
    if (plan.sampler.placing != Placing::mixtures) return false;
    std::set<MatchedLobe> tables;
    for (const MaterialInstance& instance : plan.instances)
        for (const Lobe& one : scene.materials[instance.material].lobes)
            if (const LobeFacts lobe = facts(one); lobe.is_brushed && lobe.shape.model->view)
                tables.insert(
                    {.samples = plan.sampler.samples, .shape = lobe.shape, .has_schlick = lobe.has_fresnel});
    uint64_t entries = 0;
    for (const MatchedLobe& table : tables)
        entries += view_table_entries(table);
    return entries <= MOST_VIEW_ENTRIES;
}

/// Samples depend on the lobe and the view in its frame: they are placed once for every view, unless a
/// texture varies the lobe, or tables would be too coarse or too large. Then they are placed at every point,
/// with as many points a component as the widest lobe needs.
TableForm matched_form(const Material& material, bool fit_tables, ShadeClass& one) {
    const bool has_varying = one.variant[shared::SPEC_HAS_VARYING];
    if (!has_varying && !any_lobe(material, [&](const LobeFacts& lobe) {
            return !lobe.shape.model->view ||
                   (lobe.is_brushed && !(fit_tables && fits_view_table(lobe.width())));
        }))
        return TableForm::matched_by_view;
    one.has_wide_components = has_varying || any_lobe(material, [](const LobeFacts& lobe) {
                                  return std::min(lobe.shape.width_x, lobe.shape.width_y) > WIDE_LOBE;
                              });
    return TableForm::matched;
}

ShadeClass class_of(const Scene& scene, const Plan& plan, const MaterialInstance& instance, bool fit_tables) {
    const Material& material = scene.materials[instance.material];
    const Environment& environment = *plan.environments[instance.environment];
    const Subject subject{material, environment.rotation != glm::mat3(1.0f),
                          uint32_t(plan.suns[instance.environment].size()), !plan.lights.empty()};
    ShadeClass one;
    one.variant = variant_of(subject, plan.settings.has_lobes);
    one.map_set = map_set_of(plan, instance.environment);
    if (one.variant[shared::SPEC_LOBE_COUNT] == 0) return one;
    switch (plan.sampler.placing) {
    case Placing::none:
        break;
    case Placing::mixtures:
        one.table = matched_form(material, fit_tables, one);
        break;
    case Placing::mirror:
        one.table = TableForm::prefiltered;
        break;
    case Placing::pattern:
        one.table = one.variant[shared::SPEC_HAS_VARYING] ? TableForm::scaled : TableForm::buffer;
        break;
    }
    return one;
}

/// Groups instances that can share a pipeline, after `coarsen` has dropped what may be dropped.
void group(Plan& plan, const std::vector<ShadeClass>& classes,
           const std::function<void(ShadeClass&)>& coarsen) {
    plan.classes.clear();
    for (uint32_t k = 0; k < plan.instances.size(); ++k) {
        ShadeClass wanted = classes[k];
        coarsen(wanted);
        auto found = std::find_if(plan.classes.begin(), plan.classes.end(),
                                  [&](const ShadeClass& one) { return one.can_share(wanted); });
        if (found == plan.classes.end()) found = plan.classes.insert(found, std::move(wanted));
        found->instances.push_back(k);
        plan.instances[k].shade_class = uint32_t(found - plan.classes.begin());
    }
}

void share_pipelines(ShadeClass& one) {
    one.variant = shared_variant(one.variant);
    one.has_wide_components = one.table == TableForm::matched;
}

void add_classes(const Scene& scene, Plan& plan) {
    std::vector<ShadeClass> classes;
    const bool fit_tables = fit_view_tables(scene, plan);
    for (const MaterialInstance& instance : plan.instances)
        classes.push_back(class_of(scene, plan, instance, fit_tables));
    group(plan, classes, [](ShadeClass&) {});
    // One class is left for the background.
    if (plan.classes.size() > shared::MAX_SHADE_CLASSES - 1) group(plan, classes, share_pipelines);
    if (plan.classes.size() > shared::MAX_SHADE_CLASSES - 1)
        throw std::invalid_argument(message("scene: expected at most ", shared::MAX_SHADE_CLASSES - 1,
                                            " combinations of lobe count, face size and texturing, got ",
                                            plan.classes.size()));
    for (const MaterialInstance& instance : plan.instances)
        if (has_diffuse(scene.materials[instance.material]) &&
            std::ranges::find(plan.diffuse_environments, instance.environment) ==
                plan.diffuse_environments.end())
            plan.diffuse_environments.push_back(instance.environment);
    for (ShadeClass& one : plan.classes) {
        one.reason = describe(one, scene, plan);
        plan.has_lookups |= one.variant[shared::SPEC_LOBE_COUNT] > 0;
        plan.has_varying |= one.variant[shared::SPEC_HAS_VARYING];
        for (const uint32_t instance : one.instances)
            plan.has_all_targets |= has_varying_emissive(scene.materials[plan.instances[instance].material]);
        plan.has_all_targets |= one.variant[shared::SPEC_HAS_COAT];
        plan.has_tangent |= one.variant[shared::SPEC_HAS_TANGENT];
    }
}

void warn_of_nothing_drawn(const Scene& scene, Plan& plan) {
    const auto shows = [&](const Object& object) {
        // Points are shaded without a mesh.
        const bool has_triangles =
            object.mesh >= scene.meshes.size() || !scene.meshes[object.mesh].indices.empty();
        return has_triangles && has_coverage(scene.materials[object.material]);
    };
    if (scene.objects.empty())
        plan.warnings.push_back("nothing is drawn: the scene has no objects");
    else if (std::none_of(scene.objects.begin(), scene.objects.end(), shows))
        plan.warnings.push_back(
            "nothing is drawn: every object is without triangles, or its coverage below its cutoff");
}

} // namespace

bool unrolls_samples(const Plan& plan, const ShadeClass& one) {
    if (plan.settings.sample_loop != SampleLoop::written_out) return false;
    if (one.table != TableForm::buffer && one.table != TableForm::scaled) return false;
    return uint64_t(plan.sampler.samples) * one.variant[shared::SPEC_LOBE_COUNT] <=
           shared::MAX_UNROLLED_SAMPLES;
}

SplitEnvironment SunCache::split(const std::shared_ptr<const Environment>& environment) {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.environment.expired(); });
    auto found = entries_.find(environment.get());
    if (found == entries_.end()) {
        SunSplit texels = split_suns({environment->face_size(), environment->radiance()});
        Entry entry{environment, nullptr, std::move(texels.suns)};
        if (!entry.suns.empty()) {
            entry.rest = std::make_shared<Environment>(
                Environment::from_faces(environment->face_size(), std::move(texels.radiance)));
            entry.rest->name = environment->name + " without its suns";
        }
        found = entries_.emplace(environment.get(), std::move(entry)).first;
    }
    const Entry& entry = found->second;
    if (!entry.rest) return {{}, environment};
    entry.rest->rotation = environment->rotation;
    entry.rest->exposure = environment->exposure;
    return {entry.suns, entry.rest};
}

Plan make_plan(const Scene& scene, const PlanSettings& settings, SunCache& suns) {
    validate(settings.sampler);
    if (settings.spp < 1 || settings.spp > 65536)
        throw std::invalid_argument(message("spp: expected 1..65536, got ", settings.spp));
    Plan plan;
    plan.settings = settings;
    plan.sampler = facts(settings.sampler);
    plan.has_background = scene.show_background && scene.environment;
    add_instances(scene, plan, suns);
    add_map_sets(plan);
    add_lights(scene, plan);
    add_classes(scene, plan);
    warn_of_nothing_drawn(scene, plan);
    if (!scene.environment && plan.lights.empty())
        plan.warnings.push_back("the scene has no environment and no light: only emission is seen");
    warn_of_missing_tangents(scene, plan);
    if (plan.has_tangent && plan.sampler.is_round)
        plan.warnings.push_back(
            "prefiltered maps are round: brushed lobes reflect as the round ones of slope sqrt(mx my)");
    add_effect_lines(scene, plan);
    plan.passes = passes_of(plan);
    return plan;
}

} // namespace burnish
