#include "burnish/render/accumulate_pass.h"

#include "burnish/plan/passes.h"
#include "burnish/render/shade_pass.h"
#include "shared/constants.h"
#include "shared/records.h"

namespace burnish::render {

AccumulatePass::AccumulatePass(Pipelines& pipelines, const FrameTargets& targets, uint32_t picture_count,
                               uint64_t pixel_count, bool has_display, float display_scale)
    : picture_count_(picture_count), pixel_count_(pixel_count), has_display_(has_display),
      display_scale_(display_scale) {
    for (size_t k = 0; k < (has_display ? 2 : 1); ++k) {
        vulkan::SpecializationConstants constants;
        constants.set(shared::SPEC_IS_DISPLAY, k == 1);
        pipelines_[k] = &pipelines.compute("resolve/accumulate.comp", constants);
        sets_[k] = vulkan::DescriptorSet(*pipelines_[k]);
        sets_[k]
            .bind(shared::BINDING_ACCUMULATE_SAMPLE, targets.radiance)
            .bind(shared::BINDING_ACCUMULATE_SUM, targets.sum)
            .bind(shared::BINDING_ACCUMULATE_DISPLAY, targets.display);
    }
}

void AccumulatePass::record(vulkan::Commands& commands, uint32_t picture) const {
    const size_t k = has_display_ && picture + 1 == picture_count_ ? 1 : 0;
    const shared::AccumulateRecord push{uint32_t(pixel_count_), picture == 0 ? 1u : 0u,
                                        1.0f / float(picture_count_), display_scale_};
    const GroupRows rows = fold_groups((pixel_count_ + 63) / 64);
    commands.begin_pass(pass_name(PassKind::accumulate));
    commands.dispatch(*pipelines_[k], sets_[k], vulkan::push_bytes(push), rows.length, rows.count);
    commands.end_pass();
}

} // namespace burnish::render
