// Records as the surface pass reads them: rows of 16 bytes from texel buffers, as in shade/records.glsl.
// Members of a record in a storage buffer were a quarter of the pass.
#ifndef BURNISH_SURFACE_RECORDS
#define BURNISH_SURFACE_RECORDS

#include "shared/constants.h"
#include "shared/records.h"

layout(binding = BINDING_SURFACE_MATERIALS, rgba32ui) uniform readonly uimageBuffer surface_rows;
layout(binding = BINDING_SURFACE_TEXTURE_RECORDS, rgba32ui) uniform readonly uimageBuffer texture_rows;

#define ROW(rows, record, row) imageLoad(rows, int(record##_ROWS) * int(index) + row)

SurfaceRecord load_surface(uint index) {
    SurfaceRecord surface;
    surface.base_color = uintBitsToFloat(ROW(surface_rows, SURFACE, 0));
    surface.emissive = uintBitsToFloat(ROW(surface_rows, SURFACE, 1));
    surface.specular = uintBitsToFloat(ROW(surface_rows, SURFACE, 2));
    uvec4 row = ROW(surface_rows, SURFACE, 3);
    surface.metallic = uintBitsToFloat(row.x);
    surface.roughness = uintBitsToFloat(row.y);
    surface.anisotropy = uintBitsToFloat(row.z);
    surface.clearcoat = uintBitsToFloat(row.w);
    row = ROW(surface_rows, SURFACE, 4);
    surface.clearcoat_roughness = uintBitsToFloat(row.x);
    surface.normal_scale = uintBitsToFloat(row.y);
    surface.occlusion_strength = uintBitsToFloat(row.z);
    surface.texture_begin = row.w;
    row = ROW(surface_rows, SURFACE, 5);
    surface.clearcoat_normal_scale = uintBitsToFloat(row.x);
    surface.is_layered = uintBitsToFloat(row.y);
    return surface;
}

TextureRecord load_texture(uint index) {
    TextureRecord record;
    record.scale_rotation = uintBitsToFloat(ROW(texture_rows, TEXTURE, 0));
    uvec4 row = ROW(texture_rows, TEXTURE, 1);
    record.offset = uintBitsToFloat(row.xy);
    record.uv_set = row.z;
    record.coverage_levels = row.w;
    return record;
}

#endif
