// The matched sampler's tables, and suns taken out of maps.
#include <cmath>

#include <gtest/gtest.h>

#include "burnish/light/sun_split.h"
#include "burnish/lobe/lobe.h"
#include "burnish/sampler/matched_table.h"
#include "burnish/sampler/matched_view_table.h"
#include "burnish/sampler/prefilter_table.h"
#include "burnish/sampler/sampler.h"
#include "shared/constants.h"

namespace burnish {
namespace {

LobeShape kurt_shape(float x, float y) {
    return facts(KurtLobe{.roughness = {x, y}}).shape;
}

/// A dielectric of each model.
std::vector<LobeShape> dielectrics() {
    const glm::vec3 r0(0.04f);
    return {facts(KurtLobe{.roughness = glm::vec2(0.2f), .r0 = r0, .alpha = 0.5f}).shape,
            facts(GgxLobe{.roughness = glm::vec2(0.2f), .r0 = r0}).shape};
}

TEST(MatchedTable, WeightsOfEveryRowSumToOne) {
    for (const MixtureTable table : {MixtureTable{}, MixtureTable{Density::student, 0},
                                     MixtureTable{Density::student, 1}, MixtureTable{Density::student, 2}})
        for (const uint32_t count : MATCHED_COUNTS) {
            const std::vector<glm::vec4> rows = matched_mixtures(count, table);
            const uint32_t half = (count + 1) / 2;
            ASSERT_EQ(rows.size(), size_t(shared::MATCHED_ROWS) * half);
            for (uint32_t row = 0; row < shared::MATCHED_ROWS; ++row) {
                double sum = 0.0;
                for (uint32_t k = 0; k < half; ++k)
                    sum += (count % 2 && k == 0 ? 1.0 : 2.0) * double(rows[row * half + k].w);
                EXPECT_NEAR(sum, 1.0, 5e-5) << count << " samples, row " << row;
            }
        }
}

TEST(MatchedTable, RowsAreEvenInTheLogOfTheAspect) {
    EXPECT_EQ(matched_row(1.0), 0u);
    EXPECT_EQ(matched_row(100.0), shared::MATCHED_ROWS - 1);
    EXPECT_EQ(matched_row(1000.0), shared::MATCHED_ROWS - 1);
    EXPECT_NEAR(matched_row(10.0), (shared::MATCHED_ROWS - 1) / 2.0, 1.0);
}

TEST(MatchedViewTable, AViewAlongTheNormalReflectsAroundIt) {
    for (const LobeShape& shape : dielectrics()) {
        const MatchedLobe lobe{8, shape, true, 64};
        const std::vector<glm::vec4> table = build_matched_view_table(lobe).entries;
        const uint32_t entries = view_row_entries(lobe);
        ASSERT_EQ(entries, 10u);
        ASSERT_EQ(table.size(), size_t(shared::MATCHED_ROWS) * entries);
        glm::vec2 mean(0.0f);
        float weights = 0.0f;
        for (uint32_t k = 0; k < 8; ++k) {
            mean += table[k].z * glm::vec2(table[k]);
            weights += table[k].z;
            EXPECT_GT(table[k].z, 0.0f);
            EXPECT_GE(table[k].w, 0.0f);
        }
        EXPECT_NEAR(glm::length(mean), 0.0f, 1e-4f * weights) << shape.model->name;
    }
}

/// First entry of a row of a brushed lobe's table.
const glm::vec4* row_at(const std::vector<glm::vec4>& table, const MatchedLobe& lobe, int x, int y) {
    const int last = int(shared::MATCHED_VIEW_NODES) - 1;
    return &table[size_t(y * int(view_columns(lobe)) + x + last) * view_row_entries(lobe)];
}

TEST(MatchedViewTable, ViewsFromBothSidesAlongAnAxisHaveTheSameSamples) {
    const MatchedLobe lobe{.samples = 7, .shape = kurt_shape(0.2f, 0.075f)};
    const std::vector<glm::vec4> table = build_matched_view_table(lobe).entries;
    const size_t nodes = shared::MATCHED_VIEW_NODES;
    ASSERT_EQ(table.size(), nodes * (2 * nodes - 1) * view_row_entries(lobe));
    for (const int x : {1, 20, 60, 127}) {
        const glm::vec4 *first_row = row_at(table, lobe, x, 0), *last_row = row_at(table, lobe, -x, 0);
        // The lobe's axes point the other way, and the two components of a pair have changed places.
        for (uint32_t k = 1; k < 7; k += 2)
            for (uint32_t j = 0; j < 2; ++j) {
                const glm::vec4 one = first_row[k + j], other = last_row[k + 1 - j];
                const bool is_same = glm::distance(one, last_row[k + j] * glm::vec4(-1, -1, 1, 1)) < 1e-5f;
                EXPECT_TRUE(is_same || glm::distance(one, other * glm::vec4(-1, -1, 1, 1)) < 1e-5f)
                    << "view " << x << ", sample " << k + j;
            }
    }
}

TEST(MatchedViewTable, ABarelyBrushedLobeHasTheRoundOnesWeights) {
    const MatchedLobe round{.samples = 5, .shape = kurt_shape(0.3f, 0.3f)};
    MatchedLobe brushed = round;
    brushed.shape.width_x = 0.3001f;
    const std::vector<glm::vec4> one = build_matched_view_table(round).entries,
                                 other = build_matched_view_table(brushed).entries;
    const double radius = 67.0 / (shared::MATCHED_VIEW_NODES - 1); // between two rows of the round lobe
    const uint32_t row = uint32_t(radius * (shared::MATCHED_ROWS - 1) + 0.5);
    for (const glm::ivec2 node : {glm::ivec2(67, 0), {67, 33}, {20, 67}, {0, 67}})
        for (uint32_t k = 0; k < 5; ++k) {
            const glm::vec4 expected = one[row * 5 + k];
            const glm::vec4 actual = row_at(other, brushed, node.x, node.y)[k];
            EXPECT_NEAR(actual.z, expected.z, 5e-3f * expected.z)
                << "node " << node.x << ", " << node.y << ", sample " << k;
            EXPECT_NEAR(actual.w, expected.w, 2e-2f);
            EXPECT_NEAR(glm::length(glm::vec2(actual)), glm::length(glm::vec2(expected)), 2e-3f);
        }
}

TEST(MatchedViewTable, RowsAroundTheNormalDifferLittle) {
    const MatchedLobe lobe{.samples = 14, .shape = kurt_shape(0.99f, 0.124f)};
    const std::vector<glm::vec4> table = build_matched_view_table(lobe).entries;
    const auto change = [&](int x, int y, int dx, int dy) {
        const glm::vec4 *one = row_at(table, lobe, x, y), *other = row_at(table, lobe, x + dx, y + dy);
        float largest = 0.0f;
        for (uint32_t k = 0; k < lobe.samples; ++k)
            if (one[k].z > 0.0f && other[k].z > 0.0f) // one below the horizon has no place
                largest = std::max(largest, glm::length(glm::vec2(one[k] - other[k])));
        return largest;
    };
    for (int y = 0; y < 20; ++y)
        for (int x = -20; x < 20; ++x) {
            EXPECT_LT(change(x, y, 1, 0), 0.1f) << x << ", " << y;
            EXPECT_LT(change(x, y, 0, 1), 0.1f) << x << ", " << y;
        }
}

TEST(MatchedViewTable, LevelsBelowTheFirstShareItsVariance) {
    const double first = 16.0 * 0.85 / (256.0 * 256.0);
    EXPECT_FLOAT_EQ(spherical_level(first, 256), 1.0f);
    EXPECT_FLOAT_EQ(spherical_level(first / 2.0, 256), 0.5f);
    EXPECT_FLOAT_EQ(spherical_level(4.0 * first, 256), 2.0f);
}

std::vector<float> map_of(uint32_t size, float radiance) {
    return std::vector<float>(size_t(18) * size * size, radiance);
}

TEST(SunSplit, TakesOutWhatItPutIn) {
    const uint32_t size = 64;
    std::vector<float> radiance = map_of(size, 0.5f);
    const size_t texel = (4 * size + 20) * size + 40; // face +z
    for (int c = 0; c < 3; ++c)
        radiance[3 * texel + c] = 10000.5f;
    const SunSplit split = split_suns({size, radiance});
    ASSERT_EQ(split.suns.size(), 1u);
    EXPECT_EQ(split.radiance, map_of(size, 0.5f));
    const double solid_angle = texel_solid_angles(size)[20 * size + 40];
    EXPECT_NEAR(split.suns[0].flux.x, 10000.0 * solid_angle, 1e-3 * solid_angle);
    const double u = 81.0 / size - 1.0, v = 41.0 / size - 1.0;
    const glm::dvec3 expected = glm::normalize(glm::dvec3(u, -v, 1.0));
    EXPECT_NEAR(glm::dot(split.suns[0].direction, expected), 1.0, 1e-9);
}

TEST(SunSplit, LeavesWideAndFaintLightsAlone) {
    const uint32_t size = 64;
    std::vector<float> wide = map_of(size, 0.5f), faint = map_of(size, 0.5f);
    for (uint32_t row = 10; row < 30; ++row)
        for (uint32_t column = 10; column < 30; ++column)
            wide[3 * ((2 * size + row) * size + column)] = 20000.0f;
    faint[3 * 100] = 40.0f;
    EXPECT_TRUE(split_suns({size, wide}).suns.empty());
    EXPECT_TRUE(split_suns({size, faint}).suns.empty());
    EXPECT_TRUE(split_suns({size, map_of(size, 0.0f)}).suns.empty());
    EXPECT_TRUE(split_suns({1, map_of(1, 1.0f)}).suns.empty());
}

} // namespace
} // namespace burnish
