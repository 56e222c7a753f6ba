#include "burnish/render/table_cache.h"

#include <span>

#include "burnish/sampler/matched_table.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {
namespace {

constexpr VkFormat SAMPLE_FORMAT = VK_FORMAT_R32G32B32A32_SFLOAT;
// A material that changes with every frame must not fill the memory: a cache that is full starts anew.
constexpr uint64_t MOST_KEPT_VIEW_ENTRIES = 16'000'000; ///< 256 MB
constexpr size_t MOST_ALBEDO_TABLES = 1000;       ///< 1 KB of a round lobe, up to 33 KB of a brushed one
constexpr size_t MOST_VARYING_ALBEDO_TABLES = 50; ///< 16 KB of round lobes

template <typename Map>
void make_room(Map& tables, size_t most) {
    if (tables.size() >= most) tables.clear();
}

} // namespace

const AlbedoTable& TableCache::albedo(const LobeShape& shape) {
    auto found = albedo_.find(shape);
    if (found == albedo_.end()) {
        make_room(albedo_, MOST_ALBEDO_TABLES);
        found = albedo_.emplace(shape, build_albedo_table(shape)).first;
    }
    return found->second;
}

SampleEntries TableCache::mixtures(uint32_t count, Density density) {
    SampleEntries& found = mixtures_[{count, density}];
    if (!found) found = std::make_shared<std::vector<glm::vec4>>(all_matched_mixtures(count, density));
    return found;
}

KeptViewTable TableCache::view_table(const MatchedLobe& lobe) {
    const auto found = view_tables_.find(lobe);
    if (found != view_tables_.end()) return found->second;
    if (view_entries_ + view_table_entries(lobe) > MOST_KEPT_VIEW_ENTRIES) {
        view_tables_.clear();
        view_entries_ = 0;
    }
    view_entries_ += view_table_entries(lobe);
    ViewTable table = build_matched_view_table(lobe);
    KeptViewTable kept{std::make_shared<std::vector<glm::vec4>>(std::move(table.entries)), table.drift};
    return view_tables_.emplace(lobe, std::move(kept)).first->second;
}

std::shared_ptr<const SampleBuffer> TableCache::sample_buffer(const vulkan::DevicePointer& device,
                                                              std::vector<SampleEntries> tables) {
    if (samples_ && samples_->tables == tables) return samples_;
    samples_.reset(); // its memory may be needed for the next
    std::vector<glm::vec4> entries;
    for (const SampleEntries& table : tables)
        entries.insert(entries.end(), table->begin(), table->end());
    auto made = std::make_shared<SampleBuffer>();
    made->tables = std::move(tables);
    if (entries.empty()) entries.emplace_back(0.0f); // a binding must have something behind it
    made->elements = vulkan::ElementBuffer(
        device, entries.size(), SAMPLE_FORMAT,
        vulkan::fitting_access(*device, entries.size(), SAMPLE_FORMAT, "sample tables"));
    vulkan::upload(made->elements.buffer(), std::span<const glm::vec4>(entries));
    return samples_ = std::move(made);
}

const std::vector<glm::vec2>& TableCache::varying_albedo(const LobeShape& shape, bool is_brushed) {
    const std::pair key(shape, is_brushed);
    auto found = varying_albedo_.find(key);
    if (found != varying_albedo_.end()) return found->second;
    make_room(varying_albedo_, MOST_VARYING_ALBEDO_TABLES);
    found =
        varying_albedo_
            .emplace(key, is_brushed ? build_brushed_albedo_table(shape) : build_varying_albedo_table(shape))
            .first;
    return found->second;
}

} // namespace burnish::render
