// Records as shade kernels read them: rows of 16 bytes from texel buffers. A CPU device loads such a row at
// once, while each member of a record in a storage buffer is a gather of its own (measured: a quarter of the
// cost of a pixel without its samples).
#ifndef BURNISH_SHADE_RECORDS
#define BURNISH_SHADE_RECORDS

#include "shared/constants.h"
#include "shared/records.h"

layout(binding = BINDING_VIEW, rgba32ui) uniform readonly uimageBuffer view_rows;
layout(binding = BINDING_MATERIALS, rgba32ui) uniform readonly uimageBuffer material_rows;
layout(binding = BINDING_LOBES, rgba32ui) uniform readonly uimageBuffer lobe_rows;
layout(binding = BINDING_MAP_RECORDS, rgba32ui) uniform readonly uimageBuffer map_rows;
layout(binding = BINDING_LIGHTS, rgba32ui) uniform readonly uimageBuffer light_rows;

#define ROW(rows, record, row) imageLoad(rows, int(record##_ROWS) * int(index) + row)

// Without clip_from_world.
ViewRecord load_view() {
    ViewRecord view;
    view.ray_corner = uintBitsToFloat(imageLoad(view_rows, 4));
    view.ray_dx = uintBitsToFloat(imageLoad(view_rows, 5));
    view.ray_dy = uintBitsToFloat(imageLoad(view_rows, 6));
    uvec4 row = imageLoad(view_rows, 7);
    view.width_px = row.x;
    view.height_px = row.y;
    view.background_map = row.z;
    return view;
}

mat4 load_world_from_picture() {
    return mat4(uintBitsToFloat(imageLoad(view_rows, 8)), uintBitsToFloat(imageLoad(view_rows, 9)),
                uintBitsToFloat(imageLoad(view_rows, 10)), uintBitsToFloat(imageLoad(view_rows, 11)));
}

MaterialRecord load_material(uint index) {
    MaterialRecord material;
    material.diffuse = uintBitsToFloat(ROW(material_rows, MATERIAL, 0));
    material.emissive = uintBitsToFloat(ROW(material_rows, MATERIAL, 1));
    uvec4 row = ROW(material_rows, MATERIAL, 2);
    material.lobe_begin = row.x;
    material.lobe_count = row.y;
    material.map = row.z;
    material.shade_class = row.w;
    return material;
}

LobeRecord load_lobe(uint index) {
    LobeRecord lobe;
    lobe.specular = uintBitsToFloat(ROW(lobe_rows, LOBE, 0));
    lobe.grazing = uintBitsToFloat(ROW(lobe_rows, LOBE, 1));
    uvec4 row = ROW(lobe_rows, LOBE, 2);
    lobe.alpha = uintBitsToFloat(row.x);
    lobe.rotation_cos = uintBitsToFloat(row.y);
    lobe.rotation_sin = uintBitsToFloat(row.z);
    lobe.table_begin = row.w;
    row = ROW(lobe_rows, LOBE, 3);
    lobe.table_count = row.x;
    lobe.albedo_begin = row.y;
    lobe.albedo_width_nodes = row.z;
    lobe.threshold_log = uintBitsToFloat(row.w);
    row = ROW(lobe_rows, LOBE, 4);
    lobe.energy = row.x;
    lobe.level_share = uintBitsToFloat(row.y);
    lobe.view_columns = row.z;
    lobe.view_drift = row.w;
    lobe.cover = uintBitsToFloat(ROW(lobe_rows, LOBE, 5));
    lobe.own = uintBitsToFloat(ROW(lobe_rows, LOBE, 6));
    return lobe;
}

MapRecord load_map_record(uint index) {
    MapRecord map;
    map.env_from_world_x = uintBitsToFloat(ROW(map_rows, MAP, 0));
    map.env_from_world_y = uintBitsToFloat(ROW(map_rows, MAP, 1));
    map.env_from_world_z = uintBitsToFloat(ROW(map_rows, MAP, 2));
    [[unroll]] for (int k = 0; k < 9; ++k) map.irradiance[k] = uintBitsToFloat(ROW(map_rows, MAP, 3 + k));
    uvec4 row = ROW(map_rows, MAP, 12);
    map.radiance_scale = uintBitsToFloat(row.x);
    map.layer = row.y;
    map.face_size = row.z;
    map.alias_begin = row.w;
    [[unroll]] for (int k = 0; k < 2 * int(MAX_SUNS); ++k) {
        map.suns[k] = uintBitsToFloat(ROW(map_rows, MAP, 13 + k));
    }
    return map;
}

LightRecord load_light(uint index) {
    LightRecord light;
    light.place = uintBitsToFloat(ROW(light_rows, LIGHT, 0));
    light.intensity = uintBitsToFloat(ROW(light_rows, LIGHT, 1));
    light.axis = uintBitsToFloat(ROW(light_rows, LIGHT, 2));
    light.cone = uintBitsToFloat(ROW(light_rows, LIGHT, 3));
    return light;
}

#endif
