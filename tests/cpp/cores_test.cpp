// Work shared out over cores.
#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "burnish/cores.h"

namespace burnish {
namespace {

TEST(ForEachOnCores, CallsEachOnce) {
    for (const bool much : {false, true})
        for (const size_t count : {0, 1, 1000}) {
            std::vector<std::atomic<int>> calls(count);
            for_each_on_cores(count, much, [&](size_t k) { ++calls[k]; });
            for (size_t k = 0; k < count; ++k)
                ASSERT_EQ(calls[k], 1) << k << " of " << count;
        }
}

TEST(ForEachOnCores, ThrowsWhatACallThrewOnceAllHaveEnded) {
    std::atomic<int> running = 0;
    const auto work = [&](size_t k) {
        ++running;
        if (k == 7) {
            --running;
            throw std::invalid_argument("k: expected another, got 7");
        }
        --running;
    };
    for (const bool much : {false, true})
        EXPECT_THROW(for_each_on_cores(100, much, work), std::invalid_argument);
    EXPECT_EQ(running, 0);
}

} // namespace
} // namespace burnish
