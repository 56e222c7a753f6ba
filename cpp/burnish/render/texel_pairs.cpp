#include "burnish/render/texel_pairs.h"

#include "burnish/plan/map_lookup.h"
#include "shared/texel_pairs.h"

#include "spirv/lookup_pack_pairs_comp.h"

namespace burnish {

namespace {

constexpr uint32_t TEXEL_BYTES = 8;

} // namespace

TexelPairs::TexelPairs(std::shared_ptr<const vulkan::Device> device)
    : device_(std::move(device)), shader_(device_, "lookup/pack_pairs.comp", lookup_pack_pairs_comp_spv) {}

const TexelPairs::Pipelines& TexelPairs::pipelines(vulkan::ElementAccess access) {
    const auto found = pipelines_.find(access);
    if (found != pipelines_.end()) return found->second;
    vulkan::SpecializationConstants constants;
    constants.set(shared::SPEC_PACK_IS_STORED, access == vulkan::ElementAccess::storage);
    Pipelines made;
    made.inside = vulkan::ComputePipeline(device_, shader_, constants);
    made.border = vulkan::ComputePipeline(device_, shader_, constants.set(shared::SPEC_PACK_BORDER, true));
    return pipelines_.emplace(access, std::move(made)).first->second;
}

vulkan::ElementBuffer TexelPairs::record(vulkan::Commands& commands, vulkan::Image& cubes,
                                         vulkan::ElementAccess access) {
    const vulkan::ImageSettings& settings = cubes.settings();
    const uint64_t cube_pairs = cube_pair_count(settings.width);
    vulkan::ElementBuffer pairs(device_, cube_pairs * (settings.layers / 6), VK_FORMAT_R32G32B32A32_UINT,
                                access);

    std::vector<VkBufferImageCopy> copies;
    uint64_t texels = 0;
    for (uint32_t level = 0; level < settings.levels; ++level) {
        const uint32_t size = settings.width >> level;
        VkBufferImageCopy copy{};
        copy.bufferOffset = texels * TEXEL_BYTES;
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, settings.layers};
        copy.imageExtent = {size, size, 1};
        copies.push_back(copy);
        texels += uint64_t(settings.layers) * size * size;
    }
    texels_ = vulkan::ElementBuffer(device_, texels, VK_FORMAT_R32G32_UINT, access);
    commands.transition(cubes, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(commands.handle(), cubes.handle(), cubes.layout(), texels_.buffer().handle(),
                           uint32_t(copies.size()), copies.data());
    commands.transition(cubes, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.barrier();

    const auto& [inside, border] = pipelines(access);
    set_ = vulkan::DescriptorSet(inside);
    texels_.bind(set_, shared::BINDING_PACK_TEXELS, shared::BINDING_PACK_STORED_TEXELS);
    pairs.bind(set_, shared::BINDING_PACK_PAIRS, shared::BINDING_PACK_STORED_PAIRS);
    const auto dispatch = [&](const vulkan::ComputePipeline& pipeline, bool is_border) {
        uint32_t begin = 0;
        for (const VkBufferImageCopy& copy : copies) {
            const uint32_t size = copy.imageExtent.width;
            const shared::PackRecord push{size, uint32_t(copy.bufferOffset / TEXEL_BYTES), begin,
                                          uint32_t(cube_pairs)};
            const uint32_t items = is_border ? 4 * size + 2 : size + 1, per_group = pipeline.local_size()[0];
            commands.dispatch(pipeline, set_, vulkan::push_bytes(push), (items + per_group - 1) / per_group,
                              is_border ? 1 : size + 2, settings.layers);
            begin += level_pair_count(size);
        }
        commands.barrier();
    };
    dispatch(inside, false);
    dispatch(border, true);
    return pairs;
}

} // namespace burnish
