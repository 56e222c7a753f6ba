#include "burnish/plan/effects.h"

#include <algorithm>
#include <array>

#include "burnish/error.h"
#include "burnish/plan/material_traits.h"
#include "shared/constants.h"

namespace burnish {
namespace {

uint32_t alpha_form(const Subject& subject) {
    uint32_t all = shared::ALPHA_ZERO;
    for (const Lobe& lobe : subject.material.lobes) {
        const uint32_t form = facts(lobe).alpha_form;
        const bool is_first = &lobe == &subject.material.lobes.front();
        all = is_first || all == form ? form : shared::ALPHA_GENERAL;
    }
    return all;
}

/// Four bits a lobe.
uint32_t lobe_models(const Subject& subject) {
    uint32_t models = 0;
    for (size_t which = 0; which < subject.material.lobes.size(); ++which)
        models |= facts(subject.material.lobes[which]).shape.model->id << (shared::MODEL_BITS * which);
    return models;
}

bool has_fresnel(const Subject& subject) {
    return any_lobe(subject.material,
                    [&](const LobeFacts& lobe) { return lobe.has_fresnel || is_varying(subject.material); });
}

bool scales_energy(const Subject& subject) {
    return any_lobe(subject.material, [](const LobeFacts& lobe) { return lobe.scales_energy; });
}

bool has_lobes(const Variant& variant) {
    return variant[shared::SPEC_LOBE_COUNT] > 0;
}

uint32_t on(uint32_t, const Variant&) {
    return 1;
}

uint32_t on_of_lobes(uint32_t value, const Variant& variant) {
    return has_lobes(variant) ? 1 : value;
}

uint32_t shared_coat(uint32_t value, const Variant& variant) {
    // Lobes of such a material are told apart by their number.
    if (variant[shared::SPEC_HAS_FIXED_LOBE]) return value;
    return variant[shared::SPEC_HAS_VARYING] && variant[shared::SPEC_LOBE_COUNT] > 1 ? 1 : value;
}

constexpr std::array EFFECTS = {
    Effect{shared::SPEC_LOBE_COUNT, "lobe", "no material has a lobe", true, true,
           [](const Subject& one) { return uint32_t(one.material.lobes.size()); }, nullptr},
    Effect{shared::SPEC_LOBE_MODELS, "other lobe models", "every lobe is of the default model", true, true,
           lobe_models, nullptr},
    Effect{shared::SPEC_HAS_FRESNEL, "fresnel", "every lobe has r0 = 1", true, false,
           [](const Subject& one) { return uint32_t(has_fresnel(one)); }, on_of_lobes},
    Effect{shared::SPEC_ALPHA, "alpha", "every lobe has alpha = 0", true, false, alpha_form,
           [](uint32_t value, const Variant& all) { return has_lobes(all) ? shared::ALPHA_GENERAL : value; }},
    Effect{shared::SPEC_CONSERVES_ENERGY, "energy conservation", "no lobe asks for it", true, true,
           [](const Subject& one) { return uint32_t(scales_energy(one)); }, on_of_lobes},
    Effect{shared::SPEC_HAS_LAYERS, "layers", "no material is layered", true, true,
           [](const Subject& one) { return uint32_t(has_layers(one.material)); }, on_of_lobes},
    Effect{shared::SPEC_HAS_TANGENT, "anisotropy", "every lobe is round", true, true,
           [](const Subject& one) { return uint32_t(is_brushed(one.material)); }, on_of_lobes},
    Effect{shared::SPEC_HAS_COAT, "clear coat", nullptr, true, true,
           [](const Subject& one) { return uint32_t(is_varying(one.material) && has_coat(one.material)); },
           shared_coat},
    Effect{shared::SPEC_HAS_COAT_NORMAL, "clear coat normal",
           "no clear coat lies over a normal map or has one", true, true,
           [](const Subject& one) { return uint32_t(has_coat_normal(one.material)); },
           [](uint32_t value, const Variant& all) {
               return has_lobes(all) ? shared_coat(all[shared::SPEC_HAS_COAT], all) : value;
           }},
    Effect{shared::SPEC_HAS_FIXED_LOBE, "lobe without textures", nullptr, true, true,
           [](const Subject& one) { return uint32_t(has_fixed_lobe(one.material)); }, nullptr},
    Effect{shared::SPEC_HAS_DIFFUSE, "diffuse", "every diffuse reflectance is 0", false, true,
           [](const Subject& one) { return uint32_t(has_diffuse(one.material)); }, on},
    Effect{shared::SPEC_HAS_EMISSIVE, "emissive", "no material emits", false, true,
           [](const Subject& one) { return uint32_t(has_emissive(one.material)); }, on},
    Effect{shared::SPEC_HAS_VARYING, "textures", nullptr, false, true,
           [](const Subject& one) { return uint32_t(is_varying(one.material)); }, nullptr},
    Effect{shared::SPEC_SUN_COUNT, "sun split", nullptr, true, false,
           [](const Subject& one) { return one.material.lobes.empty() ? 0 : one.sun_count; },
           // Those that are not there have no flux.
           [](uint32_t value, const Variant&) { return value > 0 ? shared::MAX_SUNS : 0; }},
    Effect{shared::SPEC_HAS_LIGHTS, "direct lights", nullptr, false, true,
           [](const Subject& one) {
               return uint32_t(one.has_lights && (!one.material.lobes.empty() || has_diffuse(one.material)));
           },
           nullptr},
    Effect{shared::SPEC_HAS_MAP_ROTATION, "map rotation", nullptr, false, true,
           [](const Subject& one) { return uint32_t(one.is_map_turned); }, on},
};

} // namespace

std::span<const Effect> effects() {
    return EFFECTS;
}

Variant variant_of(const Subject& subject, bool has_lobes) {
    Variant variant;
    for (const Effect& effect : EFFECTS)
        if (has_lobes || !effect.is_of_lobes) variant[effect.constant] = effect.wanted(subject);
    return variant;
}

Variant shared_variant(const Variant& variant) {
    Variant result = variant;
    for (const Effect& effect : EFFECTS)
        if (effect.shared) result[effect.constant] = effect.shared(variant[effect.constant], variant);
    return result;
}

std::vector<std::string> effect_names(const Variant& variant) {
    std::vector<std::string> names;
    for (const Effect& effect : EFFECTS) {
        const uint32_t value = variant[effect.constant];
        if (value == 0) continue;
        if (effect.constant == shared::SPEC_LOBE_COUNT)
            names.push_back(value == 1 ? "1 lobe" : message(value, " lobes"));
        else if (effect.constant == shared::SPEC_ALPHA && value == shared::ALPHA_HALF)
            names.emplace_back("alpha .5");
        else
            names.emplace_back(effect.name);
    }
    return names;
}

std::vector<EffectValue> effect_values(const Variant& variant) {
    std::vector<EffectValue> values;
    for (const Effect& effect : EFFECTS)
        values.push_back({effect.name, variant[effect.constant]});
    return values;
}

} // namespace burnish
