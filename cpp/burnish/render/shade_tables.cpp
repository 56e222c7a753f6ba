#include "burnish/render/shade_tables.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "burnish/error.h"
#include "burnish/sampling/prefilter_table.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

SampleTable build_table(const Sampler& sampler, TableForm form, glm::vec2 roughness, uint32_t face_size) {
    const auto build = [&](const auto& kind) {
        return form == TableForm::scaled ? build_scaled_table(kind, face_size)
                                         : build_sample_table(kind, roughness, face_size);
    };
    if (const auto* regular = std::get_if<Regular>(&sampler)) return build(*regular);
    if (const auto* importance = std::get_if<Importance>(&sampler)) return build(*importance);
    return {};
}

bool needs_albedo(const Sampler& sampler) {
    const auto* regular = std::get_if<Regular>(&sampler);
    return (regular && regular->normalization == Normalization::furnace) ||
           std::holds_alternative<Matched>(sampler) || std::holds_alternative<Prefiltered>(sampler);
}

/// Kernels read samples in phases of four.
uint32_t whole_phases(uint32_t samples) {
    return (samples + 3) / 4 * 4;
}

float mean(glm::vec3 v) {
    return (v.r + v.g + v.b) / 3.0f;
}

/// Appends tables to one buffer, each once.
class TableWriter {
public:
    struct Range {
        uint32_t begin, count;
    };

    TableWriter(const Plan& plan, TableCache& cache) : plan_(plan), cache_(cache) {}

    const SampleTable& table(TableForm form, glm::vec2 roughness, uint32_t face_size) {
        const std::array<float, 4> key = {float(form), roughness.x, roughness.y, float(face_size)};
        auto found = tables_.find(key);
        if (found == tables_.end())
            found =
                tables_.emplace(key, build_table(plan_.settings.sampler, form, roughness, face_size)).first;
        return found->second;
    }

    /// With at least so many entries behind its first.
    Range samples(const SampleTable& table, uint32_t count) {
        const std::pair key(&table, count);
        auto found = ranges_.find(key);
        if (found == ranges_.end()) {
            const uint32_t used = uint32_t(table.entries.size());
            auto entries = std::make_shared<std::vector<glm::vec4>>(table.entries);
            entries->resize(std::max(whole_phases(used), count), glm::vec4(0.0f));
            found = ranges_.emplace(key, Range{append(std::move(entries)), used}).first;
        }
        return found->second;
    }

    /// First entry of the mixtures of a count.
    uint32_t mixtures(uint32_t count) {
        if (!mixtures_begin_) mixtures_begin_ = append(cache_.mixtures(count));
        return *mixtures_begin_;
    }

    /// First entry of the lookups of one lobe by view, and its columns.
    Range view_table(uint32_t count, const KurtLobe& lobe, bool has_schlick, uint32_t face_size) {
        MatchedLobe key{count, lobe.roughness.x, lobe.roughness.y, lobe.alpha, 1.0f,
                        0.0f,  has_schlick,      face_size};
        const float specular = mean(lobe.weight * lobe.r0), total = mean(lobe.weight);
        if (lobe.has_fresnel() && total > 0.0f) {
            // Where nothing is reflected, some direction must still come out.
            key.specular = std::clamp(specular / total, 1e-3f, 1.0f);
            key.grazing = 1.0f - key.specular;
        }
        auto found = view_begins_.find(key);
        if (found == view_begins_.end())
            found = view_begins_.emplace(key, append(cache_.view_table(key))).first;
        return {found->second, view_columns(key)};
    }

    /// First entry and azimuth nodes of the albedo table of a lobe.
    Range albedo(bool is_varying, glm::vec2 roughness, float alpha) {
        const std::array<float, 3> key =
            is_varying ? std::array{0.0f, 0.0f, alpha} : std::array{roughness.x, roughness.y, alpha};
        auto found = albedo_ranges_.find(key);
        if (found == albedo_ranges_.end()) {
            const std::vector<glm::vec2>& table =
                is_varying ? cache_.varying_albedo(alpha) : cache_.albedo(roughness, alpha).entries;
            const uint32_t nodes = is_varying ? 1 : cache_.albedo(roughness, alpha).width_nodes;
            found = albedo_ranges_.emplace(key, Range{uint32_t(albedo_entries.size()), nodes}).first;
            for (size_t k = 0; k < table.size(); ++k) // each with the next: a lookup reads both at once
                albedo_entries.emplace_back(table[k], table[std::min(k + 1, table.size() - 1)]);
        }
        return found->second;
    }

    std::vector<SampleEntries> sample_tables;
    std::vector<glm::vec4> albedo_entries;

private:
    uint32_t append(SampleEntries entries) {
        const uint32_t begin = entry_count_;
        entry_count_ += uint32_t(entries->size());
        sample_tables.push_back(std::move(entries));
        return begin;
    }

    const Plan& plan_;
    TableCache& cache_;
    uint32_t entry_count_ = 0;
    std::optional<uint32_t> mixtures_begin_;
    std::map<MatchedLobe, uint32_t> view_begins_;
    std::map<std::array<float, 4>, SampleTable> tables_;
    std::map<std::pair<const SampleTable*, uint32_t>, Range> ranges_;
    std::map<std::array<float, 3>, Range> albedo_ranges_;
};

shared::LobeRecord lobe_record(const KurtLobe& lobe) {
    shared::LobeRecord record{};
    record.specular = glm::vec4(lobe.weight * lobe.r0, lobe.roughness.x);
    record.grazing = glm::vec4(lobe.weight * (1.0f - lobe.r0), lobe.roughness.y);
    record.alpha = lobe.alpha;
    record.rotation_cos = std::cos(lobe.rotation);
    record.rotation_sin = std::sin(lobe.rotation);
    record.albedo_width_nodes = 1;
    record.conserves_energy = lobe.conserve_energy ? 1 : 0;
    return record;
}

/// The coat's weight is read from its texture, so the record holds the lobe of weight one.
KurtLobe lobe_of(const Material& material, uint32_t which, const ShadeTraits& traits) {
    KurtLobe lobe =
        which < material.lobes.size() ? material.lobes[which] : KurtLobe{.weight = glm::vec3(0.0f)};
    if (traits.has_coat && which == 1) lobe.weight = glm::vec3(1.0f);
    return lobe;
}

/// By class: entries of the longest table that it reads without a loop, else 0.
std::vector<uint32_t> unrolled_counts(const Scene& scene, const Plan& plan, TableWriter& writer) {
    std::vector<uint32_t> counts(plan.classes.size(), 0);
    for (const MaterialInstance& instance : plan.instances) {
        const ShadeTraits& traits = plan.classes[instance.shade_class].traits;
        if (!unrolls_samples(plan.settings, traits)) continue;
        for (uint32_t which = 0; which < traits.lobe_count; ++which) {
            const KurtLobe lobe = lobe_of(scene.materials[instance.material], which, traits);
            const SampleTable& table = writer.table(traits.table, lobe.roughness,
                                                    plan.environments[instance.environment]->face_size());
            uint32_t& count = counts[instance.shade_class];
            count = std::max(count, uint32_t(table.entries.size()));
        }
    }
    // What stands in for constants is for all roughnesses, and brushed lobes have a few samples more or less
    // with each. Several lobes never are constants: they keep the pipeline that they have anyway.
    if (plan.settings.sample_source == SampleSource::buffer ||
        plan.settings.sample_source == SampleSource::meanwhile)
        for (size_t k = 0; k < counts.size(); ++k)
            if (plan.classes[k].traits.lobe_count == 1) counts[k] = whole_phases(counts[k]);
    return counts;
}

shared::MapRecord map_record(const Environment& environment, uint32_t layer,
                             const std::optional<IrradianceCoefficients>& irradiance,
                             const std::vector<Sun>& suns) {
    shared::MapRecord record{};
    record.env_from_world_x = glm::vec4(environment.rotation[0], 0.0f);
    record.env_from_world_y = glm::vec4(environment.rotation[1], 0.0f);
    record.env_from_world_z = glm::vec4(environment.rotation[2], 0.0f);
    for (size_t k = 0; irradiance && k < irradiance->size(); ++k)
        record.irradiance[k] = glm::vec4((*irradiance)[k], 0.0);
    record.radiance_scale = std::exp2(environment.exposure);
    record.layer = layer;
    record.face_size = environment.face_size();
    for (size_t k = 0; k < suns.size(); ++k) {
        record.suns[2 * k] = glm::vec4(suns[k].direction, suns[k].variance);
        record.suns[2 * k + 1] = glm::vec4(suns[k].flux, 0.0);
    }
    return record;
}

template <typename T>
vulkan::Buffer storage(const vulkan::DevicePointer& device, std::vector<T>& entries) {
    if (entries.empty()) entries.emplace_back(); // a binding must have something behind it
    return vulkan::make_buffer(device, std::as_bytes(std::span(entries)),
                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
}

} // namespace

ShadeTables make_shade_tables(const vulkan::DevicePointer& device, const Scene& scene, const Plan& plan,
                              TableCache& cache, DiffuseLights& diffuse) {
    TableWriter writer(plan, cache);
    std::vector<shared::MaterialRecord> materials;
    std::vector<shared::LobeRecord> lobes;
    std::vector<std::set<uint32_t>> counts(plan.classes.size());
    const std::vector<uint32_t> class_counts = unrolled_counts(scene, plan, writer);
    for (const MaterialInstance& instance : plan.instances) {
        const Material& material = scene.materials[instance.material];
        const ShadeTraits& traits = plan.classes[instance.shade_class].traits;
        const uint32_t face_size = plan.environments[instance.environment]->face_size();
        materials.push_back({glm::vec4(material.diffuse, 0.0f), glm::vec4(material.emissive, 0.0f),
                             uint32_t(lobes.size()), traits.lobe_count, instance.environment,
                             instance.shade_class});
        for (uint32_t which = 0; which < traits.lobe_count; ++which) {
            const KurtLobe lobe = lobe_of(material, which, traits);
            shared::LobeRecord record = lobe_record(lobe);
            if (const auto* matched = std::get_if<Matched>(&plan.settings.sampler)) {
                if (traits.table == TableForm::matched_by_view) {
                    const auto views =
                        writer.view_table(matched->samples, lobe, traits.has_fresnel, face_size);
                    record.table_begin = views.begin;
                    record.view_columns = views.count;
                } else {
                    record.table_begin = writer.mixtures(matched->samples);
                }
                record.table_count = matched->samples;
                record.variance_share = spherical_share(1.0, face_size);
                counts[instance.shade_class].insert(matched->samples);
            } else if (traits.table == TableForm::prefiltered) {
                counts[instance.shade_class].insert(1);
            } else if (traits.table != TableForm::none) {
                const auto samples = writer.samples(writer.table(traits.table, lobe.roughness, face_size),
                                                    class_counts[instance.shade_class]);
                record.table_begin = samples.begin;
                record.table_count = samples.count;
                counts[instance.shade_class].insert(samples.count);
            }
            if (needs_albedo(plan.settings.sampler) || traits.conserves_energy) {
                const auto albedo = writer.albedo(traits.has_varying, lobe.roughness, lobe.alpha);
                record.albedo_begin = albedo.begin;
                record.albedo_width_nodes = albedo.count;
            }
            if (const auto* regular = std::get_if<Regular>(&plan.settings.sampler))
                record.threshold_log = -std::log(regular->threshold);
            lobes.push_back(record);
        }
    }

    ShadeTables tables;
    const std::vector<DiffuseLight> lights = diffuse.of_plan(plan, tables.pass_times);
    for (const DiffuseLight& light : lights)
        tables.diffuse_error = std::max(tables.diffuse_error, light.error);
    std::vector<shared::MapRecord> maps(plan.environments.size());
    for (const MapSet& set : plan.map_sets)
        for (uint32_t layer = 0; layer < set.environments.size(); ++layer) {
            const uint32_t k = set.environments[layer];
            maps[k] = map_record(*plan.environments[k], layer, lights[k].harmonics, plan.suns[k]);
        }

    uint32_t alias_begin = 0;
    for (shared::MapRecord& map : maps) {
        map.alias_begin = alias_begin;
        alias_begin += 6 * map.face_size * map.face_size;
    }

    tables.class_counts = class_counts;
    for (size_t k = 0; k < plan.classes.size(); ++k) {
        const ShadeTraits& traits = plan.classes[k].traits;
        SampleTable table;
        if (traits.table == TableForm::constant)
            table = build_table(plan.settings.sampler, traits.table, traits.roughness,
                                plan.map_sets[traits.map_set].face_size);
        tables.class_tables.push_back(std::move(table));
        std::string used;
        for (const uint32_t count : counts[k])
            used += message(used.empty() ? "" : " or ", count);
        tables.samples_used.push_back(used.empty() ? "" : used + (traits.lobe_count > 1 ? " a lobe" : ""));
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
    if (diffuse_form(plan.settings.sampler) == DiffuseForm::cube &&
        std::ranges::any_of(plan.classes, [](const ShadeClass& one) { return one.traits.has_diffuse; }))
        for (const DiffuseLight& light : lights)
            cubes.push_back(light.cube);
    tables.irradiance = diffuse.buffer(device, std::move(cubes));
    tables.albedo = storage(device, writer.albedo_entries);
    tables.albedo_texels = vulkan::texel_view(tables.albedo, VK_FORMAT_R32G32B32A32_SFLOAT);
    return tables;
}

} // namespace burnish::render
