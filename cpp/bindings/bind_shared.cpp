// Where C++ believes the fields of the shared structs lie, for the test that asks the shaders the same.
#include <cstddef>
#include <map>
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "shared/prefilter.h"
#include "shared/pyramid.h"
#include "shared/records.h"

namespace py = pybind11;

namespace burnish {
namespace {

using Layout = std::map<std::string, size_t>;
using namespace shared;

#define FIELD(record, name)                                                                                  \
    { #name, offsetof(record, name) }

std::map<std::string, Layout> shared_layout() {
    return {
        {"LobeRecord",
         {FIELD(LobeRecord, specular), FIELD(LobeRecord, grazing), FIELD(LobeRecord, alpha),
          FIELD(LobeRecord, rotation_cos), FIELD(LobeRecord, rotation_sin), FIELD(LobeRecord, table_begin),
          FIELD(LobeRecord, table_count), FIELD(LobeRecord, albedo_begin),
          FIELD(LobeRecord, albedo_width_nodes), FIELD(LobeRecord, threshold_log), FIELD(LobeRecord, energy),
          FIELD(LobeRecord, level_share), FIELD(LobeRecord, view_columns), FIELD(LobeRecord, view_drift),
          FIELD(LobeRecord, cover), FIELD(LobeRecord, own)}},
        {"MaterialRecord",
         {FIELD(MaterialRecord, diffuse), FIELD(MaterialRecord, emissive), FIELD(MaterialRecord, lobe_begin),
          FIELD(MaterialRecord, lobe_count), FIELD(MaterialRecord, map), FIELD(MaterialRecord, shade_class)}},
        {"MapRecord",
         {FIELD(MapRecord, env_from_world_x), FIELD(MapRecord, env_from_world_y),
          FIELD(MapRecord, env_from_world_z), FIELD(MapRecord, irradiance), FIELD(MapRecord, radiance_scale),
          FIELD(MapRecord, layer), FIELD(MapRecord, face_size), FIELD(MapRecord, alias_begin),
          FIELD(MapRecord, suns)}},
        {"LightRecord",
         {FIELD(LightRecord, place), FIELD(LightRecord, intensity), FIELD(LightRecord, axis),
          FIELD(LightRecord, cone)}},
        {"ViewRecord",
         {FIELD(ViewRecord, clip_from_world), FIELD(ViewRecord, ray_corner), FIELD(ViewRecord, ray_dx),
          FIELD(ViewRecord, ray_dy), FIELD(ViewRecord, width_px), FIELD(ViewRecord, height_px),
          FIELD(ViewRecord, background_map), FIELD(ViewRecord, picture),
          FIELD(ViewRecord, world_from_picture)}},
        {"SurfacePoint",
         {FIELD(SurfacePoint, normal), FIELD(SurfacePoint, tangent), FIELD(SurfacePoint, omega_o),
          FIELD(SurfacePoint, position)}},
        {"Counters", {FIELD(Counters, stopped), FIELD(Counters, first)}},
        {"SurfaceRecord",
         {FIELD(SurfaceRecord, base_color), FIELD(SurfaceRecord, emissive), FIELD(SurfaceRecord, specular),
          FIELD(SurfaceRecord, metallic), FIELD(SurfaceRecord, roughness), FIELD(SurfaceRecord, anisotropy),
          FIELD(SurfaceRecord, clearcoat), FIELD(SurfaceRecord, clearcoat_roughness),
          FIELD(SurfaceRecord, normal_scale), FIELD(SurfaceRecord, occlusion_strength),
          FIELD(SurfaceRecord, texture_begin), FIELD(SurfaceRecord, clearcoat_normal_scale),
          FIELD(SurfaceRecord, is_layered), FIELD(SurfaceRecord, pad1), FIELD(SurfaceRecord, pad2)}},
        {"DrawRecord",
         {FIELD(DrawRecord, world_from_object), FIELD(DrawRecord, normal_from_object_x),
          FIELD(DrawRecord, normal_from_object_y), FIELD(DrawRecord, normal_from_object_z),
          FIELD(DrawRecord, material), FIELD(DrawRecord, pad0), FIELD(DrawRecord, pad1),
          FIELD(DrawRecord, pad2)}},
        {"ShadeRecord",
         {FIELD(ShadeRecord, point_count), FIELD(ShadeRecord, tile_capacity), FIELD(ShadeRecord, batch),
          FIELD(ShadeRecord, batch_size), FIELD(ShadeRecord, texel_begin), FIELD(ShadeRecord, texel_end),
          FIELD(ShadeRecord, display_scale), FIELD(ShadeRecord, light_count)}},
        {"AccumulateRecord",
         {FIELD(AccumulateRecord, count), FIELD(AccumulateRecord, is_first), FIELD(AccumulateRecord, weight),
          FIELD(AccumulateRecord, display_scale)}},
        {"PyramidRecord",
         {FIELD(PyramidRecord, source_begin), FIELD(PyramidRecord, source_pitch),
          FIELD(PyramidRecord, source_size), FIELD(PyramidRecord, target_begin),
          FIELD(PyramidRecord, target_pitch), FIELD(PyramidRecord, pad0), FIELD(PyramidRecord, pad1),
          FIELD(PyramidRecord, pad2)}},
        {"PrefilterRecord",
         {FIELD(PrefilterRecord, cube), FIELD(PrefilterRecord, size), FIELD(PrefilterRecord, texel_begin),
          FIELD(PrefilterRecord, sample_begin), FIELD(PrefilterRecord, sample_count),
          FIELD(PrefilterRecord, pad0), FIELD(PrefilterRecord, pad1), FIELD(PrefilterRecord, pad2)}},
        {"TexelAlias",
         {FIELD(TexelAlias, threshold), FIELD(TexelAlias, alias), FIELD(TexelAlias, probability),
          FIELD(TexelAlias, pad0)}},
        {"TextureRecord",
         {FIELD(TextureRecord, scale_rotation), FIELD(TextureRecord, offset), FIELD(TextureRecord, uv_set),
          FIELD(TextureRecord, coverage_levels)}},
    };
}

#undef FIELD

} // namespace

void bind_shared(py::module_& m) {
    m.def("shared_layout", &shared_layout,
          "dict of struct to dict of field to byte offset, as C++ lays them out.");
}

} // namespace burnish
