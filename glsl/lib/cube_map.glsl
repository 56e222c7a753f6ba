// Cube faces in Vulkan's order and orientation.
#ifndef BURNISH_LIB_CUBE_MAP
#define BURNISH_LIB_CUBE_MAP

// Direction (not normalised, largest component 1) through (u, v) in [-1, 1]^2 of a face.
vec3 cube_direction(uint face, float u, float v) {
    switch (face) {
    case 0u: return vec3(1.0, -v, -u);
    case 1u: return vec3(-1.0, -v, u);
    case 2u: return vec3(u, 1.0, v);
    case 3u: return vec3(u, -1.0, -v);
    case 4u: return vec3(u, -v, 1.0);
    default: return vec3(-u, -v, -1.0);
    }
}

// Face that a direction meets, and where. Of equal components z wins, then y, as on most hardware.
uint cube_face_uv(vec3 direction, out vec2 uv) {
    vec3 a = abs(direction);
    if (a.z >= a.x && a.z >= a.y) {
        uv = vec2(direction.z > 0.0 ? direction.x : -direction.x, -direction.y) / a.z;
        return direction.z > 0.0 ? 4u : 5u;
    }
    if (a.y >= a.x) {
        uv = vec2(direction.x, direction.y > 0.0 ? direction.z : -direction.z) / a.y;
        return direction.y > 0.0 ? 2u : 3u;
    }
    uv = vec2(direction.x > 0.0 ? -direction.z : direction.z, -direction.y) / a.x;
    return direction.x > 0.0 ? 0u : 1u;
}

// r = |w| / |w|_inf: how far the cube lies out of the unit sphere in direction w. A texel of a face of
// `face_texels` covers 4 / (face_texels r^3): the face's area of 4, shrunk by the squared distance and by the
// slant.
float cube_stretch(vec3 w) {
    vec3 a = abs(w);
    return length(w) / max(max(a.x, a.y), a.z);
}

float texel_solid_angle(float face_texels, vec3 w) {
    float r = cube_stretch(w);
    return 4.0 / (face_texels * r * r * r);
}

#endif
