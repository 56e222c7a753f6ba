#include "burnish/plan/map_lookup.h"
#include "burnish/render/environment_maps.h"
#include "burnish/sampler/prefilter_table.h"
#include "error_message.h"
#include "made_environments.h"
#include "shared/prefilter.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace burnish {
namespace {

// The nearest half to a float, ties to even (glm's packing rounds ties up).
float nearest_half(float value) {
    const double spacing = std::ldexp(1.0, std::max(std::ilogb(std::max(value, 1e-30f)), -14) - 10);
    return float(std::nearbyint(double(value) / spacing) * spacing);
}

const std::shared_ptr<const vulkan::Device>& device() {
    static const std::shared_ptr<const vulkan::Device> one = vulkan::Device::create();
    return one;
}

TEST(LookupChoice, TakesTexelBuffersBeforeStorageBuffersBeforeTheSampler) {
    const uint64_t pairs = cube_pair_count(16);
    const LookupChoice choice = choose_lookup(true, {}, pairs, 2 * pairs + 1);
    EXPECT_EQ(choice.of(16, 1), MapLookup::software);
    EXPECT_EQ(choice.of(16, 2), MapLookup::software_stored);
    EXPECT_EQ(choice.of(16, 3), MapLookup::sampler);
    EXPECT_EQ(choose_lookup(false, {}, pairs, pairs).of(16, 1), MapLookup::sampler);
    EXPECT_EQ(choose_lookup(false, MapLookup::software, pairs, pairs).of(16, 1), MapLookup::software);
}

TEST(LookupChoice, LeavesOursOnACpuWhereItIsMeasuredToTakeClearlyLonger) {
    const auto choose = [](bool is_software, double software_ms) {
        return choose_lookup(is_software, {}, 1, 1, LookupMeasurement{2, software_ms, "2026-01-02", "", ""});
    };
    EXPECT_EQ(choose(true, 1).wanted, MapLookup::software);
    EXPECT_EQ(choose(true, 2.18).wanted, MapLookup::software);
    EXPECT_EQ(choose(true, 2.22).wanted, MapLookup::sampler);
    EXPECT_DOUBLE_EQ(choose(true, 2.22).measured->ratio(), 1.11);
    EXPECT_TRUE(holds(choose(true, 2.22).reason, "1.11 x the sampler's time, measured on 2026-01-02"));
    EXPECT_EQ(choose(false, 1).wanted, MapLookup::sampler);
    const LookupChoice asked =
        choose_lookup(true, MapLookup::software, 1, 1, LookupMeasurement{1, 9, "", "", ""});
    EXPECT_EQ(asked.wanted, MapLookup::software);
    EXPECT_FALSE(asked.measured);
}

TEST(LookupChoice, KeepsOursOnACpuWhereNothingCouldBeMeasured) {
    const LookupChoice choice = choose_lookup(true, {}, 1, 1, LookupMeasurement{0, 0, "", "", "no memory"});
    EXPECT_EQ(choice.wanted, MapLookup::software);
    EXPECT_FALSE(choice.measured);
    EXPECT_TRUE(holds(choice.reason, "that could not be measured: no memory"));
}

TEST(EnvironmentMaps, StoreEachEnvironmentAsNearestHalves) {
    const std::vector<std::shared_ptr<const Environment>> environments{random_environment(16, 1),
                                                                       random_environment(16, 2)};
    MapTools tools(device());
    EnvironmentMaps maps(tools, environments, {.filter = PyramidFilter::gauss6, .kernel = {}});
    EXPECT_EQ(maps.count(), 2u);
    EXPECT_EQ(maps.face_size(), 16u);
    EXPECT_EQ(maps.level_count(), 5u);
    EXPECT_EQ(maps.image().layout(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_NE(maps.image().view_as(VK_IMAGE_VIEW_TYPE_CUBE_ARRAY), VK_NULL_HANDLE);
    for (uint32_t cube = 0; cube < 2; ++cube) {
        const std::vector<std::vector<float>> levels = maps.read_levels(cube);
        ASSERT_EQ(levels.size(), 5u);
        std::vector<float> expected = environments[cube]->radiance();
        for (float& value : expected)
            value = nearest_half(value);
        EXPECT_EQ(levels[0], expected);
        for (uint32_t level = 0; level < 5; ++level) {
            EXPECT_EQ(levels[level].size(), size_t{6} * (16u >> level) * (16u >> level) * 3);
        }
    }
}

TEST(EnvironmentMaps, ReportWhatUploadAndPyramidTook) {
    const auto environment = random_environment(64, 1);
    MapTools tools(device());
    const EnvironmentMaps maps(tools, std::span(&environment, 1),
                               {.filter = PyramidFilter::box, .kernel = {}});
    ASSERT_EQ(maps.pass_times().size(), 2u);
    EXPECT_EQ(maps.pass_times()[0].name, "upload");
    EXPECT_GT(maps.pass_times()[0].milliseconds, 0.0);
    EXPECT_EQ(maps.pass_times()[1].name, "pyramid");
    if (device()->features().timestamps) {
        EXPECT_GT(maps.pass_times()[1].milliseconds, 0.0);
    }
}

TEST(EnvironmentMaps, ArePrefilteredFromTheirPyramidsIfAskedTo) {
    const auto environment = random_environment(16, 1);
    MapTools tools(device());
    EnvironmentMaps maps(tools, std::span(&environment, 1),
                         {.filter = PyramidFilter::gauss6, .kernel = PrefilterKernel::lobe});
    ASSERT_EQ(maps.pass_times().size(), 3u);
    EXPECT_EQ(maps.pass_times()[2].name, "prefilter");
    EXPECT_EQ(maps.image().layout(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EnvironmentMaps plain(tools, std::span(&environment, 1), {.filter = PyramidFilter::gauss6, .kernel = {}});
    const auto levels = maps.read_levels(0), others = plain.read_levels(0);
    ASSERT_EQ(levels.size(), others.size());
    EXPECT_EQ(levels[0], others[0]);
    for (size_t level = 1; level < levels.size(); ++level) {
        EXPECT_NE(levels[level], others[level]) << "level " << level;
    }
}

TEST(PrefilterTable, HoldsWholePhasesOfSamplesAboveTheHorizon) {
    for (uint32_t level = 1; level <= 11; ++level) {
        const SampleTable table = build_prefilter_table(level, 2048);
        const size_t most = std::min<size_t>(size_t{64} << (level - 1), 1024);
        EXPECT_EQ(table.entries.size() % shared::PREFILTER_PHASE, 0u);
        EXPECT_LE(table.entries.size(), most);
        EXPECT_GE(table.entries.size(), level == 1 ? 64u : 100u) << "level " << level;
        for (const glm::vec4& entry : table.entries) {
            EXPECT_LT(entry.x * entry.x + entry.y * entry.y, 1.0f);
        }
    }
}

TEST(EnvironmentMaps, RefuseWhatDoesNotFitTogether) {
    MapTools tools(device());
    const auto make = [&](const std::vector<std::shared_ptr<const Environment>>& environments) {
        return message_of(
            [&] { EnvironmentMaps(tools, environments, {.filter = PyramidFilter::box, .kernel = {}}); });
    };
    const uint32_t most = device()->limits().maxImageArrayLayers / 6;
    const auto small = random_environment(2, 1);
    EXPECT_PRED2(holds, make({}), "environments: expected 1.." + std::to_string(most));
    EXPECT_PRED2(holds, make(std::vector(most + 1, small)), "got " + std::to_string(most + 1));
    EXPECT_PRED2(holds, make({small, nullptr}), "environments: expected environments, got none");
    EXPECT_PRED2(holds, make({small, random_environment(4, 1)}), "expected one face size, got 2 and 4");
    EXPECT_PRED2(holds, message_of([&] {
                     EnvironmentMaps(tools, std::span(&small, 1),
                                     {.filter = {}, .kernel = PrefilterKernel::lobe});
                 }),
                 "filter: expected one, from whose pyramid to prefilter, got none");
    EnvironmentMaps maps(tools, std::span(&small, 1), {.filter = PyramidFilter::box, .kernel = {}});
    EXPECT_EQ(message_of([&] { maps.read_levels(1); }), "cube: expected 0..0, got 1");
}

} // namespace
} // namespace burnish
