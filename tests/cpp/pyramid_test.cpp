#include "burnish/render/environment_maps.h"
#include "burnish/vulkan/transfer.h"
#include "error_message.h"
#include "pyramid_reference.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <random>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

namespace burnish {
namespace {

Faces faces_of(uint32_t size, const std::function<glm::vec3(const glm::vec3&)>& radiance) {
    Faces faces(size_t{6} * size * size * 3);
    for (uint32_t face = 0; face < 6; ++face) {
        for (uint32_t row = 0; row < size; ++row) {
            for (uint32_t column = 0; column < size; ++column) {
                const float u = (2.0f * float(column) + 1.0f) / float(size) - 1.0f;
                const float v = (2.0f * float(row) + 1.0f) / float(size) - 1.0f;
                const glm::vec3 color = radiance(cube_direction(face, u, v));
                for (uint32_t k = 0; k < 3; ++k)
                    texel(faces, size, face, row, column, k) = color[int(k)];
            }
        }
    }
    return faces;
}

const std::shared_ptr<const vulkan::Device>& device() {
    static const std::shared_ptr<const vulkan::Device> one = vulkan::Device::create();
    return one;
}

std::vector<Faces> levels_of(uint32_t size, const Faces& faces, PyramidFilter filter) {
    const auto environment = std::make_shared<const Environment>(Environment::from_faces(size, faces));
    MapTools tools(device());
    EnvironmentMaps maps(tools, std::span(&environment, 1), {.filter = filter, .kernel = {}});
    return maps.read_levels(0);
}

std::string case_name(const testing::TestParamInfo<std::tuple<PyramidFilter, uint32_t>>& info) {
    return std::string(row_of(std::get<0>(info.param)).name) + "_" + std::to_string(std::get<1>(info.param));
}

class PyramidOfSize : public testing::TestWithParam<std::tuple<PyramidFilter, uint32_t>> {};
INSTANTIATE_TEST_SUITE_P(FilterAndFaceSize, PyramidOfSize,
                         testing::Combine(testing::Values(PyramidFilter::box, PyramidFilter::gauss4,
                                                          PyramidFilter::gauss6),
                                          testing::Values(1u, 2u, 4u, 8u, 64u, 256u)),
                         case_name);

// Stored is the half nearest to the float64 filter of the level above as stored. Sums of 36 terms in float32
// may be off by 2e-6 of their size, which is 1 % of half the distance of two halves.
TEST_P(PyramidOfSize, IsTheDirectFilterOfTheStoredLevelAbove) {
    const auto [filter, face_size] = GetParam();
    const std::vector<double> taps = taps_of(filter);
    const std::vector<Faces> levels = levels_of(face_size, random_faces(face_size, 7), filter);
    ASSERT_EQ(levels.size(), size_t(std::bit_width(face_size)));
    double worst = 0.0;
    for (size_t level = 1; level < levels.size(); ++level) {
        const uint32_t size = face_size >> level;
        const DirectFilter direct(levels[level - 1], 2 * size);
        Faces stored = levels[level];
        ASSERT_EQ(stored.size(), size_t{6} * size * size * 3);
        for (uint32_t face = 0; face < 6; ++face) {
            for (uint32_t row = 0; row < size; ++row) {
                for (uint32_t column = 0; column < size; ++column) {
                    const glm::dvec3 expected = direct.reduced(face, int(row), int(column), taps);
                    for (uint32_t k = 0; k < 3; ++k) {
                        const double got = double(texel(stored, size, face, row, column, k));
                        const double error =
                            std::abs(got - expected[int(k)]) / half_spacing(expected[int(k)]);
                        worst = std::max(worst, error);
                        ASSERT_LE(error, 0.505) << "level " << level << ", face " << face << ", row " << row
                                                << ", column " << column << ", channel " << k << ": got "
                                                << got << ", expected " << expected[int(k)];
                    }
                }
            }
        }
    }
    RecordProperty("worst_error_in_half_spacings", std::to_string(worst));
}

TEST_P(PyramidOfSize, KeepsAConstantMapExactly) {
    const auto [filter, face_size] = GetParam();
    for (const float value : {1.0f, float(half_of(0.1f)), 65504.0f, float(half_of(3.3e-5f)), 5.9604645e-8f}) {
        const Faces faces(size_t{6} * face_size * face_size * 3, value);
        for (const Faces& level : levels_of(face_size, faces, filter)) {
            EXPECT_TRUE(std::ranges::all_of(level, [&](float texel) { return texel == value; })) << value;
        }
    }
}

class PyramidOfFilter : public testing::TestWithParam<PyramidFilter> {};
INSTANTIATE_TEST_SUITE_P(Filter, PyramidOfFilter,
                         testing::Values(PyramidFilter::box, PyramidFilter::gauss4, PyramidFilter::gauss6),
                         [](const auto& one) { return std::string(row_of(one.param).name); });

// Stores that truncate would lose 3e-4 a level. Off the box filter, corners get a little more weight than
// other texels.
TEST_P(PyramidOfFilter, KeepsTheMean) {
    std::mt19937 generator(3);
    std::uniform_real_distribution<float> value(1.0f, 2.0f);
    Faces faces(size_t{6} * 256 * 256 * 3);
    for (float& f : faces)
        f = value(generator);
    const auto mean = [](const Faces& level) {
        double sum = 0.0;
        for (const float f : level)
            sum += double(f);
        return sum / double(level.size());
    };
    const std::vector<Faces> levels = levels_of(256, faces, GetParam());
    for (size_t level = 1; level + 2 < levels.size(); ++level) {
        EXPECT_NEAR(mean(levels[level]) / mean(levels[0]), 1.0, 1e-4) << "level " << level;
    }
}

// A function of direction alone has no seams, and must get none: on all 12 edges texels face each other
// across the edge with no larger a step than texels within faces, and so do the three texels at each of the 8
// corners.
TEST_P(PyramidOfFilter, KeepsASmoothMapSmoothAcrossEdgesAndCorners) {
    const auto radiance = [](const glm::vec3& d) {
        return glm::vec3(2.0f + d.x + d.y * d.z, 2.0f + d.y - d.x * d.z, 2.0f + d.z + 0.5f * d.x * d.x);
    };
    const uint32_t face_size = 64;
    std::vector<Faces> levels = levels_of(face_size, faces_of(face_size, radiance), GetParam());
    for (uint32_t level = 1; level + 2 < levels.size(); ++level) {
        const uint32_t size = face_size >> level;
        const auto color = [&](uint32_t face, uint32_t row, uint32_t column) {
            Faces& faces = levels[level];
            return glm::vec3(texel(faces, size, face, row, column, 0),
                             texel(faces, size, face, row, column, 1),
                             texel(faces, size, face, row, column, 2));
        };
        const auto step = [](const glm::vec3& a, const glm::vec3& b) {
            const glm::vec3 d = glm::abs(a - b);
            return std::max({d.x, d.y, d.z});
        };
        float inside = 0.0f;
        for (uint32_t face = 0; face < 6; ++face) {
            for (uint32_t i = 0; i < size; ++i) {
                for (uint32_t j = 0; j + 1 < size; ++j) {
                    inside = std::max({inside, step(color(face, i, j), color(face, i, j + 1)),
                                       step(color(face, j, i), color(face, j + 1, i))});
                }
            }
        }
        // Where a point half a texel beyond an edge lies, and the texel there.
        uint32_t crossings = 0;
        const auto expect_smooth = [&](uint32_t face, uint32_t row, uint32_t column, float u, float v) {
            float other_u = 0.0f, other_v = 0.0f;
            const uint32_t other = cube_face(cube_direction(face, u, v), other_u, other_v);
            ASSERT_NE(other, face);
            const auto index = [&](float at) {
                return std::min(uint32_t((at + 1.0f) / 2.0f * float(size)), size - 1);
            };
            ++crossings;
            EXPECT_LE(step(color(face, row, column), color(other, index(other_v), index(other_u))),
                      1.05f * inside)
                << "level " << level << ", face " << face << ", row " << row << ", column " << column;
        };
        const float beyond = 1.0f + 0.25f / float(size);
        for (uint32_t face = 0; face < 6; ++face) {
            for (uint32_t i = 0; i < size; ++i) {
                const float along = (2.0f * float(i) + 1.0f) / float(size) - 1.0f;
                expect_smooth(face, i, 0, -beyond, along);
                expect_smooth(face, i, size - 1, beyond, along);
                expect_smooth(face, 0, i, along, -beyond);
                expect_smooth(face, size - 1, i, along, beyond);
            }
        }
        EXPECT_EQ(crossings, 24 * size);
    }
}

vulkan::ImageSettings cube_settings(uint32_t face_size, uint32_t cubes) {
    vulkan::ImageSettings settings;
    settings.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    settings.width = settings.height = face_size;
    settings.levels = vulkan::full_levels(face_size, face_size);
    settings.layers = 6 * cubes;
    settings.is_cube = true;
    return settings;
}

TEST(Pyramid, MakesEachOfManyCubesAsIfAlone) {
    // 37 cubes are done as 32 + 4 + 1 where room is made for powers of two.
    const uint32_t face_size = 4, cube_count = 37;
    std::vector<std::shared_ptr<const Environment>> environments;
    for (uint32_t cube = 0; cube < cube_count; ++cube) {
        environments.push_back(std::make_shared<const Environment>(
            Environment::from_faces(face_size, random_faces(face_size, cube))));
    }
    MapTools tools(device());
    for (const PyramidFilter filter : {PyramidFilter::box, PyramidFilter::gauss6}) {
        EnvironmentMaps all(tools, environments, {.filter = filter, .kernel = {}});
        for (uint32_t cube = 0; cube < cube_count; ++cube) {
            EnvironmentMaps alone(tools, std::span(environments).subspan(cube, 1),
                                  {.filter = filter, .kernel = {}});
            EXPECT_EQ(all.read_levels(cube), alone.read_levels(0)) << "cube " << cube;
        }
    }
}

TEST(Pyramid, SplitsCubesThatNeedTooMuchRoomAtOnce) {
    const uint32_t face_size = 512; // 17 MB of room each, so 5 cubes are done as 2 + 2 + 1
    std::vector<std::shared_ptr<const Environment>> environments;
    for (uint32_t cube = 0; cube < 5; ++cube) {
        const Faces faces(size_t{6} * face_size * face_size * 3, float(cube + 1));
        environments.push_back(
            std::make_shared<const Environment>(Environment::from_faces(face_size, faces)));
    }
    MapTools tools(device());
    EnvironmentMaps maps(tools, environments, {.filter = PyramidFilter::gauss4, .kernel = {}});
    for (uint32_t cube = 0; cube < 5; ++cube) {
        for (const Faces& level : maps.read_levels(cube)) {
            EXPECT_EQ(*std::min_element(level.begin(), level.end()), float(cube + 1));
            EXPECT_EQ(*std::max_element(level.begin(), level.end()), float(cube + 1));
        }
    }
}

TEST(Pyramid, LeavesOtherCubesAndTheGeneralLayoutAlone) {
    vulkan::Image cubes(device(), cube_settings(4, 3));
    Pyramid pyramid(device());
    vulkan::Commands commands(device());
    commands.transition(cubes, VK_IMAGE_LAYOUT_GENERAL);
    commands.clear_color_image(cubes, {{5.0f, 5.0f, 5.0f, 1.0f}});
    commands.barrier();
    commands.submit();
    vulkan::ImageRegion finest;
    finest.base_layer = 6;
    finest.layer_count = 6;
    const std::vector<uint16_t> twos(6 * 4 * 4 * 4, glm::packHalf1x16(2.0f));
    vulkan::upload(cubes, finest, std::as_bytes(std::span(twos)), VK_IMAGE_LAYOUT_GENERAL);
    vulkan::Commands more(device());
    pyramid.record(more, cubes, 1, 1, PyramidFilter::gauss6);
    more.submit();
    EXPECT_EQ(cubes.layout(), VK_IMAGE_LAYOUT_GENERAL);
    for (uint32_t cube = 0; cube < 3; ++cube) {
        vulkan::ImageRegion coarsest;
        coarsest.level = 2;
        coarsest.base_layer = 6 * cube;
        coarsest.layer_count = 6;
        const std::vector<std::byte> bytes = vulkan::read_back(cubes, coarsest);
        const float red = glm::unpackHalf1x16(*reinterpret_cast<const uint16_t*>(bytes.data()));
        EXPECT_EQ(red, cube == 1 ? 2.0f : 5.0f) << "cube " << cube;
    }
}

std::string refusal(vulkan::Image& cubes, uint32_t first_cube, uint32_t cube_count) {
    Pyramid pyramid(device());
    vulkan::Commands commands(device());
    return message_of([&] { pyramid.record(commands, cubes, first_cube, cube_count, PyramidFilter::box); });
}

TEST(Pyramid, RefusesImagesThatItCannotFilter) {
    vulkan::Image undefined(device(), cube_settings(4, 2));
    EXPECT_PRED2(holds, refusal(undefined, 0, 2), "level 0 written, got one in layout UNDEFINED");
    EXPECT_PRED2(holds, refusal(undefined, 0, 0),
                 "expected 1 or more of the image's 2 cubes, got 0 from cube 0");
    EXPECT_PRED2(holds, refusal(undefined, 1, 2), "got 2 from cube 1");

    vulkan::ImageSettings settings = cube_settings(4, 1);
    settings.format = VK_FORMAT_R32G32B32A32_SFLOAT;
    vulkan::Image other_format(device(), settings);
    EXPECT_PRED2(holds, refusal(other_format, 0, 1), "expected a cube array of RGBA16F");
    settings = cube_settings(4, 1);
    settings.levels = 2;
    vulkan::Image too_few_levels(device(), settings);
    EXPECT_PRED2(holds, refusal(too_few_levels, 0, 1), "got cubes of");
    settings = cube_settings(4, 1);
    settings.is_cube = false;
    vulkan::Image no_cube(device(), settings);
    EXPECT_PRED2(holds, refusal(no_cube, 0, 1), "got no cubes of");
    settings = cube_settings(6, 1);
    vulkan::Image no_power_of_two(device(), settings);
    EXPECT_PRED2(holds, refusal(no_power_of_two, 0, 1), "6 x 6");
}

} // namespace
} // namespace burnish
