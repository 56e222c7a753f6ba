// Any lobes by one lookup each in prefiltered maps.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "shade/shade.glsl"

vec3 look_up_lobe(LobeView v, SurfaceLobe lobe, LobeRecord record, vec2 albedo, MapRecord map) {
    return look_up_prefiltered(v, lobe, albedo, float(map.face_size));
}
