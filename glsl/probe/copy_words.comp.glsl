// Copies words, changed by every kind of specialization constant and by a push constant. Tests the Vulkan
// layer itself.
#version 460

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint FACTOR = 1u;
layout(constant_id = 2) const int ADDEND = 0;
layout(constant_id = 3) const float SCALE = 1.0;
layout(constant_id = 4) const bool INVERT = false;

layout(push_constant) uniform Push {
    uint word_count;
    uint first_value; // added to every word
};
layout(std430, binding = 0) readonly buffer Source { uint source_words[]; };
layout(std430, binding = 1) writeonly buffer Target { uint target_words[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= word_count) return;
    uint value = uint(float(source_words[i] * FACTOR + uint(ADDEND)) * SCALE) + first_value;
    target_words[i] = INVERT ? ~value : value;
}
