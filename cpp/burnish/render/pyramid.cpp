#include "burnish/render/pyramid.h"

#include "burnish/cores.h"
#include "burnish/error.h"
#include "shared/pyramid.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "spirv/pyramid_border_comp.h"
#include "spirv/pyramid_reduce_comp.h"

namespace burnish {

namespace {

constexpr uint64_t SCRATCH_PAIRS = (uint64_t{64} << 20) / 16; // cubes are done together up to this size
constexpr uint32_t PAIR_BYTES = 16;
constexpr uint32_t TEXEL_BYTES = 8;
constexpr VkFormat PAIR_FORMAT = VK_FORMAT_R32G32B32A32_UINT;
// Invocations beyond a level's edge load texels behind their face, though they store nothing: room behind the
// last one.
constexpr uint64_t SLACK_PAIRS = 64;

uint32_t row_pairs(uint32_t size) {
    return (size + 2 * shared::PYRAMID_BORDER + 1) / 2;
}
uint32_t face_rows(uint32_t size) {
    return size + 2 * shared::PYRAMID_BORDER;
}
uint64_t face_pairs(uint32_t size) {
    return uint64_t{row_pairs(size)} * face_rows(size);
}

uint64_t scratch_pairs(uint32_t face_size, uint32_t cube_count) {
    uint64_t pairs = SLACK_PAIRS;
    for (uint32_t size = face_size; size >= 1; size /= 2)
        pairs += 6 * cube_count * face_pairs(size);
    return pairs;
}

uint32_t groups(uint32_t items, uint32_t per_group) {
    return (items + per_group - 1) / per_group;
}

/// Level `level` of `cube_count` cubes in the image, and without their borders in the buffer.
VkBufferImageCopy level_copy(uint32_t level, uint32_t size, uint64_t begin_pairs, uint32_t first_cube,
                             uint32_t cube_count) {
    const uint32_t border = shared::PYRAMID_BORDER;
    VkBufferImageCopy copy{};
    copy.bufferOffset =
        begin_pairs * PAIR_BYTES + uint64_t{border} * (row_pairs(size) * PAIR_BYTES + TEXEL_BYTES);
    copy.bufferRowLength = 2 * row_pairs(size);
    copy.bufferImageHeight = face_rows(size);
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 6 * first_cube, 6 * cube_count};
    copy.imageExtent = {size, size, 1};
    return copy;
}

void require_cubes(const vulkan::Image& cubes, uint32_t first_cube, uint32_t cube_count) {
    const vulkan::ImageSettings& settings = cubes.settings();
    if (settings.format != VK_FORMAT_R16G16B16A16_SFLOAT || !settings.is_cube ||
        !std::has_single_bit(settings.width) ||
        settings.levels != vulkan::full_levels(settings.width, settings.height)) {
        throw std::invalid_argument(
            message("cubes: expected a cube array of RGBA16F, a power of two wide, with all levels, got ",
                    settings.is_cube ? "cubes" : "no cubes", " of ", vulkan::format_name(settings.format),
                    ", ", settings.width, " x ", settings.height, ", ", settings.levels, " levels"));
    }
    if (cube_count == 0 || uint64_t{first_cube} + cube_count > settings.layers / 6) {
        throw std::invalid_argument(message("cube_count: expected 1 or more of the image's ",
                                            settings.layers / 6, " cubes, got ", cube_count, " from cube ",
                                            first_cube));
    }
}

} // namespace

Pyramid::Pyramid(std::shared_ptr<const vulkan::Device> device)
    : device_(std::move(device)), reduce_shader_(device_, "pyramid/reduce.comp", pyramid_reduce_comp_spv),
      border_shader_(device_, "pyramid/border.comp", pyramid_border_comp_spv) {}

// Long rows are read as streams; of small levels a large group would be mostly idle.
Pyramid::Group Pyramid::best_group(uint32_t size) {
    return size >= 64 ? Group{32, 1} : Group{8, 2};
}

const vulkan::ComputePipeline& Pyramid::border(vulkan::ElementAccess access) {
    const auto found = borders_.find(access);
    if (found != borders_.end()) return found->second;
    const auto constants = vulkan::SpecializationConstants{}.set(shared::SPEC_PYRAMID_IS_STORED,
                                                                 access == vulkan::ElementAccess::storage);
    return borders_.emplace(access, vulkan::ComputePipeline(device_, border_shader_, constants))
        .first->second;
}

const vulkan::ComputePipeline& Pyramid::reduction(PyramidFilter filter, const Group& group,
                                                  vulkan::ElementAccess access) {
    const auto key = std::tuple(filter, group, access);
    const auto found = reductions_.find(key);
    if (found != reductions_.end()) return found->second;
    const auto constants = vulkan::SpecializationConstants{}
                               .set(shared::SPEC_PYRAMID_TAPS, row_of(filter).taps)
                               .set(shared::SPEC_PYRAMID_LOCAL_X, group.x)
                               .set(shared::SPEC_PYRAMID_LOCAL_Y, group.y)
                               .set(shared::SPEC_PYRAMID_IS_STORED, access == vulkan::ElementAccess::storage);
    return reductions_.emplace(key, vulkan::ComputePipeline(device_, reduce_shader_, constants))
        .first->second;
}

const Pyramid::Scratch& Pyramid::scratch(uint32_t face_size, uint32_t cube_count, PyramidFilter filter) {
    const auto key = std::pair(face_size, cube_count);
    const auto found = scratches_.find(key);
    if (found != scratches_.end()) return found->second;

    const uint64_t pairs = scratch_pairs(face_size, cube_count);
    const vulkan::ElementAccess access =
        vulkan::fitting_access(*device_, pairs, PAIR_FORMAT, message("pyramid of faces of ", face_size));
    Scratch scratch;
    uint64_t begin = 0;
    for (uint32_t size = face_size; size >= 1; size /= 2) {
        scratch.levels.push_back({size, static_cast<uint32_t>(begin)});
        begin += 6 * cube_count * face_pairs(size);
    }
    scratch.pairs = vulkan::ElementBuffer(device_, pairs, PAIR_FORMAT, access);
    scratch.border_set = vulkan::DescriptorSet(border(access));
    // The set fits the other filters' pipelines too: they have the same interface.
    scratch.reduce_set = vulkan::DescriptorSet(reduction(filter, best_group(face_size / 2), access));
    for (vulkan::DescriptorSet* set : {&scratch.border_set, &scratch.reduce_set})
        scratch.pairs.bind(*set, shared::BINDING_PYRAMID_TEXELS, shared::BINDING_PYRAMID_STORED_TEXELS);
    return scratches_.emplace(key, std::move(scratch)).first->second;
}

void Pyramid::record_levels(vulkan::Commands& commands, const Scratch& scratch, uint32_t cube_count,
                            PyramidFilter filter) {
    const vulkan::ComputePipeline& border = this->border(scratch.pairs.access());
    for (size_t level = 1; level < scratch.levels.size(); ++level) {
        const Level source = scratch.levels[level - 1], target = scratch.levels[level];
        const shared::PyramidRecord push{
            source.begin, row_pairs(source.size), source.size, target.begin, row_pairs(target.size), 0, 0, 0};
        if (filter != PyramidFilter::box) {
            commands.dispatch(border, scratch.border_set, vulkan::push_bytes(push),
                              groups(4 * source.size + 8, border.local_size()[0]), 1, 6 * cube_count);
            commands.barrier();
        }
        const Group group = best_group(target.size);
        commands.dispatch(reduction(filter, group, scratch.pairs.access()), scratch.reduce_set,
                          vulkan::push_bytes(push), groups(target.size, shared::PYRAMID_BLOCK_X * group.x),
                          groups(target.size, shared::PYRAMID_BLOCK_Y * group.y), 6 * cube_count);
        commands.barrier();
    }
}

// Powers of two, so that few sizes of scratch arise.
uint32_t Pyramid::batch_size(uint32_t face_size, uint32_t cube_count) const {
    const uint64_t most_pairs = std::min<uint64_t>(SCRATCH_PAIRS, device_->limits().maxTexelBufferElements);
    uint32_t batch = std::bit_floor(cube_count);
    while (batch > 1 && scratch_pairs(face_size, batch) > most_pairs)
        batch /= 2;
    return batch;
}

bool Pyramid::stage(vulkan::Image& cubes, uint32_t first_cube,
                    std::span<const std::shared_ptr<const Environment>> environments, PyramidFilter filter) {
    const auto cube_count = static_cast<uint32_t>(environments.size());
    require_cubes(cubes, first_cube, cube_count);
    const uint32_t size = cubes.settings().width;
    if (size == 1 || batch_size(size, cube_count) != cube_count) return false;
    const Scratch& room = scratch(size, cube_count, filter);
    if (!room.pairs.buffer().is_mapped()) return false;

    const VkBufferImageCopy finest = level_copy(0, size, 0, first_cube, cube_count);
    const auto half = room.pairs.buffer().mapped<uint16_t>();
    for_each_on_cores(size_t{6} * cube_count * size, size >= LEAST_THREADED_SIZE, [&](size_t row) {
        const uint64_t pair = row / size * face_pairs(size) + row % size * row_pairs(size);
        environments[row / (6 * size)]->half_rgba(
            uint32_t(row % (6 * size)),
            half.subspan((finest.bufferOffset + pair * PAIR_BYTES) / sizeof(uint16_t), 4 * size));
    });
    vulkan::Commands commands(device_);
    commands.transition(cubes, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(commands.handle(), room.pairs.buffer().handle(), cubes.handle(), cubes.layout(), 1,
                           &finest);
    commands.submit();
    return true;
}

void Pyramid::record(vulkan::Commands& commands, vulkan::Image& cubes, uint32_t first_cube,
                     uint32_t cube_count, PyramidFilter filter, Finest finest) {
    require_cubes(cubes, first_cube, cube_count);
    if (cubes.layout() == VK_IMAGE_LAYOUT_UNDEFINED) {
        throw std::invalid_argument(
            "cubes: expected an image with level 0 written, got one in layout UNDEFINED");
    }
    const uint32_t face_size = cubes.settings().width;
    const bool is_general = cubes.layout() == VK_IMAGE_LAYOUT_GENERAL;
    const auto move_to = [&](VkImageLayout layout) {
        commands.transition(cubes, is_general ? VK_IMAGE_LAYOUT_GENERAL : layout);
    };
    uint32_t batch = batch_size(face_size, cube_count);
    last_ = nullptr;
    for (uint32_t done = 0; done < cube_count && face_size > 1; done += batch) {
        while (batch > cube_count - done)
            batch /= 2;
        const Scratch& room = scratch(face_size, batch, filter);
        if (finest == Finest::in_image) {
            move_to(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
            const VkBufferImageCopy copy = level_copy(0, face_size, 0, first_cube + done, batch);
            vkCmdCopyImageToBuffer(commands.handle(), cubes.handle(), cubes.layout(),
                                   room.pairs.buffer().handle(), 1, &copy);
            commands.barrier();
        }
        record_levels(commands, room, batch, filter);
        if (batch == cube_count) last_ = &room;

        move_to(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        std::vector<VkBufferImageCopy> copies;
        for (uint32_t level = 1; level < room.levels.size(); ++level) {
            copies.push_back(level_copy(level, room.levels[level].size, room.levels[level].begin,
                                        first_cube + done, batch));
        }
        vkCmdCopyBufferToImage(commands.handle(), room.pairs.buffer().handle(), cubes.handle(),
                               cubes.layout(), static_cast<uint32_t>(copies.size()), copies.data());
    }
    move_to(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

uint64_t Pyramid::scratch_bytes() const {
    uint64_t bytes = 0;
    for (const auto& [key, scratch] : scratches_)
        bytes += scratch.pairs.buffer().size_bytes();
    return scratches_.size() > 1 ? bytes : 0;
}

std::vector<LevelTexels> Pyramid::levels_on_host() const {
    std::vector<LevelTexels> result;
    if (!last_ || !last_->pairs.buffer().is_host_memory()) return result;
    const uint64_t* texels = last_->pairs.buffer().mapped<uint64_t>().data();
    for (const Level& level : last_->levels) {
        const size_t pitch = 2 * size_t{row_pairs(level.size)}, border = shared::PYRAMID_BORDER;
        result.push_back({texels + 2 * size_t{level.begin} + border * (pitch + 1), pitch,
                          pitch * face_rows(level.size), level.size});
    }
    return result;
}

} // namespace burnish
