#include "burnish/light/hdr.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "burnish/error.h"

namespace burnish {
namespace {

// Writes bytes to a file of the test's own that goes away with it.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& bytes) {
        std::string name = (std::filesystem::temp_directory_path() / "burnish-hdr-XXXXXX").string();
        const int file = mkstemp(name.data());
        path = name;
        std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        if (file >= 0) {
            ::close(file);
        }
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::string path;
};

HdrImage read_bytes(const std::string& bytes) {
    const TemporaryFile file(bytes);
    return read_hdr(file.path);
}

std::string hdr_error(const std::string& bytes) {
    try {
        read_bytes(bytes);
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}

const std::string HEADER = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

// A pixel of grey level mantissa / 256.
std::string grey(uint8_t mantissa) {
    const char c = static_cast<char>(mantissa);
    return {c, c, c, static_cast<char>(128)};
}

TEST(ReadHdr, FlatAndOldRleAndNewRleGiveTheSame) {
    const std::string flat = HEADER + "-Y 1 +X 10\n" + grey(7) + grey(7) + grey(7) + grey(7) + grey(7) +
                             grey(7) + grey(7) + grey(7) + grey(7) + grey(9);
    const std::string repeat = {1, 1, 1, 8};
    const std::string old_rle = HEADER + "-Y 1 +X 10\n" + grey(7) + repeat + grey(9);
    std::string new_rle = HEADER + "-Y 1 +X 10\n" + std::string("\x02\x02\x00\x0a", 4);
    for (int plane = 0; plane < 3; ++plane) {
        new_rle += std::string("\x89\x07\x01\x09", 4);
    }
    new_rle += "\x8a\x80";
    const HdrImage image = read_bytes(flat);
    EXPECT_EQ(image.width, 10u);
    EXPECT_EQ(image.height, 1u);
    EXPECT_FLOAT_EQ(image.radiance[0], 7.0f / 256.0f);
    EXPECT_FLOAT_EQ(image.radiance[29], 9.0f / 256.0f);
    EXPECT_EQ(read_bytes(old_rle).radiance, image.radiance);
    EXPECT_EQ(read_bytes(new_rle).radiance, image.radiance);
}

TEST(ReadHdr, EveryOrientationComesOutTopDown) {
    // The picture, top-down: 1 2 3 / 4 5 6.
    const std::array<std::pair<std::string, std::array<uint8_t, 6>>, 8> cases = {
        {{"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}},
         {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}},
         {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}},
         {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}},
         {"+X 3 -Y 2", {1, 4, 2, 5, 3, 6}},
         {"-X 3 -Y 2", {3, 6, 2, 5, 1, 4}},
         {"+X 3 +Y 2", {4, 1, 5, 2, 6, 3}},
         {"-X 3 +Y 2", {6, 3, 5, 2, 4, 1}}}};
    for (const auto& [resolution, stored] : cases) {
        std::string bytes = HEADER + resolution + "\n";
        for (const uint8_t value : stored) {
            bytes += grey(static_cast<uint8_t>(16 * value));
        }
        const HdrImage image = read_bytes(bytes);
        ASSERT_EQ(image.width, 3u) << resolution;
        ASSERT_EQ(image.height, 2u) << resolution;
        for (size_t i = 0; i < 6; ++i) {
            EXPECT_FLOAT_EQ(image.radiance[3 * i], static_cast<float>(i + 1) / 16.0f)
                << resolution << " texel " << i;
        }
    }
}

TEST(ReadHdr, HeadersOfOtherWritersAreRead) {
    const std::string pixel = grey(128);
    const std::string photoshop = "#?RADIANCE\r\n# Made with Adobe Photoshop\r\n#?RADIANCE\r\nGAMMA=1\r\n"
                                  "PRIMARIES=0 0 0 0 0 0 0 0\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 1\r\n";
    EXPECT_FLOAT_EQ(read_bytes(photoshop + pixel).radiance[0], 0.5f);
    const std::string exposed = "#?RGBE\nEXPOSURE=2\nEXPOSURE= 4.0\nCOLORCORR= 1 2 4\n\n-Y 1 +X 1\n";
    const HdrImage image = read_bytes(exposed + pixel);
    EXPECT_FLOAT_EQ(image.radiance[0], 0.5f / 8.0f);
    EXPECT_FLOAT_EQ(image.radiance[1], 0.5f / 16.0f);
    EXPECT_FLOAT_EQ(image.radiance[2], 0.5f / 32.0f);
    const std::string squared = "#?RGBE\nGAMMA=2\nEXPOSURE=4\nPIXASPECT=.5\nPIXASPECT=4\n"
                                "PRIMARIES=.64 .33 .3 .6 .15 .06 .3127 .329\n\n-Y 1 +X 1\n";
    const HdrImage corrected = read_bytes(squared + pixel);
    EXPECT_FLOAT_EQ(corrected.radiance[0], 0.25f / 4.0f);
    EXPECT_EQ(corrected.pixel_aspect, 2.0);
    EXPECT_EQ(corrected.primaries, (std::vector<double>{.64, .33, .3, .6, .15, .06, .3127, .329}));
    EXPECT_EQ(read_bytes("#?RGBE\nPRIMARIES=1 nonsense\n\n-Y 1 +X 1\n" + pixel).primaries.size(), 8u);
    const std::string xyz = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
    const std::string white = {static_cast<char>(122), static_cast<char>(128), static_cast<char>(139),
                               static_cast<char>(128)};
    for (const float value : read_bytes(xyz + white).radiance) { // D65 white of luminance 0.5
        EXPECT_NEAR(value, 0.5f, 0.01f);
    }
}

TEST(ReadHdr, BrokenFilesAreRefusedInWords) {
    const std::array<std::pair<std::string, std::string>, 11> cases = {{
        {"#?RADIANCE\nGAMMA=0\n\n", "GAMMA: expected a number in 0.1..10, got '0'"},
        {"#?RADIANCE\nPIXASPECT=-1\n\n", "PIXASPECT: expected a positive number in 1e-30..1e30, got '-1'"},
        {"", "got the end of the file in the header"},
        {"hello\n", "expected a Radiance picture starting with '#?', got 'hello'"},
        {"#?RADIANCE\nFORMAT=float\n\n", "FORMAT: expected 32-bit_rle_rgbe or 32-bit_rle_xyze, got 'float'"},
        {"#?RADIANCE\nEXPOSURE=0\n\n", "EXPOSURE: expected a positive number in 1e-30..1e30, got '0'"},
        {HEADER + "-Y4 +X8888888A'8\n", "sizes in 1..1000000, got '-Y4 +X8888888A'8'"},
        {HEADER + "-Y 1000000 +X 1000000\n",
         "expected at most 268435456 pixels, got 1000000 scanlines of 1000000"},
        {HEADER + "-Y 1000 +X 1000\n" + grey(5),
         "expected at least 8000 bytes for 1000 scanlines of 1000 pixels, got 4"},
        {HEADER + "-Y 2 +X 3\n" + grey(5) + grey(5) + grey(5) + grey(5) + grey(5),
         "scanline 1 of 2: expected 3 pixels, got the end of the file after 2"},
        {HEADER + "-Y 1 +X 10\n" + std::string("\x02\x02\x00\x0a\xff\x07\x00\x00", 8),
         "scanline 0 of 1: expected 10 bytes in channel 0, got a broken run after 0"},
    }};
    for (const auto& [bytes, expected] : cases) {
        EXPECT_NE(hdr_error(bytes).find(expected), std::string::npos) << hdr_error(bytes);
    }
    EXPECT_THROW(read_hdr("/nonexistent/sky.hdr"), FileError);
    EXPECT_THROW(read_hdr("/"), FileError);
}

} // namespace
} // namespace burnish
