// Work shared out over the machine's cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace burnish {

/// Calls work(k) for every k below `count`, on all cores if there is `much` to do: threads take time to
/// start. Which thread calls which k is not fixed. Throws the first error that a call threw, once all have
/// ended.
template <typename Work>
void for_each_on_cores(size_t count, bool much, const Work& work) {
    std::atomic<size_t> next{0};
    std::mutex mutex;
    std::exception_ptr error;
    const auto run = [&] {
        try {
            for (size_t k = next++; k < count; k = next++)
                work(k);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!error) error = std::current_exception();
        }
    };
    const size_t threads = much ? std::min<size_t>(std::thread::hardware_concurrency(), count) : 1;
    {
        std::vector<std::jthread> others;
        for (size_t k = 1; k < threads; ++k)
            others.emplace_back(run);
        run();
    }
    if (error) std::rethrow_exception(error);
}

} // namespace burnish
