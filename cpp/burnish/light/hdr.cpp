// Radiance pictures: a text header, a resolution line, then scanlines of shared-exponent pixels. A scanline
// is stored in one of three ways, told apart by its first four bytes:
//   new RLE   2 2 and the length in two bytes, then four planes of runs; lengths 8..32767 only
//   old RLE   four bytes a pixel, where 1 1 1 n repeats the last pixel n times; directly after another
//   repeat, 256 n times flat      old RLE without repeats
#include "burnish/light/hdr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <span>

#include "burnish/error.h"
#include "burnish/light/hdr_header.h"

namespace burnish {

namespace {

// 256 megapixels are 3.2 GB of floats, and twice the maps of 16384 x 8192 that shops sell.
constexpr uint64_t MAX_PIXELS = uint64_t{1} << 28;
// No picture of MAX_PIXELS is larger: four bytes a pixel, a few per cent of run marks, and the header.
constexpr uint64_t MAX_FILE_BYTES = 5 * MAX_PIXELS;

using Pixel = std::array<uint8_t, 4>; // red, green, blue mantissas (or X, Y, Z) and the exponent

class HdrReader {
public:
    HdrReader(const std::string& path, std::span<const uint8_t> bytes) : path_(path), bytes_(bytes) {}

    HdrImage read() {
        const HdrHeader header = parse_hdr_header(path_, bytes_);
        position_ = header.size_bytes;
        fast_ = header.fast;
        const HdrAxis& slow = header.slow;
        HdrImage image;
        image.is_xyz = header.is_xyz;
        image.divisor = header.divisor;
        image.gamma = header.gamma;
        image.pixel_aspect = header.pixel_aspect;
        image.primaries = header.primaries;
        image.width = slow.is_x ? slow.size : fast_.size;
        image.height = slow.is_x ? fast_.size : slow.size;
        check_size(slow.size, fast_.size);
        image.radiance.resize(size_t{3} * image.width * image.height);
        std::vector<Pixel> scanline(fast_.size);
        const std::array<float, 256> scales = make_scales();
        const glm::vec3 factor(1.0 / header.divisor);
        for (uint32_t i = 0; i < slow.size; ++i) {
            read_scanline(i, slow.size, scanline);
            store_scanline(scanline, i, header, scales, factor, image);
        }
        return image;
    }

private:
    [[noreturn]] void fail(const std::string& reason) const { throw FileError(path_, reason); }

    void check_size(uint32_t scanline_count, uint32_t scanline_size) const {
        const uint64_t pixel_count = uint64_t{scanline_count} * scanline_size;
        if (pixel_count > MAX_PIXELS) {
            fail(message("expected at most ", MAX_PIXELS, " pixels, got ", scanline_count, " scanlines of ",
                         scanline_size));
        }
        // The tightest scanline is one pixel and one repeat.
        const uint64_t needed = uint64_t{scanline_count} * (scanline_size > 1 ? 8 : 4);
        if (bytes_left() < needed) {
            fail(message("expected at least ", needed, " bytes for ", scanline_count, " scanlines of ",
                         scanline_size, " pixels, got ", bytes_left()));
        }
    }

    uint64_t bytes_left() const { return bytes_.size() - std::min<uint64_t>(position_, bytes_.size()); }

    void read_scanline(uint32_t index, uint32_t count, std::span<Pixel> scanline) {
        const auto where = [&] { return message("scanline ", index, " of ", count); };
        const size_t width = scanline.size();
        const uint8_t* next = bytes_.data() + position_;
        if (width >= 8 && width < 32768 && bytes_left() >= 4 && next[0] == 2 && next[1] == 2 &&
            next[2] < 128) {
            const size_t declared = (size_t{next[2]} << 8) | next[3];
            if (declared != width) {
                fail(message(where(), ": expected ", width, " pixels, got a run-length mark for ", declared));
            }
            position_ += 4;
            for (size_t plane = 0; plane < 4; ++plane) {
                read_plane(plane, scanline, where);
            }
        } else {
            read_pixels(scanline, where);
        }
    }

    template <typename Where>
    void read_plane(size_t plane, std::span<Pixel> scanline, const Where& where) {
        const uint8_t* next = bytes_.data() + position_;
        const uint8_t* const end = bytes_.data() + bytes_.size();
        size_t filled = 0;
        while (filled < scanline.size()) {
            const size_t code = next < end ? *next++ : 0;
            const bool is_run = code > 128;
            const size_t length = is_run ? code - 128 : code;
            const size_t stored = is_run ? 1 : length;
            if (length == 0 || length > scanline.size() - filled ||
                stored > static_cast<size_t>(end - next)) {
                fail(message(where(), ": expected ", scanline.size(), " bytes in channel ", plane, ", got ",
                             next == end || stored > static_cast<size_t>(end - next)
                                 ? "the end of the file after "
                                 : "a broken run after ",
                             filled));
            }
            for (size_t i = 0; i < length; ++i) {
                scanline[filled + i][plane] = is_run ? *next : next[i];
            }
            next += stored;
            filled += length;
        }
        position_ = static_cast<size_t>(next - bytes_.data());
    }

    template <typename Where>
    void read_pixels(std::span<Pixel> scanline, const Where& where) {
        size_t filled = 0;
        uint32_t repeat_shift = 0;
        while (filled < scanline.size()) {
            if (bytes_left() < 4) {
                fail(message(where(), ": expected ", scanline.size(),
                             " pixels, got the end of the file after ", filled));
            }
            Pixel pixel;
            std::copy_n(bytes_.data() + position_, 4, pixel.begin());
            position_ += 4;
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                scanline[filled++] = pixel;
                repeat_shift = 0;
                continue;
            }
            const size_t length = repeat_shift < 24 ? size_t{pixel[3]} << repeat_shift : scanline.size() + 1;
            if (filled == 0 || length > scanline.size() - filled) {
                fail(message(where(), ": expected ", scanline.size(), " pixels, got a repeat of ", length,
                             " after ", filled));
            }
            std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(filled), length, scanline[filled - 1]);
            filled += length;
            repeat_shift += 8;
        }
    }

    // value = mantissa 2^(exponent - 136); exponent 0 is black.
    static std::array<float, 256> make_scales() {
        std::array<float, 256> scales{};
        for (int exponent = 1; exponent < 256; ++exponent) {
            scales[static_cast<size_t>(exponent)] = std::ldexp(1.0f, exponent - 136);
        }
        return scales;
    }

    void store_scanline(std::span<const Pixel> scanline, uint32_t index, const HdrHeader& header,
                        const std::array<float, 256>& scales, const glm::vec3& factor,
                        HdrImage& image) const {
        const HdrAxis& slow = header.slow;
        const auto gamma = static_cast<float>(header.gamma);
        // CIE XYZ to linear Rec. 709 with white D65, columns as GLM has them (IEC 61966-2-1, inverted).
        const glm::mat3 rgb_from_xyz(3.2404542f, -0.9692660f, 0.0556434f, -1.5371385f, 1.8760108f,
                                     -0.2040259f, -0.4985314f, 0.0415560f, 1.0572252f);
        for (uint32_t j = 0; j < fast_.size; ++j) {
            const HdrAxis& axis_x = slow.is_x ? slow : fast_;
            const HdrAxis& axis_y = slow.is_x ? fast_ : slow;
            const uint32_t x = slow.is_x ? index : j;
            const uint32_t y = slow.is_x ? j : index;
            // x grows to the right, y upward: -Y means that the first row is the top one.
            const size_t column = axis_x.is_increasing ? x : axis_x.size - 1 - x;
            const size_t row = axis_y.is_increasing ? axis_y.size - 1 - y : y;
            const Pixel& pixel = scanline[j];
            glm::vec3 value = scales[pixel[3]] * glm::vec3(pixel[0], pixel[1], pixel[2]);
            if (gamma != 1.0f) {
                value = glm::pow(value, glm::vec3(gamma));
            }
            value *= factor;
            if (header.is_xyz) {
                value = rgb_from_xyz * value;
            }
            float* stored = image.radiance.data() + 3 * (row * image.width + column);
            stored[0] = value.x;
            stored[1] = value.y;
            stored[2] = value.z;
        }
    }

    const std::string& path_;
    std::span<const uint8_t> bytes_;
    size_t position_ = 0;
    HdrAxis fast_;
};

} // namespace

HdrImage decode_hdr(const std::string& name, std::span<const uint8_t> bytes) {
    return HdrReader(name, bytes.first(std::min<uint64_t>(bytes.size(), MAX_FILE_BYTES))).read();
}

HdrImage read_hdr(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        throw FileError(path, error || !std::filesystem::exists(path, error)
                                  ? "expected a file, found none"
                                  : "expected a file, got something else");
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        throw FileError(path, "expected a readable file, cannot open it");
    }
    std::vector<uint8_t> bytes(std::min<uint64_t>(std::filesystem::file_size(path), MAX_FILE_BYTES));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<size_t>(stream.gcount()));
    return decode_hdr(path, bytes);
}

} // namespace burnish
