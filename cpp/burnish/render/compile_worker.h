// Compiles pipelines on a thread of its own, while pictures are drawn without them.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include "burnish/plan/plan.h"
#include "burnish/vulkan/shader.h"

namespace burnish::render {

/// Tells compute pipelines apart: name of the shader and what it is specialised by.
using ComputeKey = std::pair<std::string, vulkan::SpecializationConstants>;

/// Most that wait. A value that is dragged leaves dozens behind, of which only the last is sure to be seen
/// again; one picture asks for no more than these. The oldest are forgotten: who still wants them asks again.
constexpr size_t MOST_WAITING = MAX_CONSTANT_CLASSES;

/// Thread-safe. The thread starts with the first key; the destructor drops what waits and lets it finish the
/// one it is at, so it must not run in a fork, where that thread is not.
class CompileWorker {
public:
    /// `compile` runs on the thread, for one key after the other.
    explicit CompileWorker(std::function<void(const ComputeKey&)> compile) : compile_(std::move(compile)) {}
    CompileWorker(const CompileWorker&) = delete;
    CompileWorker& operator=(const CompileWorker&) = delete;
    ~CompileWorker() { close(); }

    /// Drops what waits and ends the thread, after what it is at.
    void close();
    /// Puts the keys before all that wait, unless it is closed.
    void want(std::span<const ComputeKey> keys);
    /// Until nothing waits or is at work.
    void wait();
    /// Throws the first that `compile` threw since the last call: what followed it has the same cause, or
    /// comes again.
    void raise_error();

private:
    void run();

    std::function<void(const ComputeKey&)> compile_;
    std::mutex mutex_;
    std::condition_variable wake_, idle_;
    std::deque<ComputeKey> waiting_; // the next first
    std::optional<ComputeKey> current_;
    std::exception_ptr error_;
    bool is_closing_ = false;
    std::thread thread_;
};

} // namespace burnish::render
