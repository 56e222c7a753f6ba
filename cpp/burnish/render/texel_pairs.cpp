#include "burnish/render/texel_pairs.h"

#include "burnish/plan/map_lookup.h"
#include "shared/texel_pairs.h"

#include "spirv/pyramid_pack_pairs_comp.h"

namespace burnish {

namespace {

constexpr uint32_t PAIR_BYTES = 16;

} // namespace

TexelPairs::TexelPairs(std::shared_ptr<const vulkan::Device> device)
    : device_(std::move(device)),
      pack_(device_, vulkan::Shader(device_, "pyramid/pack_pairs.comp", pyramid_pack_pairs_comp_spv)),
      sampler_(device_, {}) {}

PairBuffer TexelPairs::record(vulkan::Commands& commands, const vulkan::Image& cubes) {
    const vulkan::ImageSettings& settings = cubes.settings();
    const uint64_t cube_pairs = cube_pair_count(settings.width);
    PairBuffer pairs;
    pairs.buffer = vulkan::Buffer(device_, cube_pairs * (settings.layers / 6) * PAIR_BYTES,
                                  VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    pairs.view = vulkan::texel_view(pairs.buffer, VK_FORMAT_R32G32B32A32_UINT);
    set_ = vulkan::DescriptorSet(pack_);
    set_.bind(shared::BINDING_PACK_FACES, cubes.view_as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), sampler_)
        .bind_texel_buffer(shared::BINDING_PACK_PAIRS, pairs.view);
    uint32_t begin = 0;
    for (uint32_t level = 0; level < settings.levels; ++level) {
        const uint32_t size = settings.width >> level;
        const shared::PackRecord push{level, size, begin, uint32_t(cube_pairs)};
        const uint32_t per_group = pack_.local_size()[0];
        commands.dispatch(pack_, set_, vulkan::push_bytes(push), (size + 1 + per_group - 1) / per_group,
                          size + 2, settings.layers);
        begin += level_pair_count(size);
    }
    commands.barrier();
    return pairs;
}

} // namespace burnish
