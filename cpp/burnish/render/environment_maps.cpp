#include "burnish/render/environment_maps.h"

#include "burnish/error.h"
#include "burnish/render/stopwatch.h"
#include "burnish/render/texel_pairs.h"
#include "burnish/vulkan/transfer.h"

#include <glm/gtc/packing.hpp>

namespace burnish {

namespace {

using EnvironmentSpan = std::span<const std::shared_ptr<const Environment>>;

uint32_t common_face_size(EnvironmentSpan environments, uint32_t most_layers) {
    if (environments.empty() || environments.size() > most_layers / 6) {
        throw std::invalid_argument(message("environments: expected 1..", most_layers / 6,
                                            " (an image of the device has ", most_layers, " layers), got ",
                                            environments.size()));
    }
    for (const auto& environment : environments) {
        if (!environment)
            throw std::invalid_argument("environments: expected environments, got none at some place");
        if (environment->face_size() != environments.front()->face_size()) {
            throw std::invalid_argument(message("environments: expected one face size, got ",
                                                environments.front()->face_size(), " and ",
                                                environment->face_size()));
        }
    }
    return environments.front()->face_size();
}

} // namespace

Prefilter& MapTools::prefilter() {
    if (!prefilter_) prefilter_ = std::make_unique<Prefilter>(device_);
    return *prefilter_;
}

void MapTools::free() {
    pyramid_.free_scratches();
    prefilter_.reset();
}

EnvironmentMaps::EnvironmentMaps(MapTools& tools, EnvironmentSpan environments, const MapSettings& wanted) {
    const std::shared_ptr<const vulkan::Device>& device = tools.device();
    const uint32_t face_size = common_face_size(environments, device->limits().maxImageArrayLayers);
    if (wanted.kernel && !wanted.filter)
        throw std::invalid_argument("filter: expected one, from whose pyramid to prefilter, got none");
    const auto cube_count = static_cast<uint32_t>(environments.size());
    vulkan::ImageSettings settings;
    settings.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    settings.width = settings.height = face_size;
    settings.levels = wanted.filter ? vulkan::full_levels(face_size, face_size) : 1;
    settings.layers = 6 * cube_count;
    settings.is_cube = true;
    image_ = vulkan::Image(device, settings);

    const render::Stopwatch upload_watch;
    std::vector<std::vector<uint16_t>> texels;
    for (const auto& environment : environments)
        texels.push_back(environment->half_rgba());
    const bool is_staged = wanted.filter && tools.pyramid().stage(image_, texels, *wanted.filter);
    for (uint32_t cube = 0; cube < cube_count && !is_staged; ++cube) {
        vulkan::ImageRegion faces;
        faces.base_layer = 6 * cube;
        faces.layer_count = 6;
        vulkan::upload(image_, faces, std::as_bytes(std::span(texels[cube])));
    }
    pass_times_ = {{"upload", upload_watch.milliseconds()}};

    const bool is_packed = wanted.lookup != MapLookup::sampler;
    const auto access = wanted.lookup == MapLookup::software_stored ? vulkan::ElementAccess::storage
                                                                    : vulkan::ElementAccess::texels;
    pairs_ = is_packed ? make_pair_buffer(device, face_size, cube_count, access)
                       : vulkan::ElementBuffer(device, 1, VK_FORMAT_R32G32B32A32_UINT, access);
    // From where they were made, or else from the image.
    const auto pack = [&](const std::vector<LevelTexels>& levels, uint32_t first_level) {
        if (!is_packed) return;
        const render::Stopwatch watch;
        if (levels.empty())
            pack_pairs(image_, first_level, pairs_);
        else
            pack_pairs(levels, face_size, cube_count, pairs_);
        pass_times_.push_back({"pack", watch.milliseconds()});
    };
    const auto submit = [&](vulkan::Commands& commands) {
        commands.submit();
        pass_times_.insert(pass_times_.end(), commands.pass_times().begin(), commands.pass_times().end());
    };
    vulkan::Commands commands(device);
    if (wanted.filter) {
        commands.begin_pass("pyramid");
        tools.pyramid().record(commands, image_, 0, cube_count, *wanted.filter,
                               is_staged ? Pyramid::Finest::staged : Pyramid::Finest::in_image);
        commands.end_pass();
    } else {
        commands.transition(image_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    submit(commands);
    pack(wanted.filter ? tools.pyramid().levels_on_host() : std::vector<LevelTexels>(), 0);
    if (!wanted.kernel) return;

    vulkan::Commands after(device);
    after.begin_pass("prefilter");
    tools.prefilter().record(after, image_, wanted.lookup, pairs_, *wanted.kernel, *wanted.filter);
    after.end_pass();
    submit(after);
    // Level 0 is not filtered; the tool has room for one cube.
    pack(cube_count == 1 ? tools.prefilter().levels_on_host() : std::vector<LevelTexels>(), 1);
}

std::vector<std::vector<float>> EnvironmentMaps::read_levels(uint32_t cube) {
    if (cube >= count()) {
        throw std::invalid_argument(message("cube: expected 0..", count() - 1, ", got ", cube));
    }
    std::vector<std::vector<float>> levels;
    for (uint32_t level = 0; level < level_count(); ++level) {
        vulkan::ImageRegion faces;
        faces.level = level;
        faces.base_layer = 6 * cube;
        faces.layer_count = 6;
        const size_t texel_count = size_t{6} * image_.level_width(level) * image_.level_width(level);
        std::vector<glm::u16vec4> texels(texel_count);
        vulkan::read_back(image_, faces, std::as_writable_bytes(std::span(texels)));
        std::vector<float> radiance;
        radiance.reserve(3 * texel_count);
        for (const glm::u16vec4& texel : texels) {
            for (int channel = 0; channel < 3; ++channel)
                radiance.push_back(glm::unpackHalf1x16(texel[channel]));
        }
        levels.push_back(std::move(radiance));
    }
    return levels;
}

} // namespace burnish
