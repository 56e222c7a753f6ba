// A triangle that covers everything, at the depth it is told. Tests rendering in the Vulkan layer.
#version 460

layout(push_constant) uniform Push {
    vec4 color;
    float depth; // reverse z: 1 near, 0 far
};

void main() {
    vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    gl_Position = vec4(corner * 4.0 - 1.0, depth, 1.0);
}
