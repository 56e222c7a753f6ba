// Choosing devices, validation, ownership and memory.
#include "vulkan_support.h"

#include "burnish/vulkan/device_selection.h"

namespace burnish::vulkan {
namespace {

Candidate candidate(const char* name, VkPhysicalDeviceType type, std::vector<std::string> refusals = {}) {
    Candidate one;
    one.info.name = name;
    one.info.refusals = std::move(refusals);
    one.type = type;
    return one;
}

TEST(DeviceSelection, ListsUsableDeviceWithDriver) {
    const std::vector<DeviceInfo> devices = list_devices();
    ASSERT_FALSE(devices.empty());
    EXPECT_NE(devices[0].name, "");
    EXPECT_NE(devices[0].driver, "");
    EXPECT_GE(devices[0].api_version, VK_API_VERSION_1_0);
}

TEST(DeviceSelection, PrefersDiscreteThenIntegratedThenVirtualThenSoftware) {
    std::vector<Candidate> all = {candidate("software", VK_PHYSICAL_DEVICE_TYPE_CPU),
                                  candidate("guest", VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU),
                                  candidate("laptop", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
                                  candidate("card", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU)};
    for (const char* expected : {"card", "laptop", "guest", "software"}) {
        EXPECT_EQ(choose_candidate(all, "").info.name, expected);
        std::vector<Candidate> reversed(all.rbegin(), all.rend());
        EXPECT_EQ(choose_candidate(reversed, "").info.name, expected);
        all.pop_back();
    }
}

TEST(DeviceSelection, RefusedDeviceIsNeverChosen) {
    const std::vector<Candidate> all = {
        candidate("old card", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, {"offers Vulkan 1.1.0, needs 1.3"}),
        candidate("llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU)};
    EXPECT_EQ(choose_candidate(all, "").info.name, "llvmpipe");
    EXPECT_EQ(choose_candidate(all, "LLVM").info.name, "llvmpipe");
    const std::string text = error_text<VulkanError>([&] { choose_candidate(all, "card"); });
    expect_contains(text, "old card: offers Vulkan 1.1.0, needs 1.3");
    expect_contains(text, "llvmpipe: the name does not match");
}

TEST(DeviceSelection, ChoosesByPartOfTheName) {
    const std::string name = Device::create()->info().name;
    EXPECT_EQ(Device::create({.name = name.substr(1, 4)})->info().name, name);
}

TEST(DeviceSelection, UnknownNameListsEveryDevice) {
    const std::string text = error_text<VulkanError>([] { Device::create({.name = "no such device"}); });
    expect_contains(text, "expected a usable one called \"no such device\"");
    for (const DeviceInfo& info : list_devices())
        expect_contains(text, info.name);
}

TEST(DeviceSelection, MissingDriverNamesThePackage) {
    const ScopedVariable newer("VK_DRIVER_FILES", "/nonexistent.json");
    const ScopedVariable older("VK_ICD_FILENAMES", "/nonexistent.json");
    expect_contains(error_text<VulkanError>([] { list_devices(); }), "apt install mesa-vulkan-drivers");
    expect_contains(error_text<VulkanError>([] { Device::create(); }), "mesa-vulkan-drivers");
}

TEST(Validation, MissingLayerNamesThePackage) {
    const ScopedVariable no_layers("VK_LAYER_PATH", "/nonexistent");
    expect_contains(error_text<VulkanError>([] { Device::create({.validation = true}); }),
                    "apt install vulkan-validationlayers");
}

TEST(Validation, EnvironmentVariableTurnsItOn) {
    const ScopedVariable on("BURNISH_VALIDATION", "1");
    EXPECT_TRUE(DeviceSettings{}.validation);
    const ScopedVariable off("BURNISH_VALIDATION", "0");
    EXPECT_FALSE(DeviceSettings{}.validation);
}

/// A device with validation, or null where the layer is not installed.
std::shared_ptr<Device> validated_device() {
    try {
        return Device::create({.validation = true});
    } catch (const VulkanError& error) {
        if (std::string(error.what()).find("vulkan-validationlayers") == std::string::npos) throw;
        return nullptr;
    }
}

TEST(Validation, ErrorIsThrownAtTheNextSubmit) {
    const auto device = validated_device();
    if (!device) GTEST_SKIP() << "vulkan-validationlayers is not installed";
    const CopyWords probe(device);
    Commands commands(device);
    // The buffer lacks VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT.
    commands.dispatch_indirect(probe.pipeline, probe.set, push_bytes(probe.push), probe.source);
    expect_contains(error_text<VulkanError>([&] { commands.submit(); }), "VUID-vkCmdDispatchIndirect");
    EXPECT_FALSE(device->validation_messages().empty());
    Commands next(device); // told once
    next.submit();
}

TEST(Validation, MissingBarrierIsAnError) {
    const auto device = validated_device();
    if (!device) GTEST_SKIP() << "vulkan-validationlayers is not installed";
    const CopyWords probe(device);
    DescriptorSet backwards(probe.pipeline);
    backwards.bind(0, probe.target).bind(1, probe.source);
    for (const bool has_barrier : {false, true}) {
        Commands commands(device);
        probe.record(commands);
        if (has_barrier) commands.barrier();
        commands.dispatch(probe.pipeline, backwards, push_bytes(probe.push), 1);
        if (has_barrier) {
            commands.submit();
        } else {
            expect_contains(error_text<VulkanError>([&] { commands.submit(); }), "SYNC-HAZARD");
        }
    }
}

TEST(Ownership, ObjectsOutliveTheDevicePointer) {
    auto device = Device::create();
    std::weak_ptr<Device> watch = device;
    {
        const CopyWords probe(device);
        Image image(device, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 8, .height = 8});
        image.view();
        device.reset();
        EXPECT_EQ(probe.run(), counting_words(1000));
        EXPECT_FALSE(watch.expired());
    }
    EXPECT_TRUE(watch.expired());
}

TEST(Ownership, AssignmentFreesTheOldObject) {
    const auto device = Device::create();
    Buffer buffer(device, 1000, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    Image image(device, {.format = VK_FORMAT_R8_UNORM});
    for (int i = 0; i < 10; ++i) {
        buffer = Buffer(device, 2000, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        image = Image(device, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 4, .height = 4});
    }
    EXPECT_EQ(device->memory_statistics().allocations, 2u);
    buffer = {};
    image = {};
    EXPECT_EQ(device->memory_statistics().allocations, 0u);
    EXPECT_EQ(device->memory_statistics().used_bytes, 0u);
}

TEST(Memory, ManySmallImagesShareFewBlocks) {
    const auto device = Device::create();
    std::vector<Image> images;
    for (int i = 0; i < 1000; ++i) {
        images.emplace_back(device, ImageSettings{.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                                  .width = 32,
                                                  .height = 32,
                                                  .levels = 6,
                                                  .layers = 6,
                                                  .is_cube = true});
    }
    const MemoryStatistics full = device->memory_statistics();
    EXPECT_LE(full.blocks, 3u);
    EXPECT_GE(full.blocks, 2u);
    EXPECT_EQ(full.allocations, 1000u);
    EXPECT_GE(full.used_bytes, 1000u * 6 * 32 * 32 * 8);
    EXPECT_LE(full.used_bytes, full.reserved_bytes);

    // Every other one goes and comes back: the holes are used again.
    for (std::size_t i = 0; i < images.size(); i += 2)
        images[i] = {};
    for (std::size_t i = 0; i < images.size(); i += 2)
        images[i] = Image(device, images[1].settings());
    EXPECT_EQ(device->memory_statistics().blocks, full.blocks);
    EXPECT_EQ(device->memory_statistics().used_bytes, full.used_bytes);

    // Freed in an odd order, the ranges must merge: at most one spare block stays.
    for (std::size_t step = 0; step < 7; ++step) {
        for (std::size_t i = step; i < images.size(); i += 7)
            images[i] = {};
    }
    EXPECT_EQ(device->memory_statistics().used_bytes, 0u);
    EXPECT_LE(device->memory_statistics().blocks, 1u);
    const Image large(device, {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = 1400, .height = 1400});
    EXPECT_LE(device->memory_statistics().blocks, 1u) << "31 MB must fit into the merged spare block";
}

TEST(Memory, LargeBufferHasItsOwnBlockAndGivesItBack) {
    const auto device = Device::create();
    {
        const Buffer large(device, MemoryPool::block_bytes * 2, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        EXPECT_EQ(device->memory_statistics().blocks, 1u);
    }
    EXPECT_EQ(device->memory_statistics().blocks, 0u);
}

TEST(Memory, ImpossibleSizesAreRefused) {
    const auto device = Device::create();
    expect_contains(error_text<std::invalid_argument>([&] { Buffer(device, 0, 0); }), "size_bytes");
    const std::string text = error_text<OutOfMemoryError>([&] { Buffer(device, uint64_t{1} << 60, 0); });
    expect_contains(text, "in one buffer on " + device->info().name + ", got 1099511627776.0 MiB");
}

} // namespace
} // namespace burnish::vulkan
