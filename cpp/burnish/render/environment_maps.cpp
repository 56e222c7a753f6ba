#include "burnish/render/environment_maps.h"

#include "burnish/error.h"
#include "burnish/render/frame.h"
#include "burnish/render/stopwatch.h"
#include "burnish/render/texel_pairs.h"
#include "burnish/vulkan/transfer.h"

#include <cmath>
#include <utility>

#include <glm/gtc/packing.hpp>

namespace burnish {

namespace {

constexpr VkDeviceSize MOST_SPARE_BYTES = VkDeviceSize{256} << 20;
/// The tools keep this much for maps of several sizes that take turns; one size may need more.
constexpr uint64_t MOST_SCRATCH_BYTES = uint64_t{128} << 20;

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

MapRoom MapTools::take_room(const vulkan::ImageSettings& settings, MapLookup lookup) {
    const uint64_t pairs =
        lookup == MapLookup::sampler ? 1 : cube_pair_count(settings.width) * (settings.layers / 6);
    const auto access =
        lookup == MapLookup::software_stored ? vulkan::ElementAccess::storage : vulkan::ElementAccess::texels;
    std::optional<MapRoom> kept = std::exchange(spare_, {});
    if (kept && kept->image.settings() == settings && kept->pairs.access() == access &&
        kept->pairs.buffer().size_bytes() == pairs * sizeof(glm::uvec4))
        return std::move(*kept);
    kept.reset(); // its memory may be needed
    return {vulkan::Image(device_, settings),
            vulkan::ElementBuffer(device_, pairs, VK_FORMAT_R32G32B32A32_UINT, access)};
}

uint64_t MapRoom::memory_bytes() const {
    uint64_t bytes = pairs.buffer().size_bytes();
    for (uint32_t level = 0; level < image.settings().levels; ++level)
        bytes += image.level_bytes(level) * image.settings().layers;
    return bytes;
}

void MapTools::keep_room(MapRoom room) {
    if (room.memory_bytes() <= MOST_SPARE_BYTES) spare_ = std::move(room);
}

void MapTools::free_surplus() {
    if (pyramid_.scratch_bytes() > MOST_SCRATCH_BYTES) pyramid_.free_scratches();
    if (prefilter_ && prefilter_->scratch_bytes() > MOST_SCRATCH_BYTES) prefilter_->free_scratches();
}

void MapTools::free() {
    spare_.reset();
    pyramid_.free_scratches();
    prefilter_.reset();
}

EnvironmentMaps::EnvironmentMaps(MapTools& tools, EnvironmentSpan environments, const MapSettings& wanted)
    : settings_(wanted) {
    const uint32_t face_size = common_face_size(environments, tools.device()->limits().maxImageArrayLayers);
    if (wanted.kernel && !wanted.filter)
        throw std::invalid_argument("filter: expected one, from whose pyramid to prefilter, got none");
    tools.free_surplus();
    vulkan::ImageSettings settings;
    settings.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    settings.width = settings.height = face_size;
    settings.levels = wanted.filter ? vulkan::full_levels(face_size, face_size) : 1;
    settings.layers = 6 * uint32_t(environments.size());
    settings.is_cube = true;
    room_ = tools.take_room(settings, wanted.lookup);
    half_exponents_.resize(environments.size());
    make(tools, 0, environments);
}

void EnvironmentMaps::replace(
    MapTools& tools, std::span<const std::pair<uint32_t, std::shared_ptr<const Environment>>> changed) {
    std::vector<vulkan::PassTime> times;
    for (const auto& [cube, environment] : changed) {
        make(tools, cube, std::span(&environment, 1));
        render::add_pass_times(times, pass_times_);
    }
    pass_times_ = std::move(times);
}

void EnvironmentMaps::grow(MapTools& tools, uint32_t cube_count) {
    const render::Stopwatch watch;
    vulkan::ImageSettings settings = room_.image.settings();
    const uint32_t old_layers = settings.layers;
    settings.layers = 6 * cube_count;
    MapRoom room = tools.take_room(settings, settings_.lookup);
    vulkan::Commands commands(tools.device());
    commands.transition(room_.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    commands.transition(room.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    std::vector<VkImageCopy> copies(settings.levels);
    for (uint32_t level = 0; level < settings.levels; ++level) {
        copies[level].srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, old_layers};
        copies[level].dstSubresource = copies[level].srcSubresource;
        copies[level].extent = {room.image.level_width(level), room.image.level_height(level), 1};
    }
    vkCmdCopyImage(commands.handle(), room_.image.handle(), room_.image.layout(), room.image.handle(),
                   room.image.layout(), settings.levels, copies.data());
    commands.transition(room.image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    if (settings_.lookup != MapLookup::sampler)
        commands.copy_buffer(room_.pairs.buffer(), room.pairs.buffer(), room_.pairs.buffer().size_bytes());
    commands.submit();
    room_ = std::move(room);
    half_exponents_.resize(cube_count);
    pass_times_ = {{"upload", watch.milliseconds()}};
}

void EnvironmentMaps::make(MapTools& tools, uint32_t first_cube, EnvironmentSpan environments) {
    const std::shared_ptr<const vulkan::Device>& device = tools.device();
    const auto cube_count = static_cast<uint32_t>(environments.size());
    for (uint32_t k = 0; k < cube_count; ++k)
        half_exponents_[first_cube + k] = environments[k]->half_range().exponent;
    vulkan::Image& image = room_.image;

    const render::Stopwatch upload_watch;
    const bool is_staged =
        settings_.filter && tools.pyramid().stage(image, first_cube, environments, *settings_.filter);
    for (uint32_t k = 0; k < cube_count && !is_staged; ++k) {
        vulkan::ImageRegion faces;
        faces.base_layer = 6 * (first_cube + k);
        faces.layer_count = 6;
        vulkan::upload(image, faces, std::as_bytes(std::span<const uint16_t>(environments[k]->half_rgba())));
    }
    pass_times_ = {{"upload", upload_watch.milliseconds()}};

    const bool is_packed = settings_.lookup != MapLookup::sampler;
    // From where they were made, or else from the image.
    const auto pack = [&](const std::vector<LevelTexels>& levels, uint32_t first_level) {
        if (!is_packed) return;
        const render::Stopwatch watch;
        if (levels.empty())
            pack_pairs(image, first_level, first_cube, cube_count, room_.pairs);
        else
            pack_pairs(levels, face_size(), first_cube, cube_count, room_.pairs);
        pass_times_.push_back({pass_name(PassKind::pack), watch.milliseconds()});
    };
    const auto submit = [&](vulkan::Commands& commands) {
        commands.submit();
        pass_times_.insert(pass_times_.end(), commands.pass_times().begin(), commands.pass_times().end());
    };
    vulkan::Commands commands(device);
    if (settings_.filter) {
        commands.begin_pass(pass_name(PassKind::pyramid));
        tools.pyramid().record(commands, image, first_cube, cube_count, *settings_.filter,
                               is_staged ? Pyramid::Finest::staged : Pyramid::Finest::in_image);
        commands.end_pass();
    } else {
        commands.transition(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    submit(commands);
    pack(settings_.filter ? tools.pyramid().levels_on_host() : std::vector<LevelTexels>(), 0);
    if (!settings_.kernel) return;

    vulkan::Commands after(device);
    after.begin_pass(pass_name(PassKind::prefilter));
    tools.prefilter().record(after, image, first_cube, cube_count, settings_.lookup, room_.pairs,
                             *settings_.kernel, *settings_.filter);
    after.end_pass();
    submit(after);
    // Level 0 is not filtered; the tool has room for one cube.
    pack(cube_count == 1 ? tools.prefilter().levels_on_host() : std::vector<LevelTexels>(), 1);
}

std::vector<std::vector<float>> EnvironmentMaps::read_levels(uint32_t cube) {
    if (cube >= count()) {
        throw std::invalid_argument(message("cube: expected 0..", count() - 1, ", got ", cube));
    }
    const double unit = std::ldexp(1.0, half_exponents_[cube]);
    std::vector<std::vector<float>> levels;
    for (uint32_t level = 0; level < level_count(); ++level) {
        vulkan::ImageRegion faces;
        faces.level = level;
        faces.base_layer = 6 * cube;
        faces.layer_count = 6;
        const size_t texel_count =
            size_t{6} * room_.image.level_width(level) * room_.image.level_width(level);
        std::vector<glm::u16vec4> texels(texel_count);
        vulkan::read_back(room_.image, faces, std::as_writable_bytes(std::span(texels)));
        std::vector<float> radiance;
        radiance.reserve(3 * texel_count);
        for (const glm::u16vec4& texel : texels) {
            for (int channel = 0; channel < 3; ++channel)
                radiance.push_back(float(unit * glm::unpackHalf1x16(texel[channel])));
        }
        levels.push_back(std::move(radiance));
    }
    return levels;
}

} // namespace burnish
