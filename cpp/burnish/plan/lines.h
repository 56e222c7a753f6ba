// Sentences about a plan: what is on and off and why, which passes run.
#pragma once

#include <string>

#include "burnish/plan/plan.h"

namespace burnish {

/// How the sampler sees the light on diffuse surfaces.
const char* describe_diffuse(const SamplerFacts& sampler);
/// "2 of 5 materials, samples from a buffer ...": why this pipeline exists.
std::string describe(const ShadeClass& one, const Scene& scene, const Plan& plan);
void add_effect_lines(const Scene& scene, Plan& plan);
/// Says where brushed surfaces have no direction of their own.
void warn_of_missing_tangents(const Scene& scene, Plan& plan);

} // namespace burnish
