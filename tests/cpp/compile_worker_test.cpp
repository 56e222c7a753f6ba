// The thread that compiles: what it does first, what it forgets, and how its errors come out. Jobs of these
// tests end when the test lets them.
#include "burnish/render/compile_worker.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace burnish::render {
namespace {

ComputeKey key_of(const std::string& name) {
    return {name, {}};
}

/// What ran, in order. Every job waits for open().
class Jobs {
public:
    void run(const ComputeKey& key) {
        std::unique_lock lock(mutex_);
        done_.push_back(key.first);
        changed_.notify_all();
        changed_.wait(lock, [&] { return is_open_; });
    }
    void wait_for_first() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !done_.empty(); });
    }
    void open() {
        const std::lock_guard lock(mutex_);
        is_open_ = true;
        changed_.notify_all();
    }
    std::vector<std::string> done() {
        const std::lock_guard lock(mutex_);
        return done_;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> done_;
    bool is_open_ = false;
};

void want(CompileWorker& worker, const std::vector<std::string>& names) {
    std::vector<ComputeKey> keys;
    for (const std::string& name : names)
        keys.push_back(key_of(name));
    worker.want(keys);
}

TEST(CompileWorker, TakesTheNewestFirstAndForgetsTheOldest) {
    Jobs jobs;
    CompileWorker worker([&](const ComputeKey& key) { jobs.run(key); });
    want(worker, {"first"});
    jobs.wait_for_first();
    std::vector<std::string> wanted = {"first"};
    for (size_t k = 0; k < 3 * MOST_WAITING; ++k) {
        want(worker, {"value " + std::to_string(k)});
        if (k >= 2 * MOST_WAITING) wanted.insert(wanted.begin() + 1, "value " + std::to_string(k));
    }
    jobs.open();
    worker.wait();
    EXPECT_EQ(jobs.done(), wanted);
}

TEST(CompileWorker, DoesWhatIsWantedTwiceOnce) {
    Jobs jobs;
    CompileWorker worker([&](const ComputeKey& key) { jobs.run(key); });
    want(worker, {"first"});
    jobs.wait_for_first();
    want(worker, {"a", "b"});
    want(worker, {"c", "first", "b"});
    jobs.open();
    worker.wait();
    EXPECT_EQ(jobs.done(), (std::vector<std::string>{"first", "c", "b", "a"}));
}

TEST(CompileWorker, RaisesAnErrorOnceAndWorksOn) {
    std::vector<std::string> done;
    CompileWorker worker([&](const ComputeKey& key) {
        if (key.first == "bad") throw std::runtime_error("it is bad");
        done.push_back(key.first);
    });
    want(worker, {"bad", "good"});
    worker.wait();
    EXPECT_EQ(done, std::vector<std::string>{"good"});
    try {
        worker.raise_error();
        FAIL() << "the error is lost";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "it is bad");
    }
    EXPECT_NO_THROW(worker.raise_error());
    want(worker, {"bad"});
    worker.wait();
    EXPECT_THROW(worker.raise_error(), std::runtime_error);
}

TEST(CompileWorker, MayEndAmidAJob) {
    Jobs jobs;
    std::thread opener;
    {
        CompileWorker worker([&](const ComputeKey& key) { jobs.run(key); });
        want(worker, {"first", "second"});
        jobs.wait_for_first();
        opener = std::thread([&] { jobs.open(); });
    }
    opener.join();
    EXPECT_LE(jobs.done().size(), 2u);
    EXPECT_EQ(jobs.done().front(), "first");
    const CompileWorker idle([](const ComputeKey&) {});
}

TEST(CompileWorker, TakesNothingMoreOnceItIsClosed) {
    std::vector<std::string> done;
    CompileWorker worker([&](const ComputeKey& key) { done.push_back(key.first); });
    want(worker, {"first"});
    worker.wait();
    worker.close();
    worker.close();
    want(worker, {"second"});
    worker.wait(); // for nothing
    EXPECT_EQ(done, std::vector<std::string>{"first"});
}

TEST(CompileWorker, WaitsForNothingWhenNothingIsWanted) {
    CompileWorker worker([](const ComputeKey&) { FAIL(); });
    worker.wait();
    want(worker, {});
    worker.wait();
}

} // namespace
} // namespace burnish::render
