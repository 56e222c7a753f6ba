#include "burnish/render/environment_maps.h"

#include "burnish/error.h"
#include "burnish/vulkan/transfer.h"

#include <chrono>

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

TexelPairs& MapTools::texel_pairs() {
    if (!texel_pairs_) texel_pairs_ = std::make_unique<TexelPairs>(device_);
    return *texel_pairs_;
}

void MapTools::free() {
    pyramid_.free_scratches();
    prefilter_.reset();
    texel_pairs_.reset();
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

    const auto start = std::chrono::steady_clock::now();
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
    const std::chrono::duration<double, std::milli> upload_time = std::chrono::steady_clock::now() - start;
    pass_times_ = {{"upload", upload_time.count()}};

    const bool is_packed = wanted.lookup != MapLookup::sampler;
    const auto access = wanted.lookup == MapLookup::software_stored ? vulkan::ElementAccess::storage
                                                                    : vulkan::ElementAccess::texels;
    if (!is_packed) pairs_ = vulkan::ElementBuffer(device, 1, VK_FORMAT_R32G32B32A32_UINT, access);
    const auto pack = [&](vulkan::Commands& commands) {
        if (!is_packed) return;
        commands.begin_pass("pack");
        pairs_ = tools.texel_pairs().record(commands, image_, access);
        commands.end_pass();
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
    pack(commands);
    vulkan::Image prefiltered;
    if (wanted.kernel) {
        prefiltered = vulkan::Image(device, settings);
        commands.begin_pass("prefilter");
        tools.prefilter().record(commands, image_, wanted.lookup, pairs_, prefiltered, *wanted.kernel,
                                 *wanted.filter);
        commands.end_pass();
    }
    submit(commands);
    if (!wanted.kernel) return;

    image_ = std::move(prefiltered);
    vulkan::Commands after(device);
    pack(after);
    submit(after);
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
