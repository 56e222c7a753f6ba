// Round trips of buffers and images.
#include "vulkan_support.h"

namespace burnish::vulkan {
namespace {

class Transfers : public testing::Test {
protected:
    std::shared_ptr<Device> device = Device::create();
    // Small and odd, so that every copy takes several rounds.
    TransferSettings staged{.staging_bytes = 1021, .direct = false};
};

TEST_F(Transfers, BuffersOfOddSizesComeBack) {
    for (const std::size_t size :
         {std::size_t{1}, std::size_t{3}, std::size_t{1021}, std::size_t{5000}, std::size_t{40} << 20}) {
        const std::vector<std::byte> data = counting_bytes(size);
        const Buffer buffer = make_buffer(device, data, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        EXPECT_EQ(read_back(buffer), data) << size;
        if (size > 5000) continue;
        const Buffer other(device, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        upload(other, data, 0, staged);
        std::vector<std::byte> back(size);
        read_back(other, back, 0, staged);
        EXPECT_EQ(back, data) << size;
    }
}

TEST_F(Transfers, StagedCopyLargerThanABlockComesBack) {
    const std::vector<std::byte> data = counting_bytes((std::size_t{70} << 20) + 3);
    const Buffer buffer(device, data.size(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    upload(buffer, data, 0, {.direct = false});
    std::vector<std::byte> back(data.size());
    read_back(buffer, back, 0, {.direct = false});
    EXPECT_TRUE(back == data);
}

TEST_F(Transfers, PartOfABufferComesBack) {
    const Buffer buffer = make_buffer(device, counting_bytes(100), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    upload(buffer, std::vector<std::byte>(7, std::byte{255}), 50, staged);
    const std::vector<std::byte> part = read_back(buffer, 49, 9);
    EXPECT_EQ(part[0], counting_bytes(100)[49]);
    EXPECT_EQ(part[1], std::byte{255});
    EXPECT_EQ(part[7], std::byte{255});
    EXPECT_EQ(part[8], counting_bytes(100)[57]);
    expect_contains(error_text<std::invalid_argument>([&] { read_back(buffer, 90, 11); }), "buffer's 100");
}

TEST_F(Transfers, HostVisibleBufferIsSeenByTheDevice) {
    const Buffer upload_buffer(device, 4004, 0, MemoryUse::upload);
    const Buffer read_buffer(device, 4004, 0, MemoryUse::read_back);
    const std::vector<uint32_t> words = counting_words(1001);
    std::copy(words.begin(), words.end(), upload_buffer.mapped<uint32_t>().begin());
    Commands commands(device);
    commands.copy_buffer(upload_buffer, read_buffer, 4004);
    commands.submit();
    const std::span<uint32_t> back = read_buffer.mapped<uint32_t>();
    EXPECT_TRUE(std::equal(words.begin(), words.end(), back.begin(), back.end()));
}

struct ImageCase {
    VkFormat format;
    uint32_t width, height, levels, layers;
    bool is_cube;
};

TEST_F(Transfers, ImagesOfOddSizesComeBackLevelByLevel) {
    const ImageCase cases[] = {{VK_FORMAT_R8_UNORM, 1, 1, 1, 1, false},
                               {VK_FORMAT_R8_UNORM, 7, 3, 3, 5, false},
                               {VK_FORMAT_R16G16B16A16_SFLOAT, 16, 16, 5, 12, true},
                               {VK_FORMAT_R32G32B32A32_SFLOAT, 33, 17, 2, 3, false},
                               {VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, 5, 5, 1, 6, true},
                               {VK_FORMAT_D16_UNORM, 3, 5, 1, 2, false}};
    for (const ImageCase& one : cases) {
        Image image(device, {.format = one.format,
                             .width = one.width,
                             .height = one.height,
                             .levels = one.levels,
                             .layers = one.layers,
                             .is_cube = one.is_cube});
        for (uint32_t level = 0; level < one.levels; ++level) {
            const ImageRegion all{.level = level, .layer_count = one.layers};
            // Halves are compared bit by bit: keep NaN patterns out, a driver may change them.
            std::vector<std::byte> data = counting_bytes(image.level_bytes(level) * one.layers);
            for (std::byte& byte : data)
                byte &= std::byte{0x3b};
            for (const TransferSettings& settings : {TransferSettings{}, staged}) {
                upload(image, all, data, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, settings);
                std::vector<std::byte> back(data.size());
                read_back(image, all, back, settings);
                EXPECT_EQ(back, data) << format_name(one.format) << " level " << level;
            }
            EXPECT_EQ(image.layout(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
    }
}

TEST_F(Transfers, RegionOfAnImageComesBack) {
    Image image(device, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 9, .height = 7, .layers = 2});
    upload(image, {.layer_count = 2}, counting_bytes(9 * 7 * 4 * 2));
    const auto part = read_back(image, {.base_layer = 1, .x = 2, .y = 3, .width = 3, .height = 2});
    ASSERT_EQ(part.size(), 3u * 2 * 4);
    EXPECT_EQ(part[3 * 4], counting_bytes(9 * 7 * 4 * 2)[(7 * 9 + 4 * 9 + 2) * 4]);
    expect_contains(error_text<std::invalid_argument>([&] { read_back(image, {.level = 1}); }),
                    "got level 1");
    expect_contains(error_text<std::invalid_argument>([&] { read_back(image, {.x = 9}); }), "x 9");
    expect_contains(error_text<std::invalid_argument>([&] { upload(image, {}, counting_bytes(5)); }),
                    "data: expected 252 bytes for 1 layers of 9 x 7 R8G8B8A8_UNORM, got 5");
}

TEST_F(Transfers, BlitHalvesAnImage) {
    Image image(device, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 4, .height = 4, .levels = 2});
    std::vector<std::byte> checker(64);
    for (std::size_t i = 0; i < 64; ++i)
        checker[i] = (i / 4) % 2 ? std::byte{200} : std::byte{100};
    upload(image, {}, checker, VK_IMAGE_LAYOUT_GENERAL);
    Commands commands(device);
    commands.blit(image, {.level = 0}, image, {.level = 1}, VK_FILTER_LINEAR);
    commands.submit();
    for (const std::byte value : read_back(image, {.level = 1})) {
        EXPECT_NEAR(std::to_integer<int>(value), 150, 1);
    }
}

TEST_F(Transfers, ViewsAreMadeOnce) {
    const Image cubes(
        device,
        {.format = VK_FORMAT_R8_UNORM, .width = 8, .height = 8, .levels = 4, .layers = 12, .is_cube = true});
    EXPECT_EQ(cubes.view(), cubes.view());
    EXPECT_NE(cubes.level_view(0), cubes.level_view(1));
    EXPECT_NE(cubes.layer_view(1, 2), cubes.layer_view(1, 3));
    EXPECT_THROW(cubes.level_view(4), std::invalid_argument);
}

TEST_F(Transfers, ImpossibleImagesAreRefused) {
    const auto refusal = [&](const ImageSettings& settings) {
        return error_text<std::invalid_argument>([&] { Image(device, settings); });
    };
    expect_contains(refusal({.format = VK_FORMAT_R8_UNORM, .width = 0}), "at least 1, got 0 x 1");
    expect_contains(refusal({.format = VK_FORMAT_R8_UNORM, .width = 4, .levels = 4}), "expected 1..3");
    expect_contains(refusal({.format = VK_FORMAT_R8_UNORM, .layers = 5, .is_cube = true}), "multiple of 6");
    expect_contains(refusal({.format = VK_FORMAT_UNDEFINED}), "format: expected one listed");
    // Some hardware stores to depth images; none may draw colours into them.
    const ImageSettings not_drawable{.format = VK_FORMAT_D32_SFLOAT,
                                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
    expect_contains(error_text<VulkanError>([&] { Image(device, not_drawable); }), "got D32_SFLOAT");
    expect_contains(
        error_text<VulkanError>([&] { Image(device, {.format = VK_FORMAT_R8_UNORM, .width = 1u << 30}); }),
        "image: expected at most");
}

TEST(Samplers, EverySettingIsAccepted) {
    const auto device = Device::create();
    const Sampler nearest(device, {.magnification = VK_FILTER_NEAREST,
                                   .minification = VK_FILTER_NEAREST,
                                   .mip_mode = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                   .wrap_u = VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                   .wrap_v = VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
                                   .max_lod = 3});
    const Sampler anisotropic(device, {.max_anisotropy = 1000});
    EXPECT_NE(nearest.handle(), anisotropic.handle());
    device->raise_validation_errors();
}

} // namespace
} // namespace burnish::vulkan
