#include "burnish/render/compile_worker.h"

#include <algorithm>
#include <iterator>
#include <sys/resource.h>
#include <unistd.h>

namespace burnish::render {
namespace {

/// Pictures that a CPU draws meanwhile come first.
void step_back() {
#ifdef __linux__ // elsewhere it would be all threads of the process
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
#endif
}

} // namespace

void CompileWorker::close() {
    {
        const std::lock_guard lock(mutex_);
        is_closing_ = true;
        waiting_.clear();
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void CompileWorker::want(std::span<const ComputeKey> keys) {
    const std::lock_guard lock(mutex_);
    if (is_closing_) return;
    std::erase_if(waiting_, [&](const ComputeKey& key) {
        return std::find(keys.begin(), keys.end(), key) != keys.end();
    });
    std::deque<ComputeKey> first;
    std::copy_if(keys.begin(), keys.end(), std::back_inserter(first),
                 [&](const ComputeKey& key) { return key != current_; });
    waiting_.insert(waiting_.begin(), first.begin(), first.end());
    if (waiting_.size() > MOST_WAITING) waiting_.resize(MOST_WAITING);
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
    wake_.notify_all();
}

void CompileWorker::wait() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [&] { return waiting_.empty() && !current_; });
}

void CompileWorker::raise_error() {
    const std::lock_guard lock(mutex_);
    if (const std::exception_ptr error = std::exchange(error_, nullptr)) std::rethrow_exception(error);
}

void CompileWorker::run() {
    step_back();
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [&] { return is_closing_ || !waiting_.empty(); });
        if (is_closing_) return;
        current_ = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        std::exception_ptr error;
        try {
            compile_(*current_);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        current_.reset();
        if (!error_) error_ = std::move(error);
        if (waiting_.empty()) idle_.notify_all();
    }
}

} // namespace burnish::render
