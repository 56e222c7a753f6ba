// Radiance of one lobe by the variance-matched sampler, from a table of samples that were placed for every
// view when the material changed (build_matched_view_table): what is left to do at a point is to mirror its
// view at their half-vectors.
#ifndef BURNISH_SHADE_MATCHED_BY_VIEW
#define BURNISH_SHADE_MATCHED_BY_VIEW

#include "shade/matched.glsl"

// What a table's slopes refer to at a point, and its row nearest to the view.
struct TableView {
    vec3 axis1, axis2; // environment space, unit, across the normal
    vec2 o;            // the view along them
    vec2 offset;       // drift of all slopes with the view
    int row;
};

TableView view_of_table(LobeView v, uint columns) {
    // 0 along the normal, 1 at the horizon; rows are even in it.
    float cos_o = clamp(v.local_o.z, 0.0, 1.0);
    float radius = sqrt(max(1.0 - 0.5 * (cos_o + sqrt(cos_o)), 0.0));
    TableView view;
    if (HAS_TANGENT && columns > 1u) {
        // A view from the other side is half a turn away.
        float side = v.local_o.y < 0.0 ? -1.0 : 1.0;
        view.axis1 = side * v.frame[0];
        view.axis2 = side * v.frame[1];
        view.o = side * v.local_o.xy;
        // The disc of views on a square: along a ray from the middle, the normal, to the edge, the horizon.
        const float last = float(MATCHED_VIEW_NODES - 1u);
        vec2 node =
            view.o * (last * radius / max(max(abs(view.o.x), view.o.y), 1e-20)) + vec2(last + 0.5, 0.5);
        view.row = int(node.y) * int(columns) + int(node.x);
        return view;
    }
    vec3 plane = view_plane(v.local_o);
    view.axis1 = plane.x * v.frame[0] + plane.y * v.frame[1];
    view.axis2 = plane.x * v.frame[1] - plane.y * v.frame[0];
    view.o = vec2(plane.z, 0.0);
    view.row = int(radius * float(MATCHED_ROWS - 1u) + 0.5);
    return view;
}

// The half-vector g = n + slope mirrors the view to 2 (o.g) g - |g|^2 o, whose part along the normal is |g|^2
// cos_i. The weights of entries lack that to the power of 1 - alpha: it changes most from view to view.
Lookup place_by_view(LobeView v, TableView view, vec4 entry, float schlick) {
    Lookup lookup;
    vec2 slope = entry.xy + view.offset;
    vec3 g = v.frame[2] + slope.x * view.axis1 + slope.y * view.axis2;
    float twice_og = 2.0 * (v.local_o.z + dot(slope, view.o));
    float length2 = 1.0 + dot(slope, slope);
    lookup.aim = aim_at_map(twice_og * g - length2 * v.omega_o, v.layer, entry.w);
    lookup.weight = entry.z * lit_power(twice_og - length2 * v.local_o.z, v.alpha);
    lookup.schlick = schlick;
    lookup.density = 0.0;
    return lookup;
}

// Unrolled by hand: SAMPLE_COUNT is a constant, so what lies beyond it is not compiled.
// clang-format off
#define VIEW_ENTRY(k) sample_entry(row + k)
#define PLACE_BY_VIEW(k, c, lookup)                                                                          \
    if (SAMPLE_COUNT > uint(k)) lookup = place_by_view(v, view, VIEW_ENTRY(k), schlick[c]);
#define ADD(k, lookup) if (SAMPLE_COUNT > uint(k)) add_lookup(sums, lookup);
#define GATHER_BY_VIEW(a, b, c, d)                                                                           \
    if (HAS_FRESNEL && SAMPLE_COUNT > uint(a)) schlick = VIEW_ENTRY(int(SAMPLE_COUNT) + a / 4);              \
    PLACE_BY_VIEW(a, 0, l0) PLACE_BY_VIEW(b, 1, l1) PLACE_BY_VIEW(c, 2, l2) PLACE_BY_VIEW(d, 3, l3)          \
    ADD(a, l0) ADD(b, l1) ADD(c, l2) ADD(d, l3)
// clang-format on

LobeSums gather_by_view(LobeView v, uint table_begin, uint columns, uint drift) {
    LobeSums sums = LobeSums(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    const uint entries = SAMPLE_COUNT + (HAS_FRESNEL ? (SAMPLE_COUNT + 3u) / 4u : 0u);
    TableView view = view_of_table(v, columns);
    view.offset = unpackHalf2x16(drift) * view.o;
    int row = int(table_begin) + int(entries) * view.row;
    vec4 schlick = vec4(0.0);
    Lookup l0, l1, l2, l3;
    // clang-format off
    GATHER_BY_VIEW(0, 1, 2, 3) GATHER_BY_VIEW(4, 5, 6, 7) GATHER_BY_VIEW(8, 9, 10, 11)
    GATHER_BY_VIEW(12, 13, 14, 15) GATHER_BY_VIEW(16, 17, 18, 19) GATHER_BY_VIEW(20, 21, 22, 23)
    GATHER_BY_VIEW(24, 25, 26, 27) GATHER_BY_VIEW(28, 29, 30, 31) GATHER_BY_VIEW(32, 33, 34, 35)
    GATHER_BY_VIEW(36, 37, 38, 39) GATHER_BY_VIEW(40, 41, 42, 43) GATHER_BY_VIEW(44, 45, 46, 47)
    GATHER_BY_VIEW(48, 49, 50, 51) GATHER_BY_VIEW(52, 53, 54, 55) GATHER_BY_VIEW(56, 57, 58, 59)
    GATHER_BY_VIEW(60, 61, 62, 63)
    return sums;
    // clang-format on
}

#endif
