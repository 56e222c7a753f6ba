// The effects that materials call for. A row is all that an effect is on the host: its constant in the shade
// kernels, its line in reports, and what becomes of it where kinds of material share a pipeline.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "burnish/plan/variant.h"
#include "burnish/scene/material.h"

namespace burnish {

/// A material as it is seen with one map.
struct Subject {
    const Material& material;
    bool is_map_turned = false;
    uint32_t sun_count = 0;  ///< taken out of the map
    bool has_lights = false; ///< the scene has direct lights
};

struct Effect {
    uint32_t constant; ///< SPEC_... of glsl/shared/constants.h
    const char* name;
    /// Why no material of a scene has it; null: no line of its own.
    const char* off;
    bool is_of_lobes;     ///< captured maps leave it out
    bool is_of_reference; ///< kernels of the truth know it, too
    /// Value of the constant; 0 where the material does not call for it.
    uint32_t (*wanted)(const Subject& subject);
    /// Value in a pipeline that many kinds of material share, of what it is and of all: it costs some speed
    /// and changes no picture, as an effect that is on and zero adds nothing. Null: as it is.
    uint32_t (*shared)(uint32_t value, const Variant& variant);
};

/// All of them, in the order of reports.
std::span<const Effect> effects();

/// The subject calls for these values; captured maps leave lobes out.
Variant variant_of(const Subject& subject, bool has_lobes);
/// The same with all that pipelines can share.
Variant shared_variant(const Variant& variant);

/// Names of what is on, for people: "2 lobes", "fresnel", "alpha .5", ...
std::vector<std::string> effect_names(const Variant& variant);

struct EffectValue {
    const char* name;
    uint32_t value;
};
/// Programs read these, one of every effect.
std::vector<EffectValue> effect_values(const Variant& variant);

} // namespace burnish
