// What frames are drawn into, handed out and taken back.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "burnish/render/frame_targets.h"

namespace burnish::render {

/// Targets belong to whoever holds them and come back when they are let go, from any thread. A few wait here
/// for the next frame: fresh memory costs a CPU device more than a small frame.
class TargetPool : public std::enable_shared_from_this<TargetPool> {
public:
    explicit TargetPool(vulkan::DevicePointer device) : device_(std::move(device)) {}

    std::shared_ptr<FrameTargets> take(const TargetSettings& wanted);
    /// Lets go of those that wait.
    void clear();

private:
    void give_back(std::unique_ptr<FrameTargets> targets);

    vulkan::DevicePointer device_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<FrameTargets>> idle_; // the last used last
};

} // namespace burnish::render
