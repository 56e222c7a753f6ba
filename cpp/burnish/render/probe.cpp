#include "burnish/render/probe.h"

#include <map>
#include <stdexcept>

#include "burnish/error.h"
#include "burnish/vulkan/transfer.h"
#include "shared/probe.h"
#include "spirv/probe_cube_map_comp.h"
#include "spirv/probe_display_comp.h"
#include "spirv/probe_footprint_comp.h"
#include "spirv/probe_frame_comp.h"
#include "spirv/probe_ggx_lobe_comp.h"
#include "spirv/probe_kurt_lobe_comp.h"
#include "spirv/probe_lafortune_lobe_comp.h"
#include "spirv/probe_metallic_roughness_comp.h"
#include "spirv/probe_random_comp.h"
#include "spirv/probe_sheen_lobe_comp.h"
#include "spirv/probe_spherical_harmonics_comp.h"

namespace burnish::render {
namespace {

struct Push {
    uint32_t item_count, argument_count;
};

std::span<const uint32_t> find_spirv(const std::string& library) {
    static const std::map<std::string, std::span<const uint32_t>> words = {
        {"cube_map", probe_cube_map_comp_spv},
        {"footprint", probe_footprint_comp_spv},
        {"frame", probe_frame_comp_spv},
        {"ggx_lobe", probe_ggx_lobe_comp_spv},
        {"lafortune_lobe", probe_lafortune_lobe_comp_spv},
        {"sheen_lobe", probe_sheen_lobe_comp_spv},
        {"kurt_lobe", probe_kurt_lobe_comp_spv},
        {"metallic_roughness", probe_metallic_roughness_comp_spv},
        {"display", probe_display_comp_spv},
        {"random", probe_random_comp_spv},
        {"spherical_harmonics", probe_spherical_harmonics_comp_spv},
    };
    const auto found = words.find(library);
    if (found != words.end()) return found->second;
    std::string names;
    for (const auto& [name, spirv] : words)
        names += (names.empty() ? "" : ", ") + name;
    throw std::invalid_argument(message("library: expected one of ", names, ", got ", library));
}

} // namespace

std::vector<float> run_probe(const std::shared_ptr<vulkan::Device>& device, const std::string& library,
                             uint32_t function, std::span<const float> arguments, uint32_t argument_count) {
    if (argument_count < 1 || argument_count > shared::PROBE_ARGUMENTS)
        throw std::invalid_argument(message("arguments: expected 1..", shared::PROBE_ARGUMENTS,
                                            " vec4 an item, got ", argument_count));
    const uint64_t items = arguments.size() / (4 * argument_count);
    const uint64_t most = uint64_t{device->limits().maxComputeWorkGroupCount[0]} * shared::PROBE_GROUP;
    if (items < 1 || items > most)
        throw std::invalid_argument(message("arguments: expected 1..", most, " items, got ", items));

    const vulkan::Shader shader(device, "probe/" + library + ".comp", find_spirv(library));
    const vulkan::ComputePipeline pipeline(
        device, shader, vulkan::SpecializationConstants().set(shared::SPEC_PROBE_FUNCTION, function));
    const vulkan::Buffer input =
        vulkan::make_buffer(device, std::as_bytes(arguments), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    std::vector<float> results(items * shared::PROBE_RESULTS * 4);
    const vulkan::Buffer output(device, results.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    vulkan::DescriptorSet set(pipeline);
    set.bind(shared::BINDING_PROBE_ARGUMENTS, input).bind(shared::BINDING_PROBE_RESULTS, output);

    vulkan::Commands commands(device);
    commands.fill_buffer(output, 0);
    commands.barrier();
    const uint64_t groups = (items + shared::PROBE_GROUP - 1) / shared::PROBE_GROUP;
    commands.dispatch(pipeline, set, vulkan::push_bytes(Push{uint32_t(items), argument_count}),
                      uint32_t(groups));
    commands.submit();
    vulkan::read_back(output, std::as_writable_bytes(std::span(results)));
    return results;
}

} // namespace burnish::render
