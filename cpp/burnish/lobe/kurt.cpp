#include "burnish/lobe/kurt.h"

#include "burnish/check.h"

namespace burnish {

void validate(const KurtLobe& lobe, const std::string& prefix) {
    require_range(prefix + "roughness", lobe.roughness.x, MIN_LOBE_ROUGHNESS, 1.0f);
    require_range(prefix + "roughness", lobe.roughness.y, MIN_LOBE_ROUGHNESS, 1.0f);
    require_unit(prefix + "r0", lobe.r0);
    require_range(prefix + "alpha", lobe.alpha, 0.0f, 1.0f);
    require_non_negative(prefix + "weight", lobe.weight);
    if (!std::isfinite(lobe.rotation))
        throw std::invalid_argument(
            message(prefix, "rotation: expected a finite number, got ", lobe.rotation));
}

} // namespace burnish
