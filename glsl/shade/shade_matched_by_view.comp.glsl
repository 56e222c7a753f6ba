// Lobes by the variance-matched sampler, placed for every view when the material changed.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "shade/shade.glsl"

vec3 look_up_lobe(LobeView v, SurfaceLobe lobe, LobeRecord record, vec2 albedo, MapRecord map) {
    LobeSums sums = gather_by_view(v, record.table_begin, record.view_columns, record.view_drift);
    return finish_lobe(v, sums, lobe.specular, lobe.grazing, albedo);
}
