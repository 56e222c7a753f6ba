#include "burnish/sampler/matched_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "burnish/sampler/sampler.h"
#include "shared/constants.h"

namespace burnish {
namespace {

constexpr double GAUSSIAN[] = {
#include "matched.txt"
};
constexpr double STUDENT[] = {
#include "student.txt"
};

/// Windows R of Student's tables, what of the density each leaves, and the widths beyond which lobes take
/// them.
struct Window {
    double radius, share, least_width;
};
constexpr std::array<Window, shared::MATCHED_WINDOWS> WINDOWS = {
    {{std::numeric_limits<double>::infinity(), 1.0, 0.0},
     {shared::MATCHED_SECOND_WINDOW, shared::MATCHED_SECOND_WINDOW_SHARE,
      shared::MATCHED_SECOND_WINDOW_WIDTH},
     {shared::MATCHED_THIRD_WINDOW, shared::MATCHED_THIRD_WINDOW_SHARE, shared::MATCHED_THIRD_WINDOW_WIDTH}}};

constexpr uint32_t entries_of(uint32_t nodes, uint32_t count) {
    return nodes * ((count + 1) / 2);
}

constexpr uint32_t entries_of_all(uint32_t nodes) {
    uint32_t total = 0;
    for (const uint32_t count : MATCHED_COUNTS)
        total += entries_of(nodes, count);
    return total;
}
static_assert(std::size(GAUSSIAN) == 4 * entries_of_all(shared::MATCHED_NODES),
              "matched.txt has not the rows of MATCHED_COUNTS");
static_assert(std::size(STUDENT) == 4 * WINDOWS.size() * entries_of_all(shared::MATCHED_STUDENT_NODES),
              "student.txt has not the rows of MATCHED_COUNTS and WINDOWS");

} // namespace

MixtureTable MixtureTable::of(Density density, double width) {
    MixtureTable table{density, 0};
    if (density == Density::student)
        while (table.window + 1 < WINDOWS.size() && width > WINDOWS[table.window + 1].least_width)
            ++table.window;
    return table;
}

double MixtureTable::ratio(double lobe_r2, double mixture_r2) const {
    if (density == Density::gaussian) return std::exp(mixture_r2 - lobe_r2);
    const Window& one = WINDOWS[window];
    const double quotient = (1.0 + mixture_r2) / (1.0 + lobe_r2);
    return quotient * quotient * one.share *
           std::exp(std::min(0.5 * mixture_r2 / (one.radius * one.radius),
                             double(shared::MATCHED_MOST_WINDOW_EXPONENT)));
}

uint32_t matched_row(double rho) {
    const double last = shared::MATCHED_ROWS - 1;
    return uint32_t(std::clamp(std::log2(rho) * last / shared::MATCHED_LOG2_LARGEST_RHO + 0.5, 0.0, last));
}

std::vector<glm::vec4> all_matched_mixtures(uint32_t count, Density density) {
    std::vector<glm::vec4> result = matched_mixtures(count, {density, 0});
    if (density == Density::student)
        for (uint32_t window = 1; window < WINDOWS.size(); ++window)
            std::ranges::copy(matched_mixtures(count, {density, window}), std::back_inserter(result));
    return result;
}

std::vector<glm::vec4> matched_mixtures(uint32_t count, MixtureTable table) {
    const bool is_student = table.density == Density::student;
    const uint32_t nodes = is_student ? shared::MATCHED_STUDENT_NODES : shared::MATCHED_NODES;
    const double* fitted = is_student ? STUDENT + size_t(4) * table.window * entries_of_all(nodes) : GAUSSIAN;
    for (const uint32_t one : MATCHED_COUNTS) {
        if (one == count) break;
        fitted += 4 * entries_of(nodes, one);
    }
    const uint32_t half = (count + 1) / 2;
    std::vector<glm::vec4> result;
    for (uint32_t row = 0; row < shared::MATCHED_ROWS; ++row) {
        const double at = double(row) * (nodes - 1) / (shared::MATCHED_ROWS - 1);
        const uint32_t node = std::min(uint32_t(at), nodes - 2);
        const double share = at - node;
        for (uint32_t k = 0; k < half; ++k) {
            glm::dvec4 entry;
            for (uint32_t c = 0; c < 4; ++c) {
                const double* value = fitted + 4 * (node * half + k) + c;
                entry[int(c)] = (1.0 - share) * value[0] + share * value[4 * half];
            }
            result.emplace_back(entry);
        }
    }
    return result;
}

} // namespace burnish
