#include "burnish/scene/png16.h"

#include <gtest/gtest.h>

#include "burnish/error.h"

namespace burnish {
namespace {

void append_chunk(std::string& png, const std::string& name, const std::string& content) {
    const auto size = static_cast<uint8_t>(content.size());
    png += std::string{'\0', '\0', '\0', static_cast<char>(size)} + name + content + "none";
}

// One row of grey pixels, whose samples are stored, not deflated; checksums are nonsense.
std::string grey_png(char bits, uint8_t width, const std::string& row) {
    using namespace std::string_literals;
    const auto length = static_cast<char>(row.size() + 1);
    std::string png = "\x89PNG\r\n\x1a\n"s;
    append_chunk(png, "IHDR", "\0\0\0"s + static_cast<char>(width) + "\0\0\0\1"s + bits + "\0\0\0\0"s);
    append_chunk(png, "IDAT",
                 "\x78\x01\x01"s + length + '\0' + static_cast<char>(~length) + '\xff' + '\0' + row + "none");
    append_chunk(png, "IEND", "");
    return png;
}

std::span<const uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

std::string error_of(const std::string& png) {
    try {
        decode_png16("a.png", bytes_of(png));
    } catch (const FileError& error) {
        return error.what();
    }
    return "no error";
}

TEST(DecodePng16, SamplesAreWhole) {
    const Png16Image image = decode_png16("a.png", bytes_of(grey_png(16, 2, "\x12\x34\xff\xfe")));
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    EXPECT_EQ(image.channels, 1u);
    EXPECT_EQ(image.samples, (std::vector<uint16_t>{0x1234, 0xfffe}));
}

TEST(DecodePng16, OthersAreRefusedInWords) {
    EXPECT_EQ(error_of(grey_png(8, 2, "\x12\x34")),
              "a.png: PNG: expected 16 bits a channel, got others or a damaged header");
    EXPECT_EQ(error_of(""), "a.png: PNG: expected 16 bits a channel, got others or a damaged header");
    const std::string whole = grey_png(16, 2, "\x12\x34\xff\xfe");
    const std::string damaged = "a.png: PNG cannot be decoded, it is damaged or too large (";
    EXPECT_EQ(error_of(whole.substr(0, whole.size() - 24)).substr(0, damaged.size()), damaged);
    EXPECT_EQ(error_of(grey_png(16, 3, "\x12\x34\xff\xfe")).substr(0, damaged.size()), damaged);
}

} // namespace
} // namespace burnish
