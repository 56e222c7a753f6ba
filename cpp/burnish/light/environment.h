// Distant light as six square faces of linear radiance. Face order, axes and row order are Vulkan's:
// +X -X +Y -Y +Z -Z; face texel (row, column) has u = (2 column + 1)/N - 1, v = (2 row + 1)/N - 1 and
// direction
//   +X: ( 1, -v, -u)   -X: (-1, -v,  u)   +Y: ( u,  1,  v)   -Y: ( u, -1, -v)   +Z: ( u, -v,  1)   -Z: (-u,
//   -v, -1).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "burnish/light/half_range.h"

namespace burnish {

constexpr float HALF_MAX = 65504.0f;
constexpr uint32_t MAX_FACE_SIZE = 2048;

/// What was wrong with the texels given, and was put right. A texel counts once, under its worst fault in the
/// order NaN, infinite, negative; every faulty channel is repaired, the others are left as they are.
struct TexelReport {
    uint64_t negative = 0;     ///< set to 0
    uint64_t not_a_number = 0; ///< set to 0
    uint64_t infinite = 0;     ///< +inf set to HALF_MAX, -inf to 0
    uint64_t above_half = 0;   ///< finite, above HALF_MAX: no fault, the map's HalfRange makes room
    float largest = 0;         ///< largest finite value given, 0 if none is positive

    uint64_t count() const { return negative + not_a_number + infinite; }
    /// One sentence for the report, empty when nothing was wrong.
    std::string sentence() const;
};

/// Where the texels of a lat-long map lie. OpenEXR's environment maps (attribute envmap) are sampled up to
/// the border.
enum class LatLongGrid {
    bands,   ///< equal angles; the outer texels end at the poles and at +-180 degrees
    samples, ///< texel centres in equal steps, the outer ones on the poles and on +-180, where first and last
             ///< column meet
};

class Environment {
public:
    /// `radiance`: 6 * face_size * face_size * 3 floats, (face, row, column, channel).
    /// face_size: a power of two in 1..MAX_FACE_SIZE. Texels are cleaned and counted, never silently.
    static Environment from_faces(uint32_t face_size, std::vector<float> radiance);

    /// `radiance`: height * width * 3 floats, OpenEXR's lat-long convention: top row latitude +90, left edge
    /// longitude +180 falling to -180 at the right, longitude 0 (+z) in the middle, +90 at +x. Each cube
    /// texel gets the exact mean over its solid angle of the map read as constant inside its texels, so a sun
    /// keeps its energy wherever it stands and however coarse either map is. Report: NaN, infinite, negative
    /// count lat-long texels; above_half counts cube texels. LatLongGrid::samples needs at least 2 x 2
    /// texels.
    static Environment from_lat_long(uint32_t height, uint32_t width, const std::vector<float>& radiance,
                                     uint32_t face_size, LatLongGrid grid = LatLongGrid::bands);

    uint32_t face_size() const { return face_size_; }
    const std::vector<float>& radiance() const { return radiance_; }
    const TexelReport& texel_report() const { return texel_report_; }

    /// How halves hold the faces.
    const HalfRange& half_range() const { return half_range_; }
    /// The faces over 2^half_range().exponent as half floats, alpha 1, for upload: rounded to nearest even,
    /// nothing else. 6 N N 4 values.
    std::vector<uint16_t> half_rgba() const;
    /// The same of one row of all rows of all faces, 4 N values.
    void half_rgba(uint32_t row, std::span<uint16_t> half) const;

    /// world_from_environment: turns the map in the world; a lookup for world direction w reads
    /// transpose(rotation) * w.
    glm::mat3 rotation{1.0f};
    /// Multiplies the radiance, in stops (factor 2^exposure). Applied when the map is looked up.
    float exposure = 0.0f;
    std::string name;
    std::vector<std::string>
        notes; ///< what was done to the map on its way here, a sentence each, for the report

private:
    uint32_t face_size_ = 0;
    std::vector<float> radiance_;
    TexelReport texel_report_;
    HalfRange half_range_;
};

/// Throws std::invalid_argument naming the nearest sizes unless face_size is a power of two
/// in 1..MAX_FACE_SIZE.
void require_face_size(uint32_t face_size);

/// Unit direction through (u, v) in [-1, 1]^2 of a face, and the face and (u, v) a direction meets. On edges
/// and corners z wins over y, and y over x, as Vulkan orders them. The direction must not be zero; it need
/// not have unit length.
glm::vec3 cube_direction(uint32_t face, float u, float v);
uint32_t cube_face(const glm::vec3& direction, float& u, float& v);

} // namespace burnish
