// What the kernel that prefilters maps, the one that looks them up, and Prefilter
// (cpp/burnish/render/prefilter.h) must agree on.
//
// A prefiltered map has the levels of a pyramid. Level 0 is the map. A level of n texels along an edge holds
// the map as an isotropic lobe of slope PREFILTER_SLOPE / n sees it along its normal, so that a lobe is twice
// as wide from level to level.
#ifndef BURNISH_SHARED_PREFILTER_H
#define BURNISH_SHARED_PREFILTER_H

#include "shared/types.h"

SHARED_BEGIN

// Directions spread 2 sqrt(1/2) m about the mirrored one and a texel is 2/n wide, so a lobe's standard
// deviation is 2.1 texels: a bilinear lookup widens it by 2 %. Wider lobes a level would leave more of the
// narrow ones to the step from the map to level 1.
SHARED_CONST float PREFILTER_SLOPE = 3.0f;
// The same for level 0: a bilinear lookup of the map itself has a variance of 1/4 texel^2, as a lobe of slope
// sqrt(1/2)/n.
SHARED_CONST float PREFILTER_MAP_SLOPE = 0.70710678f;

// The other kind, for the matched sampler: a level of n texels is the map under a Gaussian of variance .75
// (2/n)^2 per axis of angle, the same everywhere on the sphere. A lookup at level l then has
// SPHERICAL_VARIANCE 4^l (2/N)^2: bilinear interpolation adds 1/6 in the middle of a face, and half of that
// toward its corners.
SHARED_CONST float SPHERICAL_LEVEL_VARIANCE = 0.75f;
SHARED_CONST float SPHERICAL_VARIANCE = 0.85f;

SHARED_CONST uint SPEC_PREFILTER_IS_SPHERICAL = 0u;
// Beside those of the lookup, by which it reads the pyramid.
SHARED_CONST uint BINDING_PREFILTER_SAMPLES = 0u;
SHARED_CONST uint BINDING_PREFILTER_TEXELS = 1u;

// Push constants of one level of one cube.
struct PrefilterRecord {
    uint cube;         // in its array
    uint size;         // texels along an edge of the level
    uint texel_begin;  // where its faces begin in the buffer of texels, one after the other
    uint sample_begin; // first entry of its SampleTable, whole phases
    uint sample_count; // those of whole phases
    uint pad0;
    uint pad1;
    uint pad2;
};
SHARED_SIZE(PrefilterRecord, 32)

// Lookups done together, so that a CPU can overlap their loads.
SHARED_CONST uint PREFILTER_PHASE = 4u;

SHARED_END

#endif
