#include "burnish/render/shade_variant.h"

#include <bit>

#include "burnish/plan/effects.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

uint32_t code_of(MapLookup lookup) {
    switch (lookup) {
    case MapLookup::sampler:
        return shared::LOOKUP_SAMPLER;
    case MapLookup::software:
        return shared::LOOKUP_TEXELS;
    case MapLookup::software_stored:
        return shared::LOOKUP_STORAGE;
    }
    return shared::LOOKUP_SAMPLER;
}

uint32_t table_of(TableForm form, const SamplerFacts& sampler) {
    switch (form) {
    case TableForm::scaled:
        return sampler.scaled_table;
    case TableForm::matched:
        return shared::TABLE_MATCHED;
    case TableForm::matched_by_view:
        return shared::TABLE_MATCHED_BY_VIEW;
    case TableForm::prefiltered:
        return shared::TABLE_PREFILTERED;
    case TableForm::none:
    case TableForm::buffer:
        return shared::TABLE_BUFFER;
    }
    return shared::TABLE_BUFFER;
}

const char* shader_of(TableForm form) {
    switch (form) {
    case TableForm::none:
    case TableForm::buffer:
    case TableForm::scaled:
        return "shade/shade_pattern.comp";
    case TableForm::matched:
        return "shade/shade_matched.comp";
    case TableForm::matched_by_view:
        return "shade/shade_matched_by_view.comp";
    case TableForm::prefiltered:
        return "shade/shade_prefiltered.comp";
    }
    return "shade/shade_pattern.comp";
}

/// What kernels of the plan's samplers and of the reference share.
vulkan::SpecializationConstants common_constants(const Plan& plan, uint32_t shade_class, ShadeTarget target,
                                                 bool is_reference) {
    const ShadeClass& one = plan.classes[shade_class];
    vulkan::SpecializationConstants constants;
    constants.set(shared::SPEC_SOURCE, target.is_points ? shared::SOURCE_POINTS : shared::SOURCE_PIXELS)
        .set(shared::SPEC_IS_DISPLAY, target.is_display)
        .set(shared::SPEC_COUNTS_NON_FINITE, target.counts_non_finite)
        .set(shared::SPEC_HAS_VARYING_EMISSIVE, plan.has_all_targets)
        .set(shared::SPEC_SHADE_CLASS, shade_class)
        .set(shared::SPEC_TILE_LIST, shade_class + (target.is_dark ? first_dark_list(plan) : 0));
    for (const Effect& effect : effects())
        if (effect.is_of_reference || !is_reference)
            constants.set(effect.constant, one.variant[effect.constant]);
    if (target.is_dark)
        constants.set(shared::SPEC_HAS_LIGHTS, 0u);
    else if (one.variant[shared::SPEC_HAS_LIGHTS])
        constants.set(shared::SPEC_LISTS_LIGHTS, plan.lists_lights);
    add_lookup_constants(constants, plan.map_sets[one.map_set]);
    return constants;
}

/// `sample_count`: of each lobe in buffer or scaled form, 0 for a loop.
void add_pattern_constants(vulkan::SpecializationConstants& constants, const ShadeClass& one,
                           const Plan& plan, uint32_t sample_count) {
    const SamplerFacts& sampler = plan.sampler;
    const bool is_scaled = one.table == TableForm::scaled;
    constants.set(shared::SPEC_TABLE, table_of(one.table, sampler))
        .set(shared::SPEC_FOOTPRINT, sampler.footprint)
        .set(shared::SPEC_WITHOUT_LOOKUPS, !plan.settings.has_lookups)
        .set(shared::SPEC_NORMALIZATION, is_scaled ? sampler.scaled_normalization : sampler.normalization);
    if (one.table == TableForm::matched || one.table == TableForm::matched_by_view)
        constants.set(shared::SPEC_SAMPLE_COUNT, sampler.samples)
            .set(shared::SPEC_WIDE_COMPONENTS, one.has_wide_components);
    if (one.table == TableForm::buffer || one.table == TableForm::scaled) {
        constants.set(shared::SPEC_SAMPLE_COUNT, sample_count);
        if (plan.settings.sample_loop == SampleLoop::one_by_one) constants.set(shared::SPEC_PHASE, 1u);
    }
}

} // namespace

uint32_t first_dark_list(const Plan& plan) {
    return uint32_t(plan.classes.size()) + 1;
}

uint32_t tile_list_count(const Plan& plan) {
    return first_dark_list(plan) * (plan.lists_lights ? 2 : 1);
}

ComputeKey shade_key(const Plan& plan, const ShadeTables& tables, uint32_t shade_class, ShadeTarget target) {
    const ShadeClass& one = plan.classes[shade_class];
    vulkan::SpecializationConstants constants = common_constants(plan, shade_class, target, false);
    add_pattern_constants(constants, one, plan, tables.class_counts[shade_class]);
    constants
        .set(shared::SPEC_SAMPLE_TABLE_IS_STORED,
             tables.samples->elements.access() == vulkan::ElementAccess::storage)
        .set(shared::SPEC_HAS_HARMONICS, plan.sampler.diffuse == DiffuseForm::harmonics)
        .set(shared::SPEC_IRRADIANCE_IS_STORED,
             tables.irradiance->elements.access() == vulkan::ElementAccess::storage);
    return {shader_of(one.table), constants};
}

ComputeKey reference_key(const Plan& plan, uint32_t shade_class, ShadeTarget target, bool is_quadrature) {
    vulkan::SpecializationConstants constants = common_constants(plan, shade_class, target, true);
    constants.set(shared::SPEC_IS_QUADRATURE, is_quadrature);
    return {"shade/reference.comp", constants};
}

void add_lookup_constants(vulkan::SpecializationConstants& constants, const MapSet& set) {
    const bool is_software = set.lookup != MapLookup::sampler;
    constants.set(shared::SPEC_LOOKUP, code_of(set.lookup))
        .set(shared::SPEC_LAST_LEVEL, is_software ? std::countr_zero(set.face_size) : 0);
}

} // namespace burnish::render
