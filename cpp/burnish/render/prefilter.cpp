#include "burnish/render/prefilter.h"

#include "burnish/render/shade_variant.h"
#include "burnish/sampler/prefilter_table.h"
#include "burnish/vulkan/transfer.h"
#include "shared/constants.h"
#include "shared/prefilter.h"

#include "spirv/pyramid_prefilter_comp.h"

namespace burnish {

namespace {

constexpr uint32_t TEXEL_BYTES = 8;

} // namespace

Prefilter::Prefilter(std::shared_ptr<const vulkan::Device> device)
    : device_(std::move(device)), shader_(device_, "pyramid/prefilter.comp", pyramid_prefilter_comp_spv),
      sampler_(device_, {}) {}

const vulkan::ComputePipeline& Prefilter::pipeline(PrefilterKernel kernel, uint32_t face_size,
                                                   MapLookup lookup) {
    const auto key = std::tuple(kernel, face_size, lookup);
    const auto found = pipelines_.find(key);
    if (found != pipelines_.end()) return found->second;
    auto constants = vulkan::SpecializationConstants{}.set(shared::SPEC_PREFILTER_IS_SPHERICAL,
                                                           kernel == PrefilterKernel::spherical);
    render::add_lookup_constants(constants, {face_size, {}, lookup});
    return pipelines_.emplace(key, vulkan::ComputePipeline(device_, shader_, constants)).first->second;
}

const Prefilter::Scratch& Prefilter::scratch(const Key& key) {
    const auto [face_size, kernel, filter] = key;
    const auto found = scratches_.find(key);
    if (found != scratches_.end()) return found->second;
    Scratch scratch;
    std::vector<glm::vec4> samples;
    uint32_t texels = 0;
    for (uint32_t level = 1; face_size >> level; ++level) {
        const uint32_t size = face_size >> level;
        const SampleTable table = kernel == PrefilterKernel::lobe
                                      ? build_prefilter_table(level, face_size)
                                      : build_spherical_table(size, face_size, filter);
        scratch.levels.push_back({size, texels, static_cast<uint32_t>(samples.size()),
                                  static_cast<uint32_t>(table.entries.size())});
        samples.insert(samples.end(), table.entries.begin(), table.entries.end());
        texels += 6 * size * size;
    }
    scratch.samples = vulkan::make_buffer(device_, std::as_bytes(std::span(samples)),
                                          VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    scratch.samples_view = vulkan::texel_view(scratch.samples, VK_FORMAT_R32G32B32A32_SFLOAT);
    scratch.texels =
        vulkan::Buffer(device_, VkDeviceSize{texels} * TEXEL_BYTES, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    return scratches_.emplace(key, std::move(scratch)).first->second;
}

void Prefilter::record(vulkan::Commands& commands, vulkan::Image& cubes, uint32_t first_cube,
                       uint32_t cube_count, MapLookup lookup, const vulkan::ElementBuffer& pairs,
                       PrefilterKernel kernel, PyramidFilter filter) {
    const vulkan::ImageSettings& settings = cubes.settings();
    last_ = nullptr;
    const vulkan::ComputePipeline& used = pipeline(kernel, settings.width, lookup);
    for (uint32_t cube = first_cube; cube < first_cube + cube_count && settings.levels > 1; ++cube) {
        const Scratch& room = scratch({settings.width, kernel, filter});
        last_ = &room;
        if (cube == first_cube) {
            set_ = vulkan::DescriptorSet(used);
            set_.bind(shared::BINDING_MAPS, cubes.view_as(VK_IMAGE_VIEW_TYPE_CUBE_ARRAY), sampler_)
                .bind_texel_buffer(shared::BINDING_PREFILTER_SAMPLES, room.samples_view)
                .bind(shared::BINDING_PREFILTER_TEXELS, room.texels);
            pairs.bind(set_, shared::BINDING_MAP_PAIRS, shared::BINDING_STORED_PAIRS);
        }
        std::vector<VkBufferImageCopy> copies;
        for (const Level& level : room.levels) {
            const shared::PrefilterRecord push{
                cube, level.size, level.texel_begin, level.sample_begin, level.sample_count, 0, 0, 0};
            const uint32_t per_group = used.local_size()[0];
            commands.dispatch(used, set_, vulkan::push_bytes(push),
                              (level.size * level.size + per_group - 1) / per_group, 1, 6);
            VkBufferImageCopy copy{};
            copy.bufferOffset = VkDeviceSize{level.texel_begin} * TEXEL_BYTES;
            copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, static_cast<uint32_t>(copies.size() + 1),
                                     6 * cube, 6};
            copy.imageExtent = {level.size, level.size, 1};
            copies.push_back(copy);
        }
        commands.transition(cubes, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        vkCmdCopyBufferToImage(commands.handle(), room.texels.handle(), cubes.handle(), cubes.layout(),
                               static_cast<uint32_t>(copies.size()), copies.data());
        commands.transition(cubes,
                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL); // the next cube's room is the same
    }
}

uint64_t Prefilter::scratch_bytes() const {
    uint64_t bytes = 0;
    for (const auto& [key, scratch] : scratches_)
        bytes += scratch.samples.size_bytes() + scratch.texels.size_bytes();
    return scratches_.size() > 1 ? bytes : 0;
}

std::vector<LevelTexels> Prefilter::levels_on_host() const {
    std::vector<LevelTexels> result;
    if (!last_ || !last_->texels.is_host_memory()) return result;
    const uint64_t* texels = last_->texels.mapped<uint64_t>().data();
    for (const Level& level : last_->levels)
        result.push_back(
            {texels + level.texel_begin, level.size, size_t{level.size} * level.size, level.size});
    return result;
}

} // namespace burnish
