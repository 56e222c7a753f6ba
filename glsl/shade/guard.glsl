// Nothing that is not finite leaves a frame. On a CPU device every store under a condition costs one to two
// per cent of a pass of few lookups, so kernels have a single store: it puts what is not finite behind the
// picture's end, not in its pixel. A picture that left something there is drawn once more by kernels that
// blacken and count (COUNTS_NON_FINITE).
#ifndef BURNISH_SHADE_GUARD
#define BURNISH_SHADE_GUARD

#include "shade/bindings.glsl"

layout(constant_id = SPEC_COUNTS_NON_FINITE) const bool COUNTS_NON_FINITE = false;

// By bits: isnan and isinf may be optimised away.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7fffffffu) < 0x7f800000u; }
bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

// Where a pixel or point is stored. One test for three: a sum is not finite where a term is not. Where it
// overflows alone, the picture that is drawn once more has nothing to count.
uint guarded_place(vec3 radiance, uint index) {
    return is_finite(radiance.r + radiance.g + radiance.b) ? index : push.point_count;
}

// What is not finite becomes black; it is counted for its pass, and the lowest index where that happened is
// kept.
vec3 stop_non_finite(vec3 radiance, uint index, uint pass_index) {
    if (!is_finite(radiance)) {
        radiance = vec3(0.0);
        atomicAdd(counters.stopped[pass_index], 1u);
        atomicMax(counters.first[pass_index], ~index);
    }
    return radiance;
}

#endif
