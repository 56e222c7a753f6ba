#include "burnish/light/hdr_header.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string_view>

#include "burnish/error.h"

namespace burnish {

namespace {

class HeaderParser {
public:
    HeaderParser(const std::string& path, std::span<const uint8_t> bytes) : path_(path), bytes_(bytes) {}

    HdrHeader parse() {
        read_variables();
        read_axes();
        header_.size_bytes = std::min(position_, bytes_.size());
        return header_;
    }

private:
    [[noreturn]] void fail(const std::string& reason) const { throw FileError(path_, reason); }

    // A file may quote anything, so what it says is shown short and printable.
    static std::string quoted(std::string_view text) {
        std::string shown = "'";
        for (const char c : text.substr(0, 40)) {
            shown += c >= ' ' && c <= '~' ? c : '?';
        }
        return shown + (text.size() > 40 ? "...'" : "'");
    }

    std::string_view next_line() {
        if (position_ >= bytes_.size()) {
            fail(
                "expected a resolution line such as '-Y 512 +X 1024', got the end of the file in the header");
        }
        const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(position_);
        const auto end = std::find(begin, bytes_.end(), uint8_t{'\n'});
        std::string_view line(reinterpret_cast<const char*>(&*begin), static_cast<size_t>(end - begin));
        position_ += line.size() + 1;
        if (!line.empty() && line.back() == '\r') {
            line.remove_suffix(1);
        }
        return line;
    }

    static bool is_resolution(std::string_view line) {
        return line.size() > 2 && (line[0] == '-' || line[0] == '+') && (line[1] == 'X' || line[1] == 'Y');
    }

    void read_variables() {
        const std::string_view magic = next_line();
        if (!magic.starts_with("#?")) {
            fail("expected a Radiance picture starting with '#?', got " + quoted(magic));
        }
        while (true) {
            const size_t line_start = position_;
            const std::string_view line = next_line();
            if (line.empty()) {
                return;
            }
            if (is_resolution(line)) { // some writers forget the empty line
                position_ = line_start;
                return;
            }
            read_variable(line);
        }
    }

    void read_variable(std::string_view line) {
        const auto value_of = [&](std::string_view name) -> std::optional<std::string> {
            return line.starts_with(name) ? std::optional(std::string(line.substr(name.size())))
                                          : std::nullopt;
        };
        if (const auto format = value_of("FORMAT=")) {
            const std::string_view name =
                std::string_view(*format).substr(std::min(format->find_first_not_of(' '), format->size()));
            header_.is_xyz = name.starts_with("32-bit_rle_xyze");
            if (!header_.is_xyz && !name.starts_with("32-bit_rle_rgbe")) {
                fail("FORMAT: expected 32-bit_rle_rgbe or 32-bit_rle_xyze, got " + quoted(name));
            }
        } else if (const auto exposure = value_of("EXPOSURE=")) {
            std::istringstream text(*exposure);
            double factor = 0.0;
            text >> factor;
            header_.divisor *= checked_factor("EXPOSURE", factor, *exposure);
        } else if (const auto correction = value_of("COLORCORR=")) {
            std::istringstream text(*correction);
            glm::dvec3 factor(0.0);
            text >> factor.x >> factor.y >> factor.z;
            for (int channel = 0; channel < 3; ++channel) {
                header_.divisor[channel] *= checked_factor("COLORCORR", factor[channel], *correction);
            }
        } else if (const auto gamma = value_of("GAMMA=")) {
            header_.gamma = checked_gamma(*gamma);
        } else if (const auto aspect = value_of("PIXASPECT=")) {
            std::istringstream text(*aspect);
            double factor = 0.0;
            text >> factor;
            header_.pixel_aspect *= checked_factor("PIXASPECT", factor, *aspect);
        } else if (const auto primaries = value_of("PRIMARIES=")) {
            std::istringstream text(*primaries);
            header_.primaries.assign(8, 0.0); // what is missing or no number is no chromaticity either
            for (double& value : header_.primaries) {
                if (!(text >> value)) value = 0.0;
            }
        }
    }

    double checked_gamma(const std::string& value) const {
        std::istringstream text(value);
        double gamma = 0.0;
        text >> gamma;
        if (!(gamma >= 0.1 && gamma <= 10.0)) {
            fail("GAMMA: expected a number in 0.1..10, got " + quoted(value));
        }
        return gamma;
    }

    double checked_factor(const char* name, double factor, const std::string& text) const {
        if (!(factor >= 1e-30 && factor <= 1e30)) {
            fail(message(name, ": expected a positive number in 1e-30..1e30, got ", quoted(text)));
        }
        return factor;
    }

    void read_axes() {
        const std::string_view line = next_line();
        std::istringstream text{std::string(line)};
        std::array<HdrAxis, 2> axes;
        bool is_good = true;
        for (HdrAxis& axis : axes) {
            std::string name;
            int64_t size = 0;
            text >> name >> size;
            is_good = is_good && text && name.size() == 2 && is_resolution(name + " ") && size >= 1 &&
                      size <= 1'000'000;
            if (is_good) {
                axis = {.is_x = name[1] == 'X',
                        .is_increasing = name[0] == '+',
                        .size = static_cast<uint32_t>(size)};
            }
        }
        if (!is_good || axes[0].is_x == axes[1].is_x) {
            fail("expected a resolution line such as '-Y 512 +X 1024' with sizes in 1..1000000, got " +
                 quoted(line));
        }
        header_.slow = axes[0];
        header_.fast = axes[1];
    }

    const std::string& path_;
    std::span<const uint8_t> bytes_;
    size_t position_ = 0;
    HdrHeader header_;
};

} // namespace

HdrHeader parse_hdr_header(const std::string& path, std::span<const uint8_t> bytes) {
    return HeaderParser(path, bytes).parse();
}

} // namespace burnish
