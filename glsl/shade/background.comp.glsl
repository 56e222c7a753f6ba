// Draws the environment, at full sharpness, where no object is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lookup/map_lookup.glsl"
#include "shade/surface_point.glsl"

void main() {
    PointToShade point;
    ViewRecord view = load_view();
    bool is_inside = locate_pixel(view, point.pixel);
    point.is_mine = is_inside && !has_surface(imageLoad(surface_image, point.pixel).xy);
    point.index = uint(point.pixel.y) * view.width_px + uint(point.pixel.x);
    MapRecord map = load_map_record(view.background_map);
    vec3 direction = environment_from_world(map, pixel_ray(view, vec2(point.pixel)));
    store_radiance(point, look_up_finest(direction, float(map.layer)) * map.radiance_scale, 0.0);
}
