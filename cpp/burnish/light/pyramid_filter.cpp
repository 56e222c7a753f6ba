#include "burnish/light/pyramid_filter.h"

#include <algorithm>
#include <stdexcept>

#include "burnish/error.h"

namespace burnish {

static_assert(std::ranges::all_of(PYRAMID_FILTERS,
                                  [](const PyramidFilterRow& row) { return &row_of(row.filter) == &row; }));

PyramidFilter pyramid_filter(const std::string& name) {
    std::string names;
    for (const PyramidFilterRow& row : PYRAMID_FILTERS) {
        if (name == row.name) return row.filter;
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    }
    throw std::invalid_argument(message("filter: expected one of ", names, ", got \"", name, "\""));
}

} // namespace burnish
