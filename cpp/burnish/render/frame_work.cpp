#include "burnish/render/frame_work.h"

namespace burnish::render {

vulkan::Commands& PictureRun::commands() {
    if (!commands_) commands_.emplace(device_);
    return *commands_;
}

void PictureRun::submit() {
    if (!commands_) return;
    commands_->submit();
    add_pass_times(times_, commands_->pass_times());
    commands_.reset();
}

std::vector<Pass> make_passes(FrameWork& work, const std::function<void()>& run_reference) {
    std::vector<Pass> passes;
    for (const PassLine& line : work.plan.passes) {
        const uint32_t number = line.number.value_or(0);
        std::function<void(PictureRun&)> run;
        switch (line.kind) {
        case PassKind::pyramid:
        case PassKind::prefilter:
        case PassKind::irradiance:
        case PassKind::pack:
        case PassKind::read_back:
            continue; // not of a picture
        case PassKind::surface:
            run = [&](PictureRun& picture) { work.surface->record(picture.commands(), *work.frame.targets); };
            break;
        case PassKind::tiles:
            run = [&](PictureRun& picture) { work.shade->record_tiles(picture.commands()); };
            break;
        case PassKind::light_lists:
            run = [&](PictureRun& picture) { work.shade->record_light_lists(picture.commands()); };
            break;
        case PassKind::shade:
            run = [&, number](PictureRun& picture) {
                work.shade->record_class(picture.commands(), number, {});
            };
            break;
        case PassKind::reference:
            if (number > 0) continue; // the first draws all classes, batch after batch
            run = [run_reference](PictureRun& picture) {
                picture.submit();
                run_reference();
            };
            break;
        case PassKind::background:
            run = [&](PictureRun& picture) { work.shade->record_background(picture.commands()); };
            break;
        case PassKind::accumulate:
            run = [&](PictureRun& picture) {
                work.accumulate->record(picture.commands(), picture.picture());
            };
            break;
        }
        passes.push_back({line, std::move(run)});
    }
    return passes;
}

} // namespace burnish::render
