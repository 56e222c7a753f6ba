#include "burnish/render/shade_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "burnish/error.h"
#include "burnish/plan/material_traits.h"
#include "burnish/render/table_writer.h"
#include "burnish/sampler/prefilter_table.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

bool is_coat(uint32_t which, const ShadeClass& one) {
    return one.variant[shared::SPEC_HAS_COAT] && which + 1 == one.variant[shared::SPEC_LOBE_COUNT];
}

/// The one that no texture varies.
bool is_fixed(uint32_t which, const ShadeClass& one) {
    const uint32_t above = one.variant[shared::SPEC_HAS_COAT] ? 2 : 1;
    return one.variant[shared::SPEC_HAS_FIXED_LOBE] && which + above == one.variant[shared::SPEC_LOBE_COUNT];
}

/// The coat's weight is read from its texture, so the record holds the lobe of weight one.
Lobe lobe_of(const Material& material, uint32_t which, const ShadeClass& one) {
    if (which >= material.lobes.size()) return with_weight(Lobe(), glm::vec3(0.0f));
    const Lobe& lobe = material.lobes[which];
    return is_coat(which, one) ? with_weight(lobe, glm::vec3(1.0f)) : lobe;
}

/// See LobeRecord. A lobe that is not there covers nothing.
glm::vec4 cover_of(const Material& material, uint32_t which) {
    if (which >= material.covers.size()) return glm::vec4(0.0f);
    const Cover& cover = material.covers[which];
    return glm::vec4(cover.albedo.value_or(glm::vec2(-1.0f, 0.0f)), cover.is_over_emission ? 1.0f : 0.0f,
                     0.0f);
}

/// By class: entries of the longest table that it reads without a loop, else 0.
std::vector<uint32_t> unrolled_counts(const Scene& scene, const Plan& plan, TableWriter& writer) {
    std::vector<uint32_t> counts(plan.classes.size(), 0);
    for (const MaterialInstance& instance : plan.instances) {
        const ShadeClass& one = plan.classes[instance.shade_class];
        if (!unrolls_samples(plan, one)) continue;
        for (uint32_t which = 0; which < one.variant[shared::SPEC_LOBE_COUNT]; ++which) {
            const LobeFacts lobe = facts(lobe_of(scene.materials[instance.material], which, one));
            const SampleTable& table =
                writer.table(one.table, lobe.shape, plan.environments[instance.environment]->face_size());
            uint32_t& count = counts[instance.shade_class];
            count = std::max(count, uint32_t(table.entries.size()));
        }
    }
    return counts;
}

shared::MapRecord map_record(const Environment& environment, uint32_t layer,
                             const std::optional<IrradianceCoefficients>& irradiance,
                             const std::vector<Sun>& suns) {
    shared::MapRecord record{};
    record.env_from_world_x = glm::vec4(environment.rotation[0], 0.0f);
    record.env_from_world_y = glm::vec4(environment.rotation[1], 0.0f);
    record.env_from_world_z = glm::vec4(environment.rotation[2], 0.0f);
    // What a kernel adds up is in the unit of the map's halves.
    const int unit = environment.half_range().exponent;
    const double per_unit = std::ldexp(1.0, -unit);
    for (size_t k = 0; irradiance && k < irradiance->size(); ++k)
        record.irradiance[k] = glm::vec4(per_unit * (*irradiance)[k], 0.0);
    record.env_from_world_y.w = float(per_unit);
    record.radiance_scale =
        std::min(std::ldexp(std::exp2(environment.exposure), unit), std::numeric_limits<float>::max());
    record.layer = layer;
    record.face_size = environment.face_size();
    for (size_t k = 0; k < suns.size(); ++k) {
        record.suns[2 * k] = glm::vec4(suns[k].direction, suns[k].variance);
        record.suns[2 * k + 1] = glm::vec4(per_unit * suns[k].flux, 0.0);
    }
    return record;
}

/// Errors of points that reflect different maps are compared in the unit of the brightest one: powers of two,
/// so that sums keep their bits, and no smaller than adds anything.
void set_statistics_scales(std::vector<shared::MapRecord>& maps) {
    constexpr int LEAST_EXPONENT = -40;
    const auto exponent = [](const shared::MapRecord& map) { return std::ilogb(map.radiance_scale); };
    int brightest = std::numeric_limits<int>::min();
    for (const shared::MapRecord& map : maps)
        brightest = std::max(brightest, exponent(map));
    for (shared::MapRecord& map : maps)
        map.env_from_world_x.w = std::ldexp(1.0f, std::max(exponent(map) - brightest, LEAST_EXPONENT));
}

template <typename T>
vulkan::Buffer storage(const vulkan::DevicePointer& device, std::vector<T>& entries) {
    if (entries.empty()) entries.emplace_back(); // a binding must have something behind it
    return vulkan::make_buffer(device, std::as_bytes(std::span(entries)),
                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
}

} // namespace

int emissive_exponent(const Material& material) {
    constexpr double LEAST_TEXEL = 0x1p-12; // of 8 bits in sRGB
    double least = 0.0, largest = 0.0;
    for (int channel = 0; channel < 3; ++channel) {
        const double value = material.emissive[channel];
        if (value > 0.0 && (least == 0.0 || value < least)) least = value;
        largest = std::max(largest, value);
    }
    return half_exponent(LEAST_TEXEL * least, largest);
}

ShadeTables make_shade_tables(const vulkan::DevicePointer& device, const Scene& scene, const Plan& plan,
                              const std::vector<uint32_t>& layers, TableCache& cache,
                              DiffuseLights& diffuse) {
    TableWriter writer(plan, cache);
    std::vector<shared::MaterialRecord> materials;
    std::vector<shared::LobeRecord> lobes;
    std::vector<std::set<uint32_t>> counts(plan.classes.size());
    const std::vector<uint32_t> class_counts = unrolled_counts(scene, plan, writer);
    for (const MaterialInstance& instance : plan.instances) {
        const Material& material = scene.materials[instance.material];
        const ShadeClass& one = plan.classes[instance.shade_class];
        const uint32_t face_size = plan.environments[instance.environment]->face_size();
        materials.push_back({glm::vec4(material.diffuse, 0.0f),
                             glm::vec4(material.emissive, std::ldexp(1.0f, emissive_exponent(material))),
                             uint32_t(lobes.size()), one.variant[shared::SPEC_LOBE_COUNT],
                             instance.environment, instance.shade_class});
        for (uint32_t which = 0; which < one.variant[shared::SPEC_LOBE_COUNT]; ++which) {
            const Lobe shown = lobe_of(material, which, one);
            const LobeFacts lobe = facts(shown);
            shared::LobeRecord record = burnish::record(shown);
            if (plan.sampler.placing == Placing::mixtures) {
                if (one.table == TableForm::matched_by_view) {
                    const auto views = writer.view_table(plan.sampler.samples, lobe,
                                                         one.variant[shared::SPEC_HAS_FRESNEL], face_size);
                    record.table_begin = views.begin;
                    record.view_columns = views.columns;
                    record.view_drift = views.drift;
                } else {
                    record.table_begin = writer.mixtures(plan.sampler.samples, lobe.shape.model->density);
                }
                record.table_count = plan.sampler.samples;
                record.level_share = spherical_share(1.0, face_size);
                counts[instance.shade_class].insert(plan.sampler.samples);
            } else if (one.table == TableForm::prefiltered) {
                counts[instance.shade_class].insert(1);
            } else if (one.table != TableForm::none) {
                const auto samples = writer.samples(writer.table(one.table, lobe.shape, face_size),
                                                    class_counts[instance.shade_class]);
                record.table_begin = samples.begin;
                record.table_count = samples.count;
                counts[instance.shade_class].insert(samples.count);
            }
            if (plan.sampler.needs_albedo || one.variant[shared::SPEC_CONSERVES_ENERGY] ||
                one.variant[shared::SPEC_HAS_LAYERS]) {
                const bool is_varying_brushed = is_brushed(material) && !is_coat(which, one);
                const bool is_varying = one.variant[shared::SPEC_HAS_VARYING] && !is_fixed(which, one);
                const auto albedo = is_varying ? writer.varying_albedo(is_varying_brushed, lobe.shape)
                                               : writer.albedo(lobe.shape);
                record.albedo_begin = albedo.begin;
                record.albedo_width_nodes = is_fixed(which, one) ? 0 : albedo.count;
            }
            record.cover = cover_of(material, which);
            record.threshold_log = plan.sampler.threshold_log;
            lobes.push_back(record);
        }
    }

    ShadeTables tables;
    const std::vector<DiffuseLight> lights = diffuse.of_plan(plan, tables.pass_times);
    for (const DiffuseLight& light : lights)
        tables.diffuse_error = std::max(tables.diffuse_error, light.error);
    std::vector<shared::MapRecord> maps(plan.environments.size());
    for (size_t k = 0; k < maps.size(); ++k)
        maps[k] = map_record(*plan.environments[k], layers[k], lights[k].harmonics, plan.suns[k]);

    set_statistics_scales(maps);

    uint32_t alias_begin = 0;
    for (shared::MapRecord& map : maps) {
        map.alias_begin = alias_begin;
        alias_begin += 6 * map.face_size * map.face_size;
    }

    tables.class_counts = class_counts;
    for (size_t k = 0; k < plan.classes.size(); ++k) {
        const ShadeClass& one = plan.classes[k];
        std::string used;
        for (const uint32_t count : counts[k])
            used += message(used.empty() ? "" : " or ", count);
        tables.samples_used.push_back(
            used.empty() ? "" : used + (one.variant[shared::SPEC_LOBE_COUNT] > 1 ? " a lobe" : ""));
    }
    tables.materials = storage(device, materials);
    tables.material_rows = vulkan::texel_view(tables.materials, VK_FORMAT_R32G32B32A32_UINT);
    tables.lobes = storage(device, lobes);
    tables.lobe_rows = vulkan::texel_view(tables.lobes, VK_FORMAT_R32G32B32A32_UINT);
    tables.map_records = storage(device, maps);
    tables.map_rows = vulkan::texel_view(tables.map_records, VK_FORMAT_R32G32B32A32_UINT);
    tables.samples = cache.sample_buffer(device, std::move(writer.sample_tables));
    std::vector<std::shared_ptr<const IrradianceCube>> cubes;
    // Pipelines that many kinds of material share look it up where nothing is diffuse, too.
    if (plan.sampler.diffuse == DiffuseForm::cube &&
        std::ranges::any_of(plan.classes,
                            [](const ShadeClass& one) { return one.variant[shared::SPEC_HAS_DIFFUSE]; }))
        for (const DiffuseLight& light : lights)
            cubes.push_back(light.cube);
    tables.irradiance = diffuse.buffer(device, std::move(cubes));
    tables.albedo = storage(device, writer.albedo_entries);
    tables.albedo_texels = vulkan::texel_view(tables.albedo, VK_FORMAT_R32G32B32A32_SFLOAT);
    return tables;
}

} // namespace burnish::render
