// The variance-matched sampler in the plane of any lobe, placed at a point: what depends on the model is
// asked of it. Lobes of fixed half-vectors have a shorter way, shade/matched.glsl.
#ifndef BURNISH_SHADE_MATCHED_IN_PLANE
#define BURNISH_SHADE_MATCHED_IN_PLANE

#include "shade/matched.glsl"

// A mixture's place at one point: y1 axis1 + y2 axis2 is a place of the lobe's plane.
struct PlaneMixture {
    LobeShape shape;
    vec2 axis1, axis2; // unit
    float inverse_rho; // a component of width s has a deviation of s/rho in y1, of s in y2
    float window;      // 1/(2 R^2) of the density that the mixture stands for
    float window_share;
    float linear; // level_share times the variance of a component with s = 1 where nothing is stretched
    float share;  // of level 1's variance, for a variance of 1: see spherical_level
    int row;      // its first entry in the table
    vec2 fresnel; // F = x + y (1 - o.h)^5 over all channels
};

// Principal axes of a linear map to the sphere, of which `map` holds the columns. Those of a round lobe are
// the plane of view and across it, whichever is longer: around the normal of a wide one that changes, and a
// step would show.
void set_axes(inout PlaneMixture view, mat2x3 map, vec3 local_o) {
    float p = dot(map[0], map[0]), s = dot(map[1], map[1]), off = dot(map[0], map[1]);
    float area = length(cross(map[0], map[1]));
    float half_difference = 0.5 * (p - s);
    float radius = sqrt(half_difference * half_difference + off * off);
    vec2 e = view_plane(local_o).xy;
    if (view.shape.width.x == view.shape.width.y) {
        view.axis1 = e;
        vec3 along = e.x * map[0] + e.y * map[1];
        view.inverse_rho = min(area / max(dot(along, along), 1e-30), 1.0);
    } else {
        view.inverse_rho = min(area / max(0.5 * (p + s) + radius, 1e-30), 1.0);
        // Half the angle whose cosine is half_difference/radius, from its larger part: no cancellation.
        bool is_round = radius <= 1e-7 * (p + s);
        float cosine = is_round ? 1.0 : half_difference / radius;
        float larger = sqrt(0.5 + 0.5 * abs(cosine));
        float smaller = is_round ? 0.0 : 0.5 * off / (radius * larger);
        view.axis1 = cosine >= 0.0 ? vec2(larger, smaller) : vec2(abs(smaller), off < 0.0 ? -larger : larger);
    }
    view.axis2 = vec2(-view.axis1.y, view.axis1.x);
}

PlaneMixture place_mixture(LobeView v, uint table_begin, float level_share, vec3 specular, vec3 grazing) {
    PlaneMixture view;
    view.shape = shape_of(v);
    set_axes(view, lobe_linear_map(view.shape, v.local_o), v.local_o);
    float rho = 1.0 / view.inverse_rho;
    float width = max(v.roughness.x, v.roughness.y);
    bool has_windows = has_tail(v.model);
    bool is_second = has_windows && width > MATCHED_SECOND_WINDOW_WIDTH;
    bool is_third = has_windows && width > MATCHED_THIRD_WINDOW_WIDTH;
    view.window = is_third    ? 0.5 / (MATCHED_THIRD_WINDOW * MATCHED_THIRD_WINDOW)
                  : is_second ? 0.5 / (MATCHED_SECOND_WINDOW * MATCHED_SECOND_WINDOW)
                              : 0.0;
    view.window_share = is_third ? MATCHED_THIRD_WINDOW_SHARE : is_second ? MATCHED_SECOND_WINDOW_SHARE : 1.0;
    const int window_rows = int(MATCHED_ROWS * ((SAMPLE_COUNT + 1u) / 2u));
    view.row = int(table_begin) + (int(is_second) + int(is_third)) * window_rows + mixture_row(rho);
    view.share = level_share;
    view.linear = level_share * variance_share(v.roughness, rho) * view.inverse_rho;
    view.fresnel = grey_fresnel(specular, grazing);
    return view;
}

// Adds what the point `place` of a component reflects; gives the stretch there.
float add_place(LobeView v, PlaneMixture view, vec2 place, float share, inout Component component) {
    LobePoint point = lobe_at(view.shape, v.local_o, place);
    float ratio = view.window_share * exp(min(view.window * dot(place, place), MATCHED_MOST_WINDOW_EXPONENT));
    // A component below the horizon has a direction and next to no weight.
    const float trace = 1e-8;
    float weight = share * ratio * max(point.base, trace);
    component.base += weight;
    if (HAS_FRESNEL) {
        float schlick = schlick_weight(point.cos_d);
        component.schlick += weight * schlick;
        weight *= view.fresnel.x + view.fresnel.y * schlick;
    }
    component.gain += weight;
    component.direction += weight * point.omega_i;
    return point.stretch;
}

// A component by its centre and four corners at sqrt(1.2) deviations, as place_wide.
Lookup place_component(LobeView v, PlaneMixture view, vec2 center, float s, float weight) {
    vec2 along = (1.0954451 * s * view.inverse_rho) * view.axis1, across = (1.0954451 * s) * view.axis2;
    Component component = Component(0.0, 0.0, 0.0, vec3(0.0));
    float stretch = add_place(v, view, center, 4.0 / 24.0, component);
    add_place(v, view, center - across - along, 5.0 / 24.0, component);
    add_place(v, view, center + across - along, 5.0 / 24.0, component);
    add_place(v, view, center - across + along, 5.0 / 24.0, component);
    add_place(v, view, center + across + along, 5.0 / 24.0, component);
    component.direction = v.frame * component.direction;
    return finish_component(v, view.share, component, weight, min(s * s * view.linear * stretch, view.share));
}

void place_pair(LobeView v, PlaneMixture view, vec4 entry, out Lookup one, out Lookup other) {
    vec2 center = entry.x * view.axis1 + entry.y * view.axis2;
    one = place_component(v, view, center, entry.z, entry.w);
    other = place_component(v, view, -center, entry.z, entry.w);
}

LobeSums gather_matched(LobeView v, PlaneMixture view) { GATHER_MIXTURE }

#endif
