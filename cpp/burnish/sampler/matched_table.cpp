#include "burnish/sampler/matched_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "burnish/sampler/sampler.h"
#include "shared/constants.h"

namespace burnish {
namespace {

constexpr double MIXTURES[] = {
#include "matched.txt"
};

constexpr uint32_t entries_of(uint32_t count) {
    return shared::MATCHED_NODES * ((count + 1) / 2);
}

constexpr uint32_t entries_of_all() {
    uint32_t total = 0;
    for (const uint32_t count : MATCHED_COUNTS)
        total += entries_of(count);
    return total;
}
static_assert(std::size(MIXTURES) == 4 * entries_of_all(), "matched.txt has not the rows of MATCHED_COUNTS");

} // namespace

uint32_t matched_row(double rho) {
    const double last = shared::MATCHED_ROWS - 1;
    return uint32_t(std::clamp(std::log2(rho) * last / shared::MATCHED_LOG2_LARGEST_RHO + 0.5, 0.0, last));
}

std::vector<glm::vec4> matched_mixtures(uint32_t count) {
    const double* fitted = MIXTURES;
    for (const uint32_t one : MATCHED_COUNTS) {
        if (one == count) break;
        fitted += 4 * entries_of(one);
    }
    const uint32_t half = (count + 1) / 2;
    std::vector<glm::vec4> result;
    for (uint32_t row = 0; row < shared::MATCHED_ROWS; ++row) {
        const double at = double(row) * (shared::MATCHED_NODES - 1) / (shared::MATCHED_ROWS - 1);
        const uint32_t node = std::min(uint32_t(at), shared::MATCHED_NODES - 2);
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
