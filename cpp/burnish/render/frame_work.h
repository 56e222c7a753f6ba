// All that draws one frame, made from a plan before anything runs.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "burnish/render/accumulate_pass.h"
#include "burnish/render/frame.h"
#include "burnish/render/shade_pass.h"
#include "burnish/render/surface_pass.h"
#include "burnish/vulkan/commands.h"

namespace burnish::render {

/// Passes share this while one picture of a frame is drawn.
class PictureRun {
public:
    PictureRun(vulkan::DevicePointer device, uint32_t picture, std::vector<vulkan::PassTime>& times)
        : device_(std::move(device)), picture_(picture), times_(times) {}

    uint32_t picture() const { return picture_; } ///< counted from 0
    /// Commands that are recorded here run together, up to the next `submit`.
    vulkan::Commands& commands();
    /// Runs what was recorded, waits for it and adds its times.
    void submit();

private:
    vulkan::DevicePointer device_;
    uint32_t picture_;
    std::vector<vulkan::PassTime>& times_;
    std::optional<vulkan::Commands> commands_;
};

/// One line of the plan and what it does: records, or runs commands of its own.
struct Pass {
    PassLine line;
    std::function<void(PictureRun&)> run;
};

struct FrameWork {
    Plan plan;
    ShadeTables tables;
    LightTable lights;
    std::vector<std::shared_ptr<EnvironmentMaps>> maps;
    std::optional<ReferenceBuffers> reference;
    Frame frame;
    std::vector<vulkan::PassTime> times;
    bool counts_non_finite = false;
    std::optional<SurfacePass> surface;
    std::optional<ShadePass> shade;
    std::optional<AccumulatePass> accumulate;
    std::vector<Pass> passes; ///< of every picture, in order

    uint64_t pixels() const { return uint64_t(frame.width) * frame.height; }
};

/// The passes of the plan that every picture runs, in its order. `run_reference` draws by the truth, with
/// commands of its own. The frame's parts must be there, and live as long as the passes.
std::vector<Pass> make_passes(FrameWork& work, const std::function<void()>& run_reference);

} // namespace burnish::render
