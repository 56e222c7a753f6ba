// What the validation layer says while a device is closed fails the run: the test it came in, or, of devices
// that are closed after the last test, the process.
#include "burnish/vulkan/validation.h"
#include "vulkan_support.h"

#include <cstdlib>

namespace burnish::vulkan {
namespace {

class ClosingCheck : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& /*test*/) override {
        const std::vector<std::string> messages = closing_messages();
        for (; seen_ < messages.size(); ++seen_)
            ADD_FAILURE() << "while a device was closed: " << messages[seen_];
    }
    void OnTestProgramEnd(const testing::UnitTest& /*unit_test*/) override { exit_on_closing_messages(); }

    size_t seen_ = 0;
};

/// Before main: every test of the program is watched.
const bool is_watched = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new ClosingCheck);
    return true;
}();

/// Closes a device whose memory was not given back.
void close_leaking_device() {
    const auto device = Device::create({.validation = true});
    const Buffer buffer(device, 256, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    device->inject_fault("vkFreeMemory", VK_ERROR_UNKNOWN);
}

class ClosingMessages : public testing::Test {
protected:
    void SetUp() override {
        GTEST_FLAG_SET(death_test_style, "threadsafe"); // this process has a driver's threads
        try {
            Device::create({.validation = true});
        } catch (const VulkanError& error) {
            if (std::string(error.what()).find("vulkan-validationlayers") == std::string::npos) throw;
            GTEST_SKIP() << "vulkan-validationlayers is not installed";
        }
    }
};

TEST_F(ClosingMessages, EndTheProcessAfterTheLastTest) {
    ASSERT_TRUE(is_watched);
    const auto run = [] {
        exit_on_closing_messages();
        close_leaking_device();
        std::_Exit(0);
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(1), "while closing .*vkDestroyDevice");
}

TEST_F(ClosingMessages, AreKeptForTheTestThatTheyCameIn) {
    const auto run = [] {
        close_leaking_device();
        std::_Exit(closing_messages().empty() ? 0 : 3);
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(3), "vkDestroyDevice");
}

} // namespace
} // namespace burnish::vulkan
