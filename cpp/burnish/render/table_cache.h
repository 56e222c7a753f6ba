// Tables that take long enough to make, or to bring to the device, to be worth keeping from frame to frame.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "burnish/lobe/albedo_table.h"
#include "burnish/sampler/matched_view_table.h"
#include "burnish/vulkan/element_buffer.h"

namespace burnish::render {

using SampleEntries = std::shared_ptr<const std::vector<glm::vec4>>;

/// Sample tables as kernels read them.
struct SampleBuffer {
    std::vector<SampleEntries> tables;
    vulkan::ElementBuffer elements;
};

struct KeptViewTable {
    SampleEntries entries;
    uint32_t drift; ///< see ViewTable
};

class TableCache {
public:
    /// Until the next table of the kind is asked for, as references below.
    const AlbedoTable& albedo(const LobeShape& shape);
    /// Of all round lobes, or of all brushed ones.
    const std::vector<glm::vec2>& varying_albedo(const LobeShape& shape, bool is_brushed);
    SampleEntries mixtures(uint32_t count, Density density);
    KeptViewTable view_table(const MatchedLobe& lobe);
    /// The tables one after the other, on the device: the last ones again if they are the same.
    std::shared_ptr<const SampleBuffer> sample_buffer(const vulkan::DevicePointer& device,
                                                      std::vector<SampleEntries> tables);
    /// Gives back what lies on the device.
    void forget_buffers() { samples_.reset(); }

private:
    std::map<LobeShape, AlbedoTable> albedo_;
    std::map<std::pair<LobeShape, bool>, std::vector<glm::vec2>> varying_albedo_;
    std::map<std::pair<uint32_t, Density>, SampleEntries> mixtures_;
    std::map<MatchedLobe, KeptViewTable> view_tables_;
    uint64_t view_entries_ = 0; ///< of all view_tables_
    std::shared_ptr<const SampleBuffer> samples_;
};

} // namespace burnish::render
