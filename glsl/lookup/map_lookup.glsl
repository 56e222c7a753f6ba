// How kernels read maps. One function, two implementations: the device's sampler, and our own lookup for CPU
// devices, whose sampler takes most of a frame (cpp/burnish/render/texel_pairs.h). Both are seamless and
// trilinear. A lookup has two halves, aim and load, so that a kernel can aim several before it loads: a CPU
// then overlaps their loads.
#ifndef BURNISH_LOOKUP_MAP_LOOKUP
#define BURNISH_LOOKUP_MAP_LOOKUP

#include "shared/constants.h"

layout(constant_id = SPEC_LOOKUP) const uint LOOKUP = LOOKUP_SAMPLER;
layout(constant_id = SPEC_LAST_LEVEL) const
    int LAST_LEVEL = 0; // of the faces: log2 of their size; pairs only

layout(binding = BINDING_MAPS) uniform samplerCubeArray maps;
layout(binding = BINDING_MAP_PAIRS, rgba32ui) uniform readonly uimageBuffer map_pairs;
layout(std430, binding = BINDING_STORED_PAIRS) readonly buffer StoredPairs { uvec4 stored_pairs[]; };

// Where one bilinear lookup lands.
struct PairAim {
    int at; // pair above; the one below lies a pitch further
    int pitch;
    vec2 fraction; // toward the right texel, toward the row below
};

struct MapAim {
    vec3 direction; // any length but zero
    float level;
    float layer;
    PairAim fine, coarse;
    float coarse_share;
};

// Pairs of all levels before this one, of size s: 6 (n + 1)(n + 2) each add up to this, since every level is
// half as large.
int pairs_before(int level, int s) {
    const int n = 1 << LAST_LEVEL;
    return n * (8 * n + 36) - s * (8 * s + 36) + 12 * level;
}

int cube_pairs_begin(float layer) {
    const int n = 1 << LAST_LEVEL;
    const int pairs_of_cube = n * (8 * n + 36) - 20 + 12 * (LAST_LEVEL + 1);
    return int(layer) * pairs_of_cube;
}

// Where a direction meets the cube.
struct CubePlace {
    vec3 direction;        // any length but zero
    float inverse_largest; // 1 / |direction|_inf
    vec2 uv;               // software: on the face, -1..1, in the orientation of the pairs
    float face;
};

// Of equal components z wins, then y.
CubePlace place_on_cube(vec3 direction) {
    CubePlace place;
    place.direction = direction;
    vec3 a = abs(direction);
    bool is_y = a.y >= a.x;
    float side = is_y ? a.y : a.x;
    bool is_z = a.z >= side;
    place.inverse_largest = 1.0 / (is_z ? a.z : side);
    float axis = is_z ? direction.z : is_y ? direction.y : direction.x;
    vec2 along = is_z ? direction.xy : is_y ? direction.xz : direction.zy;
    place.uv = along * place.inverse_largest;
    place.face = (is_z ? 4.0 : is_y ? 2.0 : 0.0) + (axis < 0.0 ? 1.0 : 0.0);
    return place;
}

PairAim aim_pairs(CubePlace cube, int cube_begin, int level) {
    float s = intBitsToFloat((127 + LAST_LEVEL - level) << 23);
    float half_size = 0.5 * s;
    vec2 place = cube.uv * half_size + (half_size + 0.5); // texel k lies at k + 1, behind the border
    ivec2 texel = ivec2(place);
    PairAim aim;
    aim.pitch = int(s) + 1;
    // In integers: a cube of faces of 2048 has more pairs than a float32 can count.
    aim.at = cube_begin + pairs_before(level, int(s)) +
             (int(cube.face) * (aim.pitch + 1) + texel.y) * aim.pitch + texel.x;
    aim.fraction = place - vec2(texel);
    return aim;
}

MapAim aim_at_map(CubePlace place, float layer, float level) {
    MapAim aim;
    aim.direction = place.direction;
    aim.level = level;
    aim.layer = layer;
    if (LOOKUP != LOOKUP_SAMPLER) {
        float last = float(LAST_LEVEL);
        float clamped = level > 0.0 ? level : 0.0;
        clamped = clamped < last ? clamped : last;
        int fine = int(clamped);
        int begin = cube_pairs_begin(layer);
        aim.fine = aim_pairs(place, begin, fine);
        aim.coarse = aim_pairs(place, begin, fine < LAST_LEVEL ? fine + 1 : LAST_LEVEL);
        aim.coarse_share = clamped - float(fine);
    }
    return aim;
}

MapAim aim_at_map(vec3 direction, float layer, float level) {
    return aim_at_map(place_on_cube(direction), layer, level);
}

uvec4 load_pair(int k) {
    if (LOOKUP == LOOKUP_STORAGE) return stored_pairs[k];
    return imageLoad(map_pairs, k);
}

vec3 load_pairs(PairAim aim) {
    uvec4 above = load_pair(aim.at), below = load_pair(aim.at + aim.pitch);
    vec2 r = unpackHalf2x16(above.r), g = unpackHalf2x16(above.g), b = unpackHalf2x16(above.b);
    r += aim.fraction.y * (unpackHalf2x16(below.r) - r);
    g += aim.fraction.y * (unpackHalf2x16(below.g) - g);
    b += aim.fraction.y * (unpackHalf2x16(below.b) - b);
    vec3 left = vec3(r.x, g.x, b.x);
    return left + aim.fraction.x * (vec3(r.y, g.y, b.y) - left);
}

vec3 load_map(MapAim aim) {
    if (LOOKUP == LOOKUP_SAMPLER) return textureLod(maps, vec4(aim.direction, aim.layer), aim.level).rgb;
    vec3 fine = load_pairs(aim.fine);
    return fine + aim.coarse_share * (load_pairs(aim.coarse) - fine);
}

// Of level 0 alone.
vec3 look_up_finest(vec3 direction, float layer) {
    if (LOOKUP == LOOKUP_SAMPLER) return textureLod(maps, vec4(direction, layer), 0.0).rgb;
    return load_pairs(aim_pairs(place_on_cube(direction), cube_pairs_begin(layer), 0));
}

#endif
