#include "burnish/render/texel_pairs.h"

#include "burnish/plan/map_lookup.h"
#include "shared/texel_pairs.h"

#include "spirv/lookup_pack_pairs_comp.h"

namespace burnish {

namespace {

constexpr uint32_t PAIR_BYTES = 16, TEXEL_BYTES = 8;

} // namespace

TexelPairs::TexelPairs(std::shared_ptr<const vulkan::Device> device) : device_(std::move(device)) {
    const vulkan::Shader shader(device_, "lookup/pack_pairs.comp", lookup_pack_pairs_comp_spv);
    inside_ = vulkan::ComputePipeline(device_, shader);
    border_ = vulkan::ComputePipeline(device_, shader,
                                      vulkan::SpecializationConstants{}.set(shared::SPEC_PACK_BORDER, true));
}

PairBuffer TexelPairs::record(vulkan::Commands& commands, vulkan::Image& cubes) {
    const vulkan::ImageSettings& settings = cubes.settings();
    const uint64_t cube_pairs = cube_pair_count(settings.width);
    PairBuffer pairs;
    pairs.buffer = vulkan::Buffer(device_, cube_pairs * (settings.layers / 6) * PAIR_BYTES,
                                  VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    pairs.view = vulkan::texel_view(pairs.buffer, VK_FORMAT_R32G32B32A32_UINT);

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
    texels_ = vulkan::Buffer(device_, texels * TEXEL_BYTES, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    texels_view_ = vulkan::texel_view(texels_, VK_FORMAT_R32G32_UINT);
    commands.transition(cubes, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(commands.handle(), cubes.handle(), cubes.layout(), texels_.handle(),
                           uint32_t(copies.size()), copies.data());
    commands.transition(cubes, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.barrier();

    set_ = vulkan::DescriptorSet(inside_);
    set_.bind_texel_buffer(shared::BINDING_PACK_TEXELS, texels_view_)
        .bind_texel_buffer(shared::BINDING_PACK_PAIRS, pairs.view);
    const auto dispatch = [&](const vulkan::ComputePipeline& pipeline) {
        uint32_t begin = 0;
        for (const VkBufferImageCopy& copy : copies) {
            const uint32_t size = copy.imageExtent.width;
            const bool is_border = &pipeline == &border_;
            const shared::PackRecord push{size, uint32_t(copy.bufferOffset / TEXEL_BYTES), begin,
                                          uint32_t(cube_pairs)};
            const uint32_t items = is_border ? 4 * size + 2 : size + 1, per_group = pipeline.local_size()[0];
            commands.dispatch(pipeline, set_, vulkan::push_bytes(push), (items + per_group - 1) / per_group,
                              is_border ? 1 : size + 2, settings.layers);
            begin += level_pair_count(size);
        }
        commands.barrier();
    };
    dispatch(inside_);
    dispatch(border_);
    return pairs;
}

} // namespace burnish
