// What shaders say about themselves, and what is bound to them.
#include "vulkan_support.h"

#include "spirv/probe_resource_kinds_comp.h"

#include <array>
#include <tuple>

namespace burnish::vulkan {
namespace {

TEST(DescriptorSets, UnwrittenBindingNamesPipelineAndBinding) {
    const auto device = Device::create();
    const CopyWords probe(device);
    DescriptorSet set(probe.pipeline);
    set.bind(0, probe.source);
    Commands commands(device);
    const std::string text = error_text<std::logic_error>(
        [&] { commands.dispatch(probe.pipeline, set, push_bytes(probe.push), 1); });
    expect_contains(text, "probe/copy_words.comp");
    expect_contains(text, "got none at 1");
}

TEST(DescriptorSets, WrongNumberOrKindIsRefused) {
    const auto device = Device::create();
    const CopyWords probe(device);
    DescriptorSet set(probe.pipeline);
    const Image image(device, {.format = VK_FORMAT_R32_SFLOAT, .usage = VK_IMAGE_USAGE_STORAGE_BIT});
    expect_contains(error_text<std::invalid_argument>([&] { set.bind(5, probe.source); }), "got 5");
    expect_contains(error_text<std::invalid_argument>([&] { set.bind_storage_image(0, image.view()); }),
                    "got another kind");
}

TEST(DescriptorSets, PoolsGrowAndAreUsedAgain) {
    const auto device = Device::create();
    const CopyWords probe(device);
    for (int round = 0; round < 3; ++round) {
        std::vector<DescriptorSet> sets;
        for (int i = 0; i < 300; ++i)
            sets.emplace_back(probe.pipeline);
    }
    EXPECT_LE(device->descriptors().pool_count(), 6u);
}

TEST(Reflection, FindsEveryKindOfResource) {
    const ShaderReflection found = reflect(probe_resource_kinds_comp_spv, "probe/resource_kinds.comp");
    EXPECT_EQ(found.push_constant_bytes, 76u);
    EXPECT_EQ(found.local_size, (std::array<uint32_t, 3>{4, 2, 1}));
    const std::vector<std::tuple<uint32_t, VkDescriptorType, uint32_t, std::string>> expected = {
        {1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, "Settings"},
        {3, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, "cubes"},
        {4, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2, "pictures"},
        {5, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, "picture_out"},
        {6, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, "texels_in"},
        {7, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, 1, "texels_out"},
        {9, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, "Results"}};
    ASSERT_EQ(found.bindings.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const ShaderBinding& one = found.bindings[i];
        EXPECT_EQ(std::tuple(one.binding, one.type, one.count, one.name), expected[i]);
    }
    expect_contains(error_text<std::invalid_argument>([] {
                        reflect(std::vector<uint32_t>{1, 2, 3}, "x");
                    }),
                    "x: expected SPIR-V words");
}

TEST(DescriptorSets, EveryKindOfResourceBindsAndRuns) {
    const auto device = Device::create();
    const Shader shader(device, "probe/resource_kinds.comp", probe_resource_kinds_comp_spv);
    const ComputePipeline pipeline(device, shader);
    const ImageSettings rgba{.format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = 4, .height = 4};
    ImageSettings cube_settings = rgba, out_settings = rgba;
    cube_settings.layers = 12;
    cube_settings.is_cube = true;
    out_settings.usage = VK_IMAGE_USAGE_STORAGE_BIT;
    Image cubes(device, cube_settings), picture(device, rgba), out(device, out_settings);
    const Sampler sampler(device, {});
    const Buffer settings(device, 16, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::upload);
    const float offset[4] = {1, 2, 3, 4};
    upload(settings, std::as_bytes(std::span(offset)), 0, TransferSettings{});
    const std::vector<int32_t> tens(8, 10);
    const Buffer texels_in =
        make_buffer(device, std::as_bytes(std::span(tens)), VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    const Buffer texels_out(device, 32, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    const Buffer results(device, 8 * 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    const TexelView in_view = texel_view(texels_in, VK_FORMAT_R32_SINT);
    const TexelView out_view = texel_view(texels_out, VK_FORMAT_R32_UINT);

    DescriptorSet set(pipeline);
    set.bind(1, settings).bind(3, cubes.view(), sampler).bind(9, results);
    set.bind(4, picture.view(), sampler, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0);
    set.bind(4, picture.view(), sampler, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 1);
    set.bind_storage_image(5, out.level_view(0));
    set.bind_texel_buffer(6, in_view).bind_texel_buffer(7, out_view);

    std::array<float, 19> push{};
    for (std::size_t i : {0u, 5u, 10u, 15u})
        push[i] = 1;         // identity
    push[16] = push[17] = 2; // scale
    push[18] = 0.5f;         // bias
    Commands commands(device);
    commands.clear_color_image(cubes, {{100, 0, 0, 0}});
    commands.clear_color_image(picture, {{0, 1000, 0, 0}});
    commands.transition(cubes, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.transition(picture, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.transition(out, VK_IMAGE_LAYOUT_GENERAL);
    commands.dispatch(pipeline, set, push_bytes(push), 1);
    commands.submit();

    // x: (100 + 10) 2 + 1 + 0.5; y: (2 * 1000) 2 + 2.5; z: 3.5; w: 1 + 4.5. The texel's w is 1, the clear's
    // 0.
    const std::vector<std::byte> bytes = read_back(results);
    std::array<float, 4> first{};
    std::memcpy(first.data(), bytes.data(), sizeof(first));
    EXPECT_EQ(first, (std::array<float, 4>{221.5f, 4002.5f, 3.5f, 5.5f}));
    EXPECT_EQ(words_of(texels_out), std::vector<uint32_t>(8, 221));
    const std::vector<std::byte> drawn = read_back(out, {});
    EXPECT_EQ(std::memcmp(drawn.data(), bytes.data(), 16), 0);
}

} // namespace
} // namespace burnish::vulkan
