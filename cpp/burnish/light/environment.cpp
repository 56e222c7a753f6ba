#include "burnish/light/environment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "burnish/error.h"
#include "burnish/light/environment_texels.h"
#include "burnish/light/half.h"

namespace burnish {

namespace {

void append_count(std::string& text, uint64_t count, const char* fault, const char* repair) {
    if (count > 0) {
        text += message(text.empty() ? "" : ", ", count, " ", fault, " (", repair, ")");
    }
}

void clean_block(std::span<float> radiance, TexelReport& report) {
    for (size_t texel = 0; texel + 3 <= radiance.size(); texel += 3) {
        bool has_nan = false, has_infinity = false, has_negative = false, has_above = false;
        for (float& value : radiance.subspan(texel, 3)) {
            if (std::isnan(value)) {
                has_nan = true;
                value = 0.0f;
            } else if (std::isinf(value)) {
                has_infinity = true;
                value = value > 0.0f ? HALF_MAX : 0.0f;
            } else {
                report.largest = std::max(report.largest, value);
                has_above = has_above || value > HALF_MAX;
                has_negative = has_negative || value < 0.0f;
                value = std::max(value, 0.0f) + 0.0f; // -0 has bits that no half is made from
            }
        }
        if (has_above) ++report.above_half;
        if (has_nan)
            ++report.not_a_number;
        else if (has_infinity)
            ++report.infinite;
        else if (has_negative)
            ++report.negative;
    }
}

} // namespace

std::string TexelReport::sentence() const {
    std::string faults;
    append_count(faults, not_a_number, "not a number", "set to 0");
    append_count(faults, infinite, "infinite", "set to 65504, or 0 if negative");
    append_count(faults, negative, "negative", "set to 0");
    if (faults.empty()) {
        return {};
    }
    return message("environment texels repaired: ", faults, "; largest finite value given ", largest, ".");
}

void require_face_size(uint32_t face_size) {
    if (face_size >= 1 && face_size <= MAX_FACE_SIZE && std::has_single_bit(face_size)) {
        return;
    }
    const uint32_t below = std::bit_floor(std::clamp(face_size, 1u, MAX_FACE_SIZE));
    const uint32_t above = std::bit_ceil(std::clamp(face_size, 1u, MAX_FACE_SIZE));
    std::string nearest = message(below);
    if (above != below) {
        nearest += message(" or ", above);
    }
    throw std::invalid_argument(message("face_size: expected a power of two in 1..", MAX_FACE_SIZE, ", got ",
                                        face_size, " (nearest: ", nearest, ")"));
}

TexelReport clean_texels(std::vector<float>& radiance) {
    // Values in [+0, HALF_MAX] are those whose bits as an integer are at most that one's: the largest of a
    // block tells whether all of it, as nearly always, can pass without further tests.
    constexpr size_t BLOCK = 3 * 512;
    const uint32_t limit_bits = std::bit_cast<uint32_t>(HALF_MAX);
    TexelReport report;
    for (size_t begin = 0; begin < radiance.size(); begin += BLOCK) {
        const std::span<float> block =
            std::span(radiance).subspan(begin, std::min(BLOCK, radiance.size() - begin));
        uint32_t most_bits = 0;
        for (const float value : block)
            most_bits = std::max(most_bits, std::bit_cast<uint32_t>(value));
        if (most_bits <= limit_bits)
            report.largest = std::max(report.largest, std::bit_cast<float>(most_bits));
        else
            clean_block(block, report);
    }
    return report;
}

Environment Environment::from_faces(uint32_t face_size, std::vector<float> radiance) {
    require_face_size(face_size);
    const size_t expected = size_t{6} * face_size * face_size * 3;
    if (radiance.size() != expected) {
        throw std::invalid_argument(message("radiance: expected ", expected, " floats for six faces of ",
                                            face_size, " x ", face_size, " x 3, got ", radiance.size()));
    }
    Environment environment;
    environment.face_size_ = face_size;
    environment.radiance_ = std::move(radiance);
    environment.texel_report_ = clean_texels(environment.radiance_);
    environment.half_range_ = half_range_of(face_size, environment.radiance_);
    return environment;
}

Environment Environment::from_lat_long(uint32_t height, uint32_t width, const std::vector<float>& radiance,
                                       uint32_t face_size, LatLongGrid grid) {
    require_face_size(face_size);
    const uint32_t least = grid == LatLongGrid::samples ? 2 : 1;
    if (height < least || width < least) {
        throw std::invalid_argument(message("radiance: expected at least ", least, " x ", least,
                                            " texels, got ", height, " x ", width));
    }
    const size_t expected = size_t{height} * width * 3;
    if (radiance.size() != expected) {
        throw std::invalid_argument(message("radiance: expected ", expected, " floats for ", height, " x ",
                                            width, " x 3, got ", radiance.size()));
    }
    std::vector<float> cleaned = radiance;
    const TexelReport source = clean_texels(cleaned);
    if (grid == LatLongGrid::samples) { // one direction, two values: both count half
        for (uint32_t row = 0; row < height; ++row) {
            float* const first = cleaned.data() + size_t{3} * width * row;
            float* const last = first + size_t{3} * (width - 1);
            for (int channel = 0; channel < 3; ++channel) {
                first[channel] = 0.5f * first[channel] + 0.5f * last[channel];
            }
        }
    }
    Environment environment =
        from_faces(face_size, cube_from_lat_long(height, width, cleaned, face_size, grid));
    environment.texel_report_.not_a_number += source.not_a_number;
    environment.texel_report_.infinite += source.infinite;
    environment.texel_report_.negative += source.negative;
    environment.texel_report_.largest = source.largest;
    return environment;
}

std::vector<uint16_t> Environment::half_rgba() const {
    const size_t row_halves = size_t{4} * face_size_;
    std::vector<uint16_t> half(6 * face_size_ * row_halves);
    for (uint32_t row = 0; row < 6 * face_size_; ++row)
        half_rgba(row, std::span(half).subspan(row * row_halves, row_halves));
    return half;
}

void Environment::half_rgba(uint32_t row, std::span<uint16_t> half) const {
    constexpr uint16_t HALF_ONE = 0x3C00;
    const float* rgb = radiance_.data() + size_t{3} * face_size_ * row;
    const float scale = std::ldexp(1.0f, -half_range_.exponent);
    for (size_t texel = 0; texel < face_size_; ++texel) {
        for (size_t channel = 0; channel < 3; ++channel)
            half[4 * texel + channel] = half_bits(scale * rgb[3 * texel + channel]);
        half[4 * texel + 3] = HALF_ONE;
    }
}

glm::vec3 cube_direction(uint32_t face, float u, float v) {
    switch (face) {
    case 0:
        return glm::normalize(glm::vec3(1.0f, -v, -u));
    case 1:
        return glm::normalize(glm::vec3(-1.0f, -v, u));
    case 2:
        return glm::normalize(glm::vec3(u, 1.0f, v));
    case 3:
        return glm::normalize(glm::vec3(u, -1.0f, -v));
    case 4:
        return glm::normalize(glm::vec3(u, -v, 1.0f));
    case 5:
        return glm::normalize(glm::vec3(-u, -v, -1.0f));
    default:
        throw std::invalid_argument(message("face: expected 0..5, got ", face));
    }
}

uint32_t cube_face(const glm::vec3& direction, float& u, float& v) {
    const glm::vec3 size = glm::abs(direction);
    if (size.z >= size.x && size.z >= size.y) {
        const bool is_positive = direction.z >= 0.0f;
        u = (is_positive ? direction.x : -direction.x) / size.z;
        v = -direction.y / size.z;
        return is_positive ? 4 : 5;
    }
    if (size.y >= size.x) {
        const bool is_positive = direction.y >= 0.0f;
        u = direction.x / size.y;
        v = (is_positive ? direction.z : -direction.z) / size.y;
        return is_positive ? 2 : 3;
    }
    const bool is_positive = direction.x >= 0.0f;
    u = (is_positive ? -direction.z : direction.z) / size.x;
    v = -direction.y / size.x;
    return is_positive ? 0 : 1;
}

} // namespace burnish
