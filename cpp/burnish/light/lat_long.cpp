// Lat-long map to cube faces, exactly.
//
// With s = sin(latitude) the solid angle is dlon ds, and the radiance L of the map is constant over each of
// its texels. Let
//   D(lon, s) = integral of L(lon, s') ds' from s to 1,
// linear in s inside a texel. By Green's theorem the energy of a region is the integral of D dlon along its
// outline. The outline of a cube texel is four arcs of great circles. Along one, tan(latitude) = A cos(psi),
// psi = lon - lon0, so
//   s = A cos(psi) / sqrt(1 + A^2 cos^2(psi)),   integral of s dpsi = atan(A sin(psi) / sqrt(1 + A^2
//   cos^2(psi))),
// and inside one texel of the map the integral of D is closed form. An arc is cut where it crosses the map's
// grid. Nothing is sampled; neighbouring cube texels share their arcs, so what one loses the other gets. Arcs
// along a meridian have dlon = 0. The face of -y measures D from the south pole, so that on either pole D = 0
// where lon is undefined.
#include "burnish/cores.h"
#include "burnish/light/environment_texels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burnish {

namespace {

using Vec3 = glm::dvec3;
constexpr double PI = std::numbers::pi;

Vec3 face_point(uint32_t face, double u, double v) {
    switch (face) {
    case 0:
        return {1, -v, -u};
    case 1:
        return {-1, -v, u};
    case 2:
        return {u, 1, v};
    case 3:
        return {u, -1, -v};
    case 4:
        return {u, -v, 1};
    default:
        return {-u, -v, -1};
    }
}

// Integral of dudv / (1 + u^2 + v^2)^(3/2) from (0, 0): the solid angle of a rectangle is its mixed
// difference.
double corner_solid_angle(double u, double v) {
    return std::atan2(u * v, std::sqrt(1.0 + u * u + v * v));
}

class LatLongEnergy {
public:
    LatLongEnergy(uint32_t height, uint32_t width, const std::vector<float>& radiance, LatLongGrid grid)
        : height_(height), width_(width), row_steps_(height), column_period_(width), radiance_(radiance),
          sin_latitude_(height + 1), tan_latitude_(height + 1),
          energy_above_(size_t{3} * width * (height + 1)) {
        if (grid == LatLongGrid::samples) {
            // Steps between centres: one less than texels. Edges lie half a step later, and the first and
            // last column stand for one direction, so columns repeat after width - 1 and the last one is
            // never read.
            row_steps_ = height_ - 1;
            column_period_ = width_ - 1;
            edge_shift_ = 0.5;
        }
        for (uint32_t row = 0; row <= height; ++row) {
            const double steps = (row - edge_shift_) / double(row_steps_);
            const double latitude = PI * (0.5 - std::clamp(steps, 0.0, 1.0));
            sin_latitude_[row] = std::sin(latitude);
            tan_latitude_[row] = std::tan(latitude);
        }
        for (uint32_t row = 0; row < height; ++row) {
            const double band = sin_latitude_[row] - sin_latitude_[row + 1];
            const size_t first = size_t{3} * width * row;
            for (size_t i = first; i < first + size_t{3} * width; ++i) {
                energy_above_[i + size_t{3} * width] = energy_above_[i] + radiance[i] * band;
            }
        }
    }

    /// Integral of D dlon along the great circle arc from `start` to `end`; `from_south` measures D from the
    /// south pole.
    Vec3 along_arc(const Vec3& start, const Vec3& end, bool from_south) const {
        const Vec3 normal = glm::cross(start, end);
        if (normal.y == 0.0) {
            return Vec3(0.0);
        }
        Arc arc;
        const double begin_longitude = std::atan2(start.x, start.z);
        const double turn = std::remainder(std::atan2(end.x, end.z) - begin_longitude, 2.0 * PI);
        // tan(latitude) = -(normal.x sin(lon) + normal.z cos(lon)) / normal.y; an arc never crosses the
        // equator, so one sign of A holds and psi stays within a quarter turn.
        const double sine = -normal.x / normal.y;
        const double cosine = -normal.z / normal.y;
        arc.amplitude = std::hypot(sine, cosine);
        arc.longitude = std::atan2(sine, cosine);
        if (start.y < 0.0) {
            arc.amplitude = -arc.amplitude;
            arc.longitude += PI;
        }
        const double begin = std::remainder(begin_longitude - arc.longitude, 2.0 * PI);
        const double finish = begin + turn;
        Vec3 sum(0.0);
        if (begin * finish < 0.0) { // latitude turns at psi = 0
            add_monotone(arc, begin, 0.0, from_south, sum);
            add_monotone(arc, 0.0, finish, from_south, sum);
        } else {
            add_monotone(arc, begin, finish, from_south, sum);
        }
        return sum;
    }

private:
    struct Arc {
        double amplitude = 0.0; // A
        double longitude = 0.0; // lon0
    };

    static double latitude_integral(const Arc& arc, double psi) {
        const double tangent = arc.amplitude * std::cos(psi);
        return std::atan(arc.amplitude * std::sin(psi) / std::sqrt(1.0 + tangent * tangent));
    }

    // Walks the texels that the arc crosses between two psi of the same sign.
    void add_monotone(const Arc& arc, double begin, double finish, bool from_south, Vec3& sum) const {
        const double step_sign = finish >= begin ? 1.0 : -1.0;
        const double side = begin + finish >= 0.0 ? 1.0 : -1.0; // the sign of psi
        const bool goes_north = (step_sign * side < 0.0) == (arc.amplitude > 0.0);
        const double columns_per_radian = double(column_period_) / (2.0 * PI);
        const double middle =
            0.5 * double(column_period_) + edge_shift_; // the column coordinate of longitude 0

        const double latitude = std::atan(arc.amplitude * std::cos(begin));
        const double first_row = std::floor((0.5 - latitude / PI) * double(row_steps_) + edge_shift_);
        int64_t row = std::clamp<int64_t>(static_cast<int64_t>(first_row), 0, height_ - 1);
        // Columns count against longitude.
        const double x = middle - (arc.longitude + begin) * columns_per_radian;
        int64_t column = static_cast<int64_t>(step_sign > 0.0 ? std::ceil(x) - 1.0 : std::floor(x));

        double psi = begin;
        double integral = latitude_integral(arc, psi);
        double row_psi = row_crossing(arc, row, goes_north, side, finish);
        while (step_sign * (finish - psi) > 0.0) {
            const double column_edge = step_sign > 0.0 ? double(column) : double(column + 1);
            const double column_psi = (middle - column_edge) / columns_per_radian - arc.longitude;
            const bool leaves_row = step_sign * (row_psi - column_psi) <= 0.0;
            double next = leaves_row ? row_psi : column_psi;
            const bool is_last = step_sign * (finish - next) <= 0.0;
            next = is_last ? finish : next;
            if (step_sign * (next - psi) > 0.0) {
                const double next_integral = latitude_integral(arc, next);
                add_piece(row, column, next - psi, next_integral - integral, from_south, sum);
                psi = next;
                integral = next_integral;
            }
            if (is_last) {
                return;
            }
            if (leaves_row) {
                row = std::clamp<int64_t>(row + (goes_north ? -1 : 1), 0, height_ - 1);
                row_psi = row_crossing(arc, row, goes_north, side, finish);
            } else {
                column -= step_sign > 0.0 ? 1 : -1;
            }
        }
    }

    // psi at which the arc leaves `row`, or `finish` where it does not.
    double row_crossing(const Arc& arc, int64_t row, bool goes_north, double side, double finish) const {
        const int64_t edge = goes_north ? row : row + 1;
        if (edge == 0 || edge == height_) {
            return finish;
        }
        const double cosine = tan_latitude_[static_cast<size_t>(edge)] / arc.amplitude;
        // Written so that the NaN of a flat arc on the equator (0/0) also means: no crossing.
        return cosine >= 0.0 && cosine <= 1.0 ? side * std::acos(cosine) : finish;
    }

    void add_piece(int64_t row, int64_t column, double turn, double latitude_turn, bool from_south,
                   Vec3& sum) const {
        const int64_t wrapped = ((column % column_period_) + column_period_) % column_period_;
        const size_t texel = static_cast<size_t>(3 * (row * width_ + wrapped));
        const size_t whole = static_cast<size_t>(3 * (height_ * width_ + wrapped));
        const double sine = sin_latitude_[static_cast<size_t>(row)];
        for (int channel = 0; channel < 3; ++channel) {
            const auto i = static_cast<size_t>(channel);
            const double radiance = radiance_[texel + i];
            const double above =
                (energy_above_[texel + i] + radiance * sine) * turn - radiance * latitude_turn;
            sum[channel] += from_south ? above - energy_above_[whole + i] * turn : above;
        }
    }

    int64_t height_;
    int64_t width_;
    int64_t row_steps_;     // rows in 180 degrees
    int64_t column_period_; // columns in 360 degrees
    double edge_shift_ =
        0.0; // of the lower index edge of a texel against its place in LatLongGrid::bands, in texels
    const std::vector<float>& radiance_;
    std::vector<double> sin_latitude_; // of the upper edge of each row, and of the lower edge of the last
    std::vector<double> tan_latitude_;
    std::vector<double> energy_above_; // (row, column, channel): D at the upper edge of each row
};

// Fills `row_count` rows of one face. The lower arcs of a row are the upper ones of the next and are
// integrated once.
void fill_rows(const LatLongEnergy& energy, uint32_t face, uint32_t first_row, uint32_t row_count,
               uint32_t face_size, float* texels) {
    const bool is_pole = face == 2 || face == 3;
    const bool from_south = face == 3;
    const auto edge = [&](uint32_t i) { return 2.0 * i / face_size - 1.0; };
    const auto arc = [&](double u0, double v0, double u1, double v1) {
        return energy.along_arc(face_point(face, u0, v0), face_point(face, u1, v1), from_south);
    };
    std::vector<Vec3> upper(face_size);
    for (uint32_t column = 0; column < face_size; ++column) {
        upper[column] = arc(edge(column), edge(first_row), edge(column + 1), edge(first_row));
    }
    for (uint32_t row = first_row; row < first_row + row_count; ++row) {
        const double v0 = edge(row);
        const double v1 = edge(row + 1);
        // The left and right arcs of the four side faces lie on meridians: zero.
        Vec3 left = is_pole ? arc(-1.0, v1, -1.0, v0) : Vec3(0.0);
        for (uint32_t column = 0; column < face_size; ++column) {
            const double u0 = edge(column);
            const double u1 = edge(column + 1);
            const Vec3 lower = arc(u0, v1, u1, v1);
            const Vec3 right = is_pole ? arc(u1, v1, u1, v0) : Vec3(0.0);
            const double solid_angle = corner_solid_angle(u1, v1) - corner_solid_angle(u0, v1) -
                                       corner_solid_angle(u1, v0) + corner_solid_angle(u0, v0);
            const Vec3 mean = (lower - upper[column] + right - left) / solid_angle;
            for (int channel = 0; channel < 3; ++channel) {
                // Rounding may leave -1e-20 where the map is black, which is not a fault of the map.
                *texels++ = static_cast<float>(std::max(mean[channel], 0.0));
            }
            upper[column] = lower;
            left = right;
        }
    }
}

} // namespace

std::vector<float> cube_from_lat_long(uint32_t height, uint32_t width, const std::vector<float>& radiance,
                                      uint32_t face_size, LatLongGrid grid) {
    const LatLongEnergy energy(height, width, radiance, grid);
    std::vector<float> faces(size_t{6} * face_size * face_size * 3);
    // Sixteen rows are a good unit of work: those of the two pole faces take twice as long as others.
    const uint32_t rows = std::min(face_size, 16u);
    const uint32_t unit_count = 6 * face_size / rows;
    for_each_on_cores(unit_count, true, [&](size_t unit) {
        const auto row = static_cast<uint32_t>(unit) * rows;
        fill_rows(energy, row / face_size, row % face_size, rows, face_size,
                  faces.data() + size_t{3} * face_size * row);
    });
    return faces;
}

} // namespace burnish
