// Radiance of one lobe by the variance-matched sampler, from a table of samples that were placed for every view when the material
// changed (build_matched_view_table): what is left to do at a point is to turn them to its mirror direction.
#ifndef BURNISH_SHADE_MATCHED_BY_VIEW
#define BURNISH_SHADE_MATCHED_BY_VIEW

#include "shade/matched.glsl"

// (T1, T2, I): the mirror direction I, T1 across it in the plane of view `e`, T2 across both. Environment space.
mat3 mirror_frame(LobeView v, vec3 e) {
    vec3 plane = e.x * v.frame[0] + e.y * v.frame[1];
    return mat3(v.local_o.z * plane + e.z * v.frame[2], e.x * v.frame[1] - e.y * v.frame[0], 2.0 * v.local_o.z * v.frame[2] - v.omega_o);
}

// The entry's lookup at this view: see build_matched_view_table.
Lookup place_by_view(mat3 axes, float layer, vec4 entry, float schlick) {
    Lookup lookup;
    vec3 direction = entry.x * axes[0] + entry.y * axes[1] + (0.5 - 0.5 * dot(entry.xy, entry.xy)) * axes[2];
    lookup.aim = aim_at_map(direction, layer, entry.w);
    lookup.weight = entry.z;
    lookup.schlick = schlick;
    lookup.density = 0.0;
    return lookup;
}

#define VIEW_ENTRY(k) imageLoad(sample_table, row + k)
#define PLACE_BY_VIEW(k, c, lookup) if (SAMPLE_COUNT > uint(k)) lookup = place_by_view(axes, v.layer, VIEW_ENTRY(k), schlick[c]);
#define GATHER_BY_VIEW(a, b, c, d)                                                                                     \
    if (HAS_FRESNEL && SAMPLE_COUNT > uint(a)) schlick = VIEW_ENTRY(int(SAMPLE_COUNT) + a / 4);                        \
    PLACE_BY_VIEW(a, 0, l0) PLACE_BY_VIEW(b, 1, l1) PLACE_BY_VIEW(c, 2, l2) PLACE_BY_VIEW(d, 3, l3)                    \
    ADD(a, l0) ADD(b, l1) ADD(c, l2) ADD(d, l3)

// Axes of a table by view, and its row nearest to the view: see build_matched_view_table.
mat3 axes_by_view(LobeView v, uint azimuths, out int row) {
    vec3 plane = view_plane(v.local_o);
    mat3 axes = mirror_frame(v, plane);
    float root = sqrt(clamp(v.local_o.z, 0.0, 1.0));
    if (!HAS_TANGENT) {
        row = int(root * float(MATCHED_ROWS - 1u) + 0.5);
        return axes;
    }
    bool is_round = azimuths == 1u;
    vec2 e = plane.y < 0.0 ? -plane.xy : plane.xy;
    float azimuth = is_round ? 0.0 : (0.5 - 0.5 * e.x / (abs(e.x) + e.y)) * float(MATCHED_AZIMUTHS - 1u);
    float view = root * float((is_round ? MATCHED_ROWS : MATCHED_BRUSHED_VIEWS) - 1u);
    row = int(view + 0.5) * int(azimuths) + int(azimuth + 0.5);
    vec2 turn = is_round ? vec2(1.0, 0.0) : e;
    return mat3(turn.x * axes[0] - turn.y * axes[1], turn.y * axes[0] + turn.x * axes[1], axes[2]);
}

LobeSums gather_by_view(LobeView v, uint table_begin, uint azimuths) {
    LobeSums sums = LobeSums(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    const uint entries = SAMPLE_COUNT + (HAS_FRESNEL ? (SAMPLE_COUNT + 3u) / 4u : 0u);
    int row;
    mat3 axes = axes_by_view(v, azimuths, row);
    row = int(table_begin) + int(entries) * row;
    vec4 schlick = vec4(0.0);
    Lookup l0, l1, l2, l3;
    GATHER_BY_VIEW(0, 1, 2, 3) GATHER_BY_VIEW(4, 5, 6, 7) GATHER_BY_VIEW(8, 9, 10, 11) GATHER_BY_VIEW(12, 13, 14, 15)
    GATHER_BY_VIEW(16, 17, 18, 19) GATHER_BY_VIEW(20, 21, 22, 23) GATHER_BY_VIEW(24, 25, 26, 27) GATHER_BY_VIEW(28, 29, 30, 31)
    GATHER_BY_VIEW(32, 33, 34, 35) GATHER_BY_VIEW(36, 37, 38, 39) GATHER_BY_VIEW(40, 41, 42, 43) GATHER_BY_VIEW(44, 45, 46, 47)
    GATHER_BY_VIEW(48, 49, 50, 51) GATHER_BY_VIEW(52, 53, 54, 55) GATHER_BY_VIEW(56, 57, 58, 59) GATHER_BY_VIEW(60, 61, 62, 63)
    return sums;
}

#endif
