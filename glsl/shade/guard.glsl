// Nothing that is not finite leaves a pass.
#ifndef BURNISH_SHADE_GUARD
#define BURNISH_SHADE_GUARD

#include "shade/bindings.glsl"

bool is_finite(vec3 v) {
    // By bits: isnan and isinf may be optimised away.
    uvec3 exponent = floatBitsToUint(v) & 0x7f800000u;
    return exponent.x != 0x7f800000u && exponent.y != 0x7f800000u && exponent.z != 0x7f800000u;
}

// What is not finite becomes black; it is counted for its pass, and the lowest index where that happened is kept.
vec3 stop_non_finite(vec3 radiance, uint index, uint pass_index) {
    uint stopped = is_finite(radiance) ? 0u : 1u;
    // A CPU device skips a loop that all lanes leave at once, and runs the atomics of an `if` lane by lane.
    for (uint k = 0u; k < stopped; ++k) {
        atomicAdd(counters.stopped[pass_index], 1u);
        atomicMax(counters.first[pass_index], ~index);
    }
    return stopped == 0u ? radiance : vec3(0.0);
}

#endif
