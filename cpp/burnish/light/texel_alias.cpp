#include "burnish/light/texel_alias.h"

#include "burnish/light/cube_texels.h"

#include <algorithm>
#include <numbers>

namespace burnish {

namespace {

constexpr double UNIFORM_PART = 0.05;

/// Luminance of the 3x3 texels around each texel of a face, times 9, times its solid angle.
void blur_face(const float* radiance, const std::vector<double>& solid_angles, uint32_t face_size,
               double* weights) {
    const size_t texel_count = solid_angles.size();
    std::vector<double> luminance(texel_count), along_rows(texel_count);
    for (size_t texel = 0; texel < texel_count; ++texel) {
        const float* rgb = radiance + 3 * texel;
        luminance[texel] = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    }
    for (size_t row = 0; row < texel_count; row += face_size) {
        for (size_t column = 0; column < face_size; ++column) {
            const size_t before = column == 0 ? column : column - 1;
            const size_t after = column + 1 == face_size ? column : column + 1;
            along_rows[row + column] =
                luminance[row + before] + luminance[row + column] + luminance[row + after];
        }
    }
    for (uint32_t row = 0; row < face_size; ++row) {
        const double* here = &along_rows[size_t{row} * face_size];
        const double* above = row == 0 ? here : here - face_size;
        const double* below = row + 1 == face_size ? here : here + face_size;
        for (uint32_t column = 0; column < face_size; ++column) {
            const size_t texel = size_t{row} * face_size + column;
            weights[texel] = (above[column] + here[column] + below[column]) * solid_angles[texel];
        }
    }
}

/// Probabilities of all texels, times their number.
std::vector<double> scaled_probabilities(const CubeTexels& cube, uint32_t face_size) {
    const std::vector<double> solid_angles = texel_solid_angles(face_size);
    const size_t face_texels = solid_angles.size();
    std::vector<double> scaled(6 * face_texels);
    double sum = 0.0;
    for (size_t face = 0; face < 6; ++face) {
        blur_face(cube.radiance.data() + 3 * face * face_texels, solid_angles, face_size,
                  scaled.data() + face * face_texels);
        for (size_t texel = 0; texel < face_texels; ++texel)
            sum += scaled[face * face_texels + texel];
    }
    const double count = static_cast<double>(scaled.size());
    const double by_light = sum > 0.0 ? (1.0 - UNIFORM_PART) * count / sum : 0.0;
    const double by_angle = (sum > 0.0 ? UNIFORM_PART : 1.0) * count / (4.0 * std::numbers::pi);
    for (size_t texel = 0; texel < scaled.size(); ++texel) {
        scaled[texel] = by_light * scaled[texel] + by_angle * solid_angles[texel % face_texels];
    }
    return scaled;
}

} // namespace

std::vector<shared::TexelAlias> build_texel_alias(const CubeTexels& cube) {
    std::vector<double> left = scaled_probabilities(cube, require_texels(cube));
    const auto count = static_cast<uint32_t>(left.size());
    std::vector<shared::TexelAlias> table(count);
    // Texels with less than an even share from the front, those with more from the back.
    std::vector<uint32_t> waiting(count);
    uint32_t poor_end = 0, rich_begin = count;
    for (uint32_t texel = 0; texel < count; ++texel) {
        table[texel] = {1.0f, texel, 0.0f, 0};
        waiting[left[texel] < 1.0 ? poor_end++ : --rich_begin] = texel;
    }
    // An entry of a poor texel is filled up by a rich one. Who remains in the end has a share of 1 but for
    // rounding.
    while (poor_end > 0 && rich_begin < count) {
        const uint32_t poor = waiting[--poor_end];
        const uint32_t rich = waiting[rich_begin];
        table[poor].threshold = static_cast<float>(left[poor]);
        table[poor].alias = rich;
        left[rich] -= 1.0 - left[poor];
        if (left[rich] < 1.0) {
            ++rich_begin;
            waiting[poor_end++] = rich;
        }
    }

    std::vector<double>& shares = left;
    std::fill(shares.begin(), shares.end(), 0.0);
    for (uint32_t texel = 0; texel < count; ++texel) {
        shares[texel] += table[texel].threshold;
        shares[table[texel].alias] += 1.0 - table[texel].threshold;
    }
    for (uint32_t texel = 0; texel < count; ++texel)
        table[texel].probability = static_cast<float>(shares[texel] / count);
    return table;
}

} // namespace burnish
