#include "burnish/light/pyramid_filter.h"

#include <stdexcept>

#include "burnish/error.h"

namespace burnish {

PyramidFilter pyramid_filter(const std::string& name) {
    for (const PyramidFilter filter : {PyramidFilter::box, PyramidFilter::gauss4, PyramidFilter::gauss6}) {
        if (name == pyramid_filter_name(filter)) return filter;
    }
    throw std::invalid_argument(
        message("filter: expected \"box\", \"gauss4\" or \"gauss6\", got \"", name, "\""));
}

float lookup_variance(PyramidFilter filter) {
    switch (filter) {
    case PyramidFilter::box:
        return 0.25f;
    case PyramidFilter::gauss4:
        return 5.0f / 12.0f;
    case PyramidFilter::gauss6:
        return 7.0f / 12.0f;
    }
    return 0.25f;
}

const char* pyramid_filter_name(PyramidFilter filter) {
    return filter == PyramidFilter::box ? "box" : filter == PyramidFilter::gauss4 ? "gauss4" : "gauss6";
}

} // namespace burnish
