// One resource of every kind the Vulkan layer can bind: reflection and descriptor sets are tested with it.
#version 460

layout(local_size_x = 4, local_size_y = 2) in;

layout(push_constant) uniform Push {
    mat4 transform; // bytes 0..63
    vec2 scale;     // 64..71
    float bias;     // 72..75
};
layout(std140, binding = 1) uniform Settings { vec4 offset; };
layout(binding = 3) uniform samplerCubeArray cubes;
layout(binding = 4) uniform sampler2D pictures[2];
layout(binding = 5, rgba32f) uniform writeonly image2DArray picture_out;
layout(binding = 6) uniform isamplerBuffer texels_in;
layout(binding = 7, r32ui) uniform writeonly uimageBuffer texels_out;
layout(std430, binding = 9) buffer Results { vec4 results[]; };

void main() {
    vec4 sum = textureLod(cubes, vec4(1.0, 0.0, 0.0, 1.0), 0.0);
    sum += textureLod(pictures[0], vec2(0.5), 0.0) + textureLod(pictures[1], vec2(0.5), 0.0);
    sum += vec4(texelFetch(texels_in, int(gl_LocalInvocationIndex)));
    sum = transform * sum * vec4(scale, 1.0, 1.0) + offset + bias;
    imageStore(picture_out, ivec3(gl_LocalInvocationID), sum);
    imageStore(texels_out, int(gl_LocalInvocationIndex), uvec4(uint(sum.x)));
    results[gl_LocalInvocationIndex] = sum;
}
