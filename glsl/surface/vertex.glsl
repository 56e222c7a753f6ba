// Places a triangle's corner in the picture and its frame in the world: what every vertex of the surface pass
// does.
#ifndef BURNISH_SURFACE_VERTEX
#define BURNISH_SURFACE_VERTEX

#include "lib/frame.glsl"
#include "shared/constants.h"
#include "shared/records.h"

layout(constant_id = SPEC_SURFACE_TANGENT) const bool HAS_TANGENT = false;

layout(push_constant) uniform Push { DrawRecord draw; };
layout(std430, binding = BINDING_SURFACE_VIEW) readonly buffer Views { ViewRecord view; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec4
    normal_tangent; // octahedral normal, diamond angle of the tangent in its basis, handedness

layout(location = 0) out vec3 normal_world;
layout(location = 1) out vec4 tangent_world; // w: handedness

void place_vertex() {
    gl_Position = view.clip_from_world * (draw.world_from_object * vec4(position, 1.0));
    vec3 normal = octahedral_decode(normal_tangent.xy);
    mat3 normal_from_object =
        mat3(draw.normal_from_object_x.xyz, draw.normal_from_object_y.xyz, draw.normal_from_object_z.xyz);
    normal_world = normalize(normal_from_object * normal);
    tangent_world = vec4(1.0, 0.0, 0.0, 1.0);
    if (HAS_TANGENT) {
        mat3 basis = orthonormal_basis(normal);
        vec2 t = diamond_decode(normal_tangent.z);
        vec3 tangent = mat3(draw.world_from_object) * (t.x * basis[0] + t.y * basis[1]);
        tangent_world = vec4(normalize(tangent), normal_tangent.w * draw.normal_from_object_x.w);
    }
}

#endif
