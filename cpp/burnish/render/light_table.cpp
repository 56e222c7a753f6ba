#include "burnish/render/light_table.h"

#include "burnish/vulkan/transfer.h"

namespace burnish::render {

LightTable make_light_table(const vulkan::DevicePointer& device, const Plan& plan, const glm::dvec3& origin) {
    std::vector<shared::LightRecord> records;
    for (const DirectLight& light : plan.lights)
        records.push_back(record(light, origin));
    LightTable table;
    table.count = uint32_t(records.size());
    if (records.empty()) records.emplace_back(); // a binding must have something behind it
    table.lights = vulkan::make_buffer(device, std::as_bytes(std::span(records)),
                                       VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    table.rows = vulkan::texel_view(table.lights, VK_FORMAT_R32G32B32A32_UINT);
    return table;
}

} // namespace burnish::render
