#include "burnish/render/filter_offsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace burnish {
namespace {

/// Where the window's cumulative distribution is .5 + x, |x| < .5; odd in x to the bit.
double sample_window(double x) {
    constexpr size_t steps = 1024;
    static const std::array<double, steps + 1> cumulative = [] {
        // From the middle outward.
        std::array<double, steps + 1> sum{};
        for (size_t k = 0; k < steps; ++k) {
            const double t = std::numbers::pi * (1.0 + (double(k) + 0.5) / steps);
            const double w =
                0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
            sum[k + 1] = sum[k] + w;
        }
        return sum;
    }();
    const double wanted = 2.0 * std::abs(x) * cumulative.back();
    const size_t k = std::clamp<size_t>(
        size_t(std::lower_bound(cumulative.begin(), cumulative.end(), wanted) - cumulative.begin()), 1,
        steps);
    const double part = (wanted - cumulative[k - 1]) / (cumulative[k] - cumulative[k - 1]);
    return std::copysign((double(k - 1) + part) / steps * FILTER_RADIUS_PX, x);
}

/// Square of the shortest vector of the lattice of all (k, a k + j m), by Gauss's reduction.
int64_t shortest_square(int64_t a, int64_t m) {
    using Vector = std::array<int64_t, 2>;
    const auto product = [](const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1]; };
    Vector longer = {0, m}, shorter = {1, a};
    for (;;) {
        if (product(longer, longer) < product(shorter, shorter)) std::swap(longer, shorter);
        const int64_t length2 = product(shorter, shorter), along = product(longer, shorter);
        const int64_t times = (2 * std::abs(along) + length2) / (2 * length2) * (along < 0 ? -1 : 1);
        const Vector rest = {longer[0] - times * shorter[0], longer[1] - times * shorter[1]};
        if (times == 0 || product(rest, rest) >= product(longer, longer)) return length2;
        longer = rest;
    }
}

struct Lattice {
    int64_t modulus = 1, multiplier = 1, shortest2 = 0;
};

/// The first multiplier of those whose shortest vector is longest; beyond m/2 are their mirror images.
Lattice best_lattice(int64_t modulus) {
    Lattice best{modulus, 1, 0};
    for (int64_t a = 1; a <= std::max<int64_t>(modulus / 2, 1); ++a) {
        if (std::gcd(a, modulus) != 1) continue;
        const int64_t shortest2 = shortest_square(a, modulus);
        if (shortest2 > best.shortest2) best = {modulus, a, shortest2};
    }
    return best;
}

} // namespace

std::vector<glm::vec2> filter_offsets(uint32_t count) {
    const int64_t n = count;
    const Lattice whole = best_lattice(n), open = best_lattice(n + 1);
    const Lattice& lattice = open.shortest2 * n >= whole.shortest2 * (n + 1) ? open : whole;
    // Of an odd modulus an odd one: only that maps the middle of the columns to the middle of the rows.
    const int64_t multiplier =
        lattice.multiplier % 2 == 0 ? lattice.multiplier - lattice.modulus : lattice.multiplier;
    std::vector<glm::vec2> offsets;
    offsets.reserve(count);
    for (int64_t k = 0; k < n; ++k) {
        // Twice the place of column and row against the middle: both pass n values, 1 - n to n - 1.
        const int64_t x = 2 * k + 1 - n, period = 2 * lattice.modulus;
        int64_t y = multiplier * x % period;
        if (y >= lattice.modulus) y -= period;
        if (y < -lattice.modulus) y += period;
        offsets.emplace_back(sample_window(double(x) / double(2 * n)),
                             sample_window(double(y) / double(2 * n)));
    }
    std::iter_swap(offsets.begin(),
                   std::min_element(offsets.begin(), offsets.end(), [](glm::vec2 one, glm::vec2 other) {
                       return glm::dot(one, one) < glm::dot(other, other);
                   }));
    return offsets;
}

} // namespace burnish
