// What the shade kernels need of a surface whose material is the same everywhere: eight bytes.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/frame.glsl"
#include "shared/constants.h"
#include "shared/records.h"

layout(constant_id = SPEC_SURFACE_TANGENT) const bool HAS_TANGENT = false;
layout(constant_id = SPEC_DOUBLE_SIDED) const bool IS_DOUBLE_SIDED = false;

layout(push_constant) uniform Push { DrawRecord draw; };
layout(location = 0) in vec3 normal_world;
layout(location = 1) in vec4 tangent_world;
layout(location = 0) out uvec2 surface;

void main() {
    vec3 normal = normalize(normal_world);
    // Seen from behind the normal turns around, and tangent and bitangent stay: what is brushed lies on both
    // sides the same way.
    bool is_turned = IS_DOUBLE_SIDED && !gl_FrontFacing;
    if (is_turned) normal = -normal;
    if (HAS_TANGENT) {
        float handedness = is_turned ? -tangent_world.w : tangent_world.w;
        mat3 frame = frame_from_tangent(normal, tangent_world.xyz, handedness);
        surface = pack_surface(normal, frame[0], handedness, draw.material);
    } else {
        surface = pack_surface(normal, draw.material);
    }
}
