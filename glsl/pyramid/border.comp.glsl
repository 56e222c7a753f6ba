// Fills the border of one level: what lies beyond an edge is folded over it, as deep inside the neighbouring
// face as it is outside of its own, at the same place along the edge. The corner blocks, beyond two edges,
// are set to zero: the reduction adds them by itself, in full precision. One invocation writes one pair of
// texels; z counts layers.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "pyramid/texels.glsl"
#include "lib/cube_map.glsl"

layout(local_size_x = 64) in;

// Exact in floats: coordinates of texel centres are multiples of 1/size, a power of two.
uvec2 load_folded(Level level, int layer, int x, int y) {
    int face = layer % 6;
    vec2 at = vec2(2 * x + 1, 2 * y + 1) / float(level.size) - 1.0;
    vec3 axis = cube_direction(uint(face), 0.0, 0.0);
    vec3 place = cube_direction(uint(face), at.x, at.y);
    float outside = max(max(abs(at.x), abs(at.y)) - 1.0, 0.0);
    vec2 uv;
    int source_face = int(cube_face_uv(clamp(place, -1.0, 1.0) - outside * axis, uv));
    ivec2 source = ivec2((uv + 1.0) * (0.5 * float(level.size)));
    return load_texel(level, layer - face + source_face, source.x, source.y);
}

void main() {
    Level level = source_level();
    int size = level.size;
    int layer = int(gl_GlobalInvocationID.z);
    int index = int(gl_GlobalInvocationID.x);
    if (index >= 4 * size + 8) return;

    // Left, right, above, below: `size` pairs each; then the corners, two pairs each.
    int side = index / size;
    int along = index % size;
    int half_size = size / 2;
    bool is_corner = side >= 4;
    int x, y;
    if (is_corner) {
        int corner = index - 4 * size;
        x = (corner & 1) == 0 ? -2 : size;
        y = (corner >> 1) < 2 ? -1 - (corner >> 1) : size + (corner >> 1) - 2;
    } else if (side < 2) {
        x = side == 0 ? -2 : size;
        y = along;
    } else {
        x = 2 * (along % half_size);
        y = side == 2 ? -1 - along / half_size : size + along / half_size;
    }
    uvec4 pair = uvec4(load_folded(level, layer, x, y), load_folded(level, layer, x + 1, y));
    store_pair(pair_index(level, layer, x, y), is_corner ? uvec4(0u) : pair);
}
