// The part of Renderer that measures what an engine of the device's own functions would take.
#include <span>

#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"

namespace burnish::render {

std::vector<double> Renderer::time_lookups(const std::shared_ptr<const Environment>& environment,
                                           const Regular& sampler, float roughness, uint32_t repeats) {
    const auto lock = enter();
    constexpr uint32_t width = 1920, height = 1080;
    const SampleTable table =
        burnish::build_sample_table(sampler, glm::vec2(roughness), environment->face_size());
    const MapLookup lookup = lookup_.of(environment->face_size(), 1);
    EnvironmentMaps maps(map_tools_, std::span(&environment, 1), {PyramidFilter::gauss6, {}, lookup});
    const vulkan::Buffer radiance(device_, width * height * sizeof(glm::vec4),
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    const vulkan::Sampler cube_sampler(device_, {});
    vulkan::SpecializationConstants constants;
    add_lookup_constants(constants, {environment->face_size(), {}, lookup});
    constants.set(shared::SPEC_SAMPLE_COUNT, uint32_t(table.entries.size()));
    for (uint32_t k = 0; k < table.entries.size(); ++k)
        for (uint32_t c = 0; c < 4; ++c)
            constants.set(shared::SPEC_SAMPLES + 4 * k + c, table.entries[k][int(c)]);
    const vulkan::ComputePipeline& pipeline = pipelines_.compute("shade/lookups_alone.comp", constants);
    vulkan::DescriptorSet set(pipeline);
    set.bind(shared::BINDING_MAPS, maps.image().view_as(VK_IMAGE_VIEW_TYPE_CUBE_ARRAY), cube_sampler)
        .bind(shared::BINDING_RADIANCE, radiance);
    maps.pairs().bind(set, shared::BINDING_MAP_PAIRS, shared::BINDING_STORED_PAIRS);
    shared::ShadeRecord push{};
    push.point_count = width;
    std::vector<double> times;
    for (uint32_t k = 0; k < repeats; ++k) {
        vulkan::Commands commands(device_);
        commands.begin_pass("lookups");
        commands.dispatch(pipeline, set, vulkan::push_bytes(push), width / shared::TILE_SIZE,
                          height / shared::TILE_SIZE);
        commands.end_pass();
        commands.submit();
        times.push_back(commands.pass_times()[0].milliseconds);
    }
    return times;
}

double Renderer::time_blits(const std::shared_ptr<const Environment>& environment) {
    const auto lock = enter();
    vulkan::ImageSettings settings;
    settings.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    settings.width = settings.height = environment->face_size();
    settings.levels = vulkan::full_levels(settings.width, settings.height);
    settings.layers = 6;
    settings.is_cube = true;
    vulkan::Image image(device_, settings);
    vulkan::ImageRegion finest;
    finest.layer_count = 6;
    const std::vector<uint16_t> texels = environment->half_rgba();
    vulkan::upload(image, finest, std::as_bytes(std::span(texels)), VK_IMAGE_LAYOUT_GENERAL);
    vulkan::Commands commands(device_);
    commands.begin_pass("blits");
    commands.blit_levels(image);
    commands.end_pass();
    commands.submit();
    return commands.pass_times()[0].milliseconds;
}

} // namespace burnish::render
