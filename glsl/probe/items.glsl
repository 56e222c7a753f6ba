// What every probe shares: items of arguments in, items of results out. An entry point defines run(), which
// reads arguments from the left and leaves results; the function is chosen when the pipeline is made.
#ifndef BURNISH_PROBE_ITEMS
#define BURNISH_PROBE_ITEMS

#include "shared/probe.h"

layout(local_size_x = PROBE_GROUP) in;
layout(constant_id = SPEC_PROBE_FUNCTION) const uint FUNCTION = 0u;
layout(push_constant) uniform Push {
    uint item_count;
    uint argument_count; // vec4 of an item
};
layout(std430, binding = BINDING_PROBE_ARGUMENTS) readonly buffer Arguments { vec4 arguments[]; };
layout(std430, binding = BINDING_PROBE_RESULTS) writeonly buffer Results { vec4 results[]; };

uint item() { return gl_GlobalInvocationID.x; }

// Arguments that were not given are zero.
vec4 argument(uint index) {
    return index < argument_count ? arguments[item() * argument_count + index] : vec4(0.0);
}
uvec4 bits(uint index) { return floatBitsToUint(argument(index)); }

void put(uint index, vec4 value) { results[item() * PROBE_RESULTS + index] = value; }
void put(vec4 value) { put(0u, value); }
void put(vec3 value) { put(0u, vec4(value, 0.0)); }
void put(vec2 value) { put(0u, vec4(value, 0.0, 0.0)); }
void put(float value) { put(0u, vec4(value)); }
void put(uvec2 value) { put(0u, uintBitsToFloat(uvec4(value, 0u, 0u))); }
void put(uint value) { put(0u, uintBitsToFloat(uvec4(value))); }
void put(mat3 frame) {
    for (uint column = 0u; column < 3u; ++column)
        put(column, vec4(frame[column], 0.0));
}

void run();

void main() {
    if (item() >= item_count) return;
    run();
}

#endif
