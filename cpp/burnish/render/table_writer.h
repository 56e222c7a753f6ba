// Sample and albedo tables one after the other, as ShadeTables hold them.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "burnish/plan/plan.h"
#include "burnish/render/table_cache.h"
#include "burnish/sampler/sample_table.h"

namespace burnish::render {

/// Kernels read samples in phases of four.
inline uint32_t whole_phases(uint32_t samples) {
    return (samples + 3) / 4 * 4;
}

/// Appends tables to one buffer, each once.
class TableWriter {
public:
    struct Range {
        uint32_t begin, count;
    };

    TableWriter(const Plan& plan, TableCache& cache) : plan_(plan), cache_(cache) {}

    const SampleTable& table(TableForm form, const LobeShape& shape, uint32_t face_size) {
        LobeShape plain = of_any_colour(shape);
        if (form == TableForm::scaled) plain.width_x = plain.width_y = plain.alpha = 0.0f;
        const std::tuple key(form, plain, face_size);
        auto found = tables_.find(key);
        if (found == tables_.end())
            found = tables_
                        .emplace(key, form == TableForm::scaled
                                          ? build_scaled_table(plan_.settings.sampler, shape, face_size)
                                          : build_sample_table(plan_.settings.sampler, shape, face_size))
                        .first;
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

    /// First entry of the mixtures of a count that stand for a density.
    uint32_t mixtures(uint32_t count, Density density) {
        const std::pair key(count, density);
        auto found = mixture_begins_.find(key);
        if (found == mixture_begins_.end())
            found = mixture_begins_.emplace(key, append(cache_.mixtures(count, density))).first;
        return found->second;
    }

    struct ViewRange {
        uint32_t begin, columns, drift;
    };

    /// First entry of the lookups of one lobe by view, its columns and what its slopes drift by.
    ViewRange view_table(uint32_t count, const LobeFacts& lobe, bool has_schlick, uint32_t face_size) {
        const MatchedLobe key{count, lobe.shape, has_schlick, face_size};
        auto found = view_ranges_.find(key);
        if (found == view_ranges_.end()) {
            const KeptViewTable table = cache_.view_table(key);
            found =
                view_ranges_.emplace(key, ViewRange{append(table.entries), view_columns(key), table.drift})
                    .first;
        }
        return found->second;
    }

    /// First entry and azimuth nodes of the albedo table of a lobe of one roughness.
    Range albedo(const LobeShape& shape) {
        const LobeShape key = of_any_colour(shape);
        const AlbedoTable& table = cache_.albedo(key);
        return albedo(key, table.entries, table.width_nodes);
    }

    /// The same of lobes whose roughness varies; brushed ones have more than one azimuth.
    Range varying_albedo(bool is_brushed, const LobeShape& shape) {
        const float nodes = is_brushed ? 2.0f : 1.0f;
        const LobeShape key{.model = shape.model, .width_x = 0.0f, .width_y = nodes, .alpha = shape.alpha};
        return albedo(key, cache_.varying_albedo(key, is_brushed), uint32_t(nodes));
    }

    std::vector<SampleEntries> sample_tables;
    std::vector<glm::vec4> albedo_entries;

private:
    static LobeShape of_any_colour(LobeShape shape) {
        shape.specular = 1.0f;
        shape.grazing = 0.0f;
        return shape;
    }

    Range albedo(const LobeShape& key, const std::vector<glm::vec2>& table, uint32_t nodes) {
        auto found = albedo_ranges_.find(key);
        if (found == albedo_ranges_.end()) {
            found = albedo_ranges_.emplace(key, Range{uint32_t(albedo_entries.size()), nodes}).first;
            for (size_t k = 0; k < table.size(); ++k) // each with the next: a lookup reads both at once
                albedo_entries.emplace_back(table[k], table[std::min(k + 1, table.size() - 1)]);
        }
        return found->second;
    }

    uint32_t append(SampleEntries entries) {
        const uint32_t begin = entry_count_;
        entry_count_ += uint32_t(entries->size());
        sample_tables.push_back(std::move(entries));
        return begin;
    }

    const Plan& plan_;
    TableCache& cache_;
    uint32_t entry_count_ = 0;
    std::map<std::pair<uint32_t, Density>, uint32_t> mixture_begins_;
    std::map<MatchedLobe, ViewRange> view_ranges_;
    std::map<std::tuple<TableForm, LobeShape, uint32_t>, SampleTable> tables_;
    std::map<std::pair<const SampleTable*, uint32_t>, Range> ranges_;
    std::map<LobeShape, Range> albedo_ranges_;
};

} // namespace burnish::render
