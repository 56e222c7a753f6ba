// The samplers a user chooses from: each is one file, and a name in this list.
#pragma once

#include <variant>

#include "burnish/sampler/importance.h"
#include "burnish/sampler/matched.h"
#include "burnish/sampler/prefiltered.h"
#include "burnish/sampler/reference.h"
#include "burnish/sampler/regular.h"

namespace burnish {

using Sampler = std::variant<Regular, Importance, Matched, Prefiltered, Reference>;

/// Throws std::invalid_argument, naming field, range and value.
void validate(const Sampler& sampler);
SamplerFacts facts(const Sampler& sampler);

/// The table of a lobe, or one that scales with its widths; `face_size` is that of the map it looks up. Of
/// samplers that place a pattern; others have none.
SampleTable build_sample_table(const Sampler& sampler, const LobeShape& shape, uint32_t face_size);
SampleTable build_scaled_table(const Sampler& sampler, LobeShape shape, uint32_t face_size);

/// Settings of the truth; throws std::bad_variant_access for another sampler.
const Reference& reference_of(const Sampler& sampler);

} // namespace burnish
