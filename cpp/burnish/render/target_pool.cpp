#include "burnish/render/target_pool.h"

#include <algorithm>

namespace burnish::render {
namespace {

// In a loop that keeps its last frame while it draws the next, two sets take turns.
constexpr size_t MOST_IDLE = 2;

/// All the same, with room for as many lists.
bool serves(const TargetSettings& there, TargetSettings wanted) {
    if (there.list_count < wanted.list_count) return false;
    wanted.list_count = there.list_count;
    return there == wanted;
}

} // namespace

std::shared_ptr<FrameTargets> TargetPool::take(const TargetSettings& wanted) {
    std::unique_ptr<FrameTargets> targets;
    {
        const std::lock_guard lock(mutex_);
        // What does not fit goes first: its memory may be needed.
        std::erase_if(idle_, [&](const auto& one) { return !serves(one->settings, wanted); });
        if (!idle_.empty()) {
            targets = std::move(idle_.back());
            idle_.pop_back();
        }
    }
    if (!targets) targets = std::make_unique<FrameTargets>(device_, wanted);
    return {targets.release(), [pool = weak_from_this()](FrameTargets* one) {
                std::unique_ptr<FrameTargets> owned(one);
                if (const auto alive = pool.lock()) alive->give_back(std::move(owned));
            }};
}

void TargetPool::clear() {
    const std::lock_guard lock(mutex_);
    idle_.clear();
}

void TargetPool::give_back(std::unique_ptr<FrameTargets> targets) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(targets));
    if (idle_.size() > MOST_IDLE) idle_.erase(idle_.begin());
}

} // namespace burnish::render
