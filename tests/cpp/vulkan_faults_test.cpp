// What goes wrong below: too little memory, a lost device, a shader the driver cannot compile, a fork. Each
// gives one clear error, and what can still work does.
#include "vulkan_support.h"

#include "burnish/vulkan/memory.h"
#include "burnish/vulkan/result.h"

#include <sys/wait.h>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace burnish::vulkan {
namespace {

constexpr VkDeviceSize MIB = VkDeviceSize{1} << 20;

/// What the child process of a fork finds out: an empty text is success.
void expect_in_fork(const std::function<std::string()>& check) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        alarm(60); // a hang is a failure, not a stopped test run
        const std::string text = check();
        const bool is_written = write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
        _exit(is_written && text.empty() ? 0 : 1);
    }
    close(ends[1]);
    std::string text(4096, '\0');
    const ssize_t length = read(ends[0], text.data(), text.size());
    close(ends[0]);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0) << text.substr(0, static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
}

TEST(Faults, MemoryLimitIsKeptAndItsErrorSaysHowMuch) {
    const auto device = Device::create({.memory_limit_bytes = 32 * MIB});
    std::vector<Buffer> buffers;
    const auto fill = [&] {
        for (int k = 0; k < 100; ++k)
            buffers.emplace_back(device, 5 * MIB, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    };
    const std::string text = error_text<OutOfMemoryError>(fill);
    expect_contains(text, "expected 5.000 MiB more memory on " + device->info().name);
    expect_contains(text, "VK_ERROR_OUT_OF_DEVICE_MEMORY with 30.0 MiB of the allowed 32.0 MiB taken");
    EXPECT_EQ(buffers.size(), 6u);
    buffers.pop_back();
    EXPECT_EQ(CopyWords(device).run(), counting_words(1000)) << "what fits must still work";
    buffers.clear();
    EXPECT_NO_THROW(Buffer(device, 30 * MIB, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
}

TEST(Faults, BlocksThatStandEmptyAreGivenBackBeforeMemoryIsRefused) {
    const auto device = Device::create({.memory_limit_bytes = 16 * MIB});
    Image(device, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 64, .height = 64});
    ASSERT_EQ(device->memory_statistics().blocks, 1u) << "the spare block";
    EXPECT_NO_THROW(Buffer(device, 16 * MIB, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
}

TEST(Faults, MemoryThatTheDriverRefusesIsAskedForAgainOnce) {
    const auto device = Device::create();
    const VkResult lack = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    device->inject_fault("vkAllocateMemory", lack, 0, 1);
    EXPECT_NO_THROW(Buffer(device, 70 * MIB, 0));
    device->inject_fault("vkAllocateMemory", lack, 0, 2);
    const std::string text = error_text<OutOfMemoryError>([&] { Buffer(device, 70 * MIB, 0); });
    expect_contains(text, "expected 70.0 MiB more memory");
    expect_contains(text, "VK_ERROR_OUT_OF_DEVICE_MEMORY with 0.000 MiB taken");
    EXPECT_EQ(device->memory_statistics().reserved_bytes, 0u);
    EXPECT_EQ(CopyWords(device).run(), counting_words(1000));
}

TEST(Faults, LostDeviceSaysSoAndAnotherOneWorks) {
    const auto device = Device::create();
    const CopyWords probe(device);
    EXPECT_FALSE(device->is_lost());
    device->inject_fault("vkQueueSubmit2", VK_ERROR_DEVICE_LOST);
    expect_contains(error_text<VulkanError>([&] { probe.run(); }),
                    "VK_ERROR_DEVICE_LOST (-4); the device is lost, make a new burnish.Device");
    EXPECT_TRUE(device->is_lost());
    for (int k = 0; k < 2; ++k) {
        expect_contains(error_text<VulkanError>([&] { probe.run(); }),
                        "device: expected a working one, got a lost one; make a new burnish.Device");
    }
    EXPECT_EQ(CopyWords(Device::create()).run(), counting_words(1000));
}

TEST(Faults, RefusedSubmitLeavesLayoutsAndCommandsAsTheyWere) {
    const auto device = Device::create();
    Image image(device, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 4, .height = 4});
    const CopyWords probe(device);
    device->inject_fault("vkQueueSubmit2", VK_ERROR_OUT_OF_DEVICE_MEMORY);
    {
        Commands commands(device);
        commands.transition(image, VK_IMAGE_LAYOUT_GENERAL);
        expect_contains(error_text<OutOfMemoryError>([&] { commands.submit(); }), "vkQueueSubmit2: expected");
    }
    EXPECT_EQ(image.layout(), VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_FALSE(device->is_lost());
    EXPECT_EQ(probe.run(), counting_words(1000));
}

TEST(Faults, ShaderThatDoesNotCompileIsNamed) {
    const auto device = Device::create();
    // Drivers also return lack of memory for shaders that they do not understand.
    for (const VkResult result : {VK_ERROR_INVALID_SHADER_NV, VK_ERROR_OUT_OF_HOST_MEMORY}) {
        device->inject_fault("vkCreateComputePipelines", result);
        const std::string text = error_text<VulkanError>([&] { CopyWords{device}; });
        expect_contains(text, "probe/copy_words.comp: expected the driver to compile it");
        expect_contains(text, result_name(result));
    }
    EXPECT_EQ(CopyWords(device).run(), counting_words(1000));
}

TEST(Faults, DamagedShaderIsNamed) {
    const auto device = Device::create({.validation = false});
    if (device->info().name.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "the driver need not notice, and may crash";
    std::vector<uint32_t> words(std::begin(probe_copy_words_comp_spv), std::end(probe_copy_words_comp_spv));
    for (uint32_t& word : words)
        if (word == 0x000100fdu) word = 0x0001fff0u; // OpReturn becomes an instruction that there is not
    const Shader shader(device, "probe/damaged.comp", words);
#ifdef __SANITIZE_ADDRESS__
    const __lsan::ScopedDisabler of_lavapipe; // it keeps 1680 bytes of a pipeline whose SPIR-V it refuses
#endif
    expect_contains(error_text<VulkanError>([&] { ComputePipeline(device, shader); }),
                    "probe/damaged.comp: expected the driver to compile it");
    EXPECT_EQ(CopyWords(device).run(), counting_words(1000));
}

TEST(Faults, ForkedProcessIsToldToOpenItsOwnDevice) {
    const auto device = Device::create({.validation = false});
    const CopyWords probe(device);
    EXPECT_EQ(probe.run(), counting_words(1000)); // now the driver has its threads
    expect_in_fork([&]() -> std::string {
        try {
            probe.run();
            return "the fork used its parent's device";
        } catch (const VulkanError& error) {
            const std::string text = error.what();
            if (text.find("expected one that this process opened") == std::string::npos) return text;
        }
        const auto own = Device::create({.validation = false});
        return CopyWords(own).run() == counting_words(1000) ? "" : "the fork's own device does not work";
    });
    EXPECT_EQ(probe.run(), counting_words(1000));
}

TEST(Faults, ForkedProcessMayDropItsParentsDevice) {
    auto device = Device::create({.validation = false});
    auto probe = std::make_unique<CopyWords>(device);
    probe->run();
    expect_in_fork([&]() -> std::string {
        probe.reset();
        device.reset();
        return "";
    });
    EXPECT_EQ(probe->run(), counting_words(1000));
}

} // namespace
} // namespace burnish::vulkan
