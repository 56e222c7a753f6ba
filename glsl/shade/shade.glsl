// Shades surface points. An entry point defines `look_up_lobe`, one way of bringing a lobe's light together:
// with all of them in one kernel a driver would take six times as long to compile it.
#ifndef BURNISH_SHADE_SHADE
#define BURNISH_SHADE_SHADE

#include "shade/diffuse.glsl"
#include "shade/layers.glsl"
#include "shade/lights.glsl"
#include "shade/lobe.glsl"
#include "shade/matched.glsl"
#include "shade/matched_by_view.glsl"
#include "shade/prefiltered.glsl"
#include "shade/suns.glsl"
#include "shade/surface_point.glsl"

// Light of the lobe at the point without its suns, energy_scale and the map's exposure.
vec3 look_up_lobe(LobeView v, SurfaceLobe lobe, LobeRecord record, vec2 albedo, MapRecord map);

// Light of the lobe from direct lights. A disc's variance along an axis is a quarter of its radius' square.
vec3 shade_lights(LobeView v, PointToShade point, mat3 frame, SurfaceLobe lobe) {
    vec3 sum = vec3(0.0);
    LightRange range = lights_of(point);
    uint k = 0u;
    do {
        ArrivingLight light = light_of(range, k, point.position);
        sum += shade_small_light(v, light.omega_i * frame, 0.25 * light.sine2, light.irradiance,
                                 lobe.specular, lobe.grazing);
    } while (++k < range.count);
    return sum;
}

void shade_lobe(PointToShade point, MapRecord map, uint lobe_index, uint which, inout Layers layers) {
    SurfaceLobe lobe = point_lobe(point, lobe_index, which);
    LobeRecord record = load_lobe(lobe_index);
    LobeView v;
    mat3 frame = lobe_frame(point_frame(point, which), record);
    v.local_o = point.omega_o * frame;
    v.frame = environment_from_world(map, frame);
    v.omega_o = environment_from_world(map, point.omega_o);
    v.model = lobe_model(which);
    v.roughness = lobe.roughness;
    v.alpha = record.alpha;
    v.own = record.own;
    v.cos_o_power = cos_o_power(v.local_o.z, record.alpha);
    v.area_term = published_area_term(v.local_o);
    v.threshold_log = record.threshold_log;
    v.layer = float(map.layer);

    vec2 albedo = vec2(0.0);
    if (NORMALIZATION == NORMALIZATION_FURNACE || CONSERVES_ENERGY || TABLE == TABLE_PREFILTERED ||
        HAS_LAYERS)
        albedo = lobe_albedo_gain(shape_of(v), v.local_o) *
                 lobe_albedo(record, lobe_albedo_width(shape_of(v)), v.local_o);
    vec3 light = look_up_lobe(v, lobe, record, albedo, map);
    if (SUN_COUNT > 0u) light += shade_suns(v, map, lobe.specular, lobe.grazing);
    if (HAS_LIGHTS) light += shade_lights(v, point, frame, lobe) / map.radiance_scale;
    albedo *= v.cos_o_power;
    vec3 scale = energy_scale(record, reflectance_of(lobe), albedo.x);
    add_lobe(layers, record, light * scale, lobe_through(record, lobe, albedo, scale));
}

void main() {
    PointToShade point = load_point();
    MaterialRecord material = load_material(point.material);
    MapRecord map = load_map_record(material.map);

    Layers layers = Layers(vec3(0.0), 1.0);
    if (HAS_DIFFUSE)
        layers.light = point_diffuse(point) *
                       diffuse_light(map, material.map, environment_from_world(map, point.frame[2]));
    if (HAS_DIFFUSE && HAS_LIGHTS)
        layers.light += point_diffuse(point) * diffuse_lights(point) / map.radiance_scale;
    [[unroll]] for (uint which = 0u; which < LOBE_COUNT; ++which) {
        shade_lobe(point, map, material.lobe_begin + which, which, layers);
    }
    vec3 radiance = layers.light * map.radiance_scale;
    if (HAS_EMISSIVE) radiance += point_emissive(point) * layers.emission;
    store_radiance(point, radiance, 1.0);
}

#endif
