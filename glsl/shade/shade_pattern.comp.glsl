// Any lobes by patterns of half-vectors whose tables are read from a buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "shade/shade.glsl"

vec3 look_up_lobe(LobeView v, SurfaceLobe lobe, LobeRecord record, vec2 albedo, MapRecord map) {
    LobeSums sums = gather_pattern(v, record.table_begin, record.table_count);
    return finish_lobe(v, sums, lobe.specular, lobe.grazing, albedo);
}
