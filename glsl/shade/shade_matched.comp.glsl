// Any lobes by the variance-matched sampler, placed at every point.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "shade/shade.glsl"
#include "shade/matched_in_plane.glsl"

vec3 look_up_lobe(LobeView v, SurfaceLobe lobe, LobeRecord record, vec2 albedo, MapRecord map) {
    if (!has_fixed_half_vectors(v.model)) {
        PlaneMixture mixture =
            place_mixture(v, record.table_begin, record.level_share, lobe.specular, lobe.grazing);
        return finish_lobe(v, gather_matched(v, mixture), lobe.specular, lobe.grazing, albedo);
    }
    MixtureView view = view_mixture(v, record.table_begin, record.level_share, lobe.specular, lobe.grazing);
    return finish_lobe(v, gather_matched(v, view), lobe.specular, lobe.grazing, albedo);
}
