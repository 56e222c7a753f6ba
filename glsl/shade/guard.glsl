// Nothing that is not finite leaves a frame. Kernels that store radiance only leave a sign where theirs is not: every store under
// a condition costs a CPU device one to two per cent of a pass of few lookups. The guard (shade/guard.comp.glsl), which is
// dispatched by that sign, blackens and counts.
#ifndef BURNISH_SHADE_GUARD
#define BURNISH_SHADE_GUARD

#include "shade/bindings.glsl"

// By bits: isnan and isinf may be optimised away.
bool is_finite(vec3 v) {
    uvec3 magnitude = floatBitsToUint(v) & 0x7fffffffu;
    return max(max(magnitude.x, magnitude.y), magnitude.z) < 0x7f800000u;
}

void leave_sign(vec3 radiance) {
    if (!is_finite(radiance)) counters.guard[0] = 1u;
}

// Where a pixel of this coverage comes from.
uint shaded_by(float alpha) { return alpha == 0.0 ? GUARD_BACKGROUND : GUARD_SHADE; }

// What is not finite becomes black; it is counted for its pass, and the lowest index where that happened is kept.
vec3 stop_non_finite(vec3 radiance, uint index, uint pass_index) {
    if (!is_finite(radiance)) {
        radiance = vec3(0.0);
        atomicAdd(counters.stopped[pass_index], 1u);
        atomicMax(counters.first[pass_index], ~index);
    }
    return radiance;
}

#endif
