// One point to shade, from a G-buffer pixel or from a list: the rest of the kernel cannot tell which.
#ifndef BURNISH_SHADE_SURFACE_POINT
#define BURNISH_SHADE_SURFACE_POINT

#include "lib/display.glsl"
#include "lib/frame.glsl"
#include "lobe/lobe.glsl"
#include "shade/guard.glsl"
#include "shade/position.glsl"

struct SurfaceLobe {
    vec3 specular; // weight * r0
    vec3 grazing;  // weight * (f90 - r0)
    vec2 roughness;
};

struct PointToShade {
    bool is_mine; // else nothing is stored
    bool is_seen; // from in front; else it is black
    uint index;   // into radiance_out
    uint group;   // of points, or the tile: counted by rows
    uint material;
    ivec2 pixel;
    mat3 frame;    // world
    vec3 omega_o;  // world, unit, toward the eye
    vec3 position; // where lights are: in the world's axes, from the eye or the middle of the points; only
                   // for effects that ask
};

vec3 pixel_ray(ViewRecord view, vec2 pixel) {
    return normalize(view.ray_corner.xyz + (pixel.x + 0.5) * view.ray_dx.xyz +
                     (pixel.y + 0.5) * view.ray_dy.xyz);
}

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// The pixel of this invocation in its list of tiles; false outside the picture or past the list's end.
bool locate_pixel(ViewRecord view, out ivec2 pixel) {
    uint tile_index = group_index();
    uint tile = tiles[TILE_LIST * push.tile_capacity + min(tile_index, push.tile_capacity - 1u)];
    pixel = ivec2(uvec2(tile & 0xffffu, tile >> 16) * TILE_SIZE + gl_LocalInvocationID.xy);
    return tile_index < tile_counts[TILE_LIST].w && pixel.x < int(view.width_px) &&
           pixel.y < int(view.height_px);
}

// A normal that interpolation or a normal map turned away from the eye is bent back to just face it.
vec3 facing_normal(vec3 n, vec3 omega_o) {
    const float least = 1e-3;
    float cos_o = dot(n, omega_o);
    return cos_o < least ? normalize(n + (least - cos_o) * omega_o) : n;
}

// The frame of the bent normal. Its tangent and the packed one are unit vectors: one step of what
// frame_from_tangent does in two will do. Where the normal was bent until it lies along the tangent, the old
// normal lies in the surface.
mat3 facing_frame(PackedFrame packed_frame, vec3 omega_o) {
    vec3 n = facing_normal(packed_frame.normal, omega_o);
    vec3 t = packed_frame.tangent;
    float along = dot(n, t);
    vec3 across =
        1.0 - along * along > 1e-4 ? t - along * n : packed_frame.normal - dot(n, packed_frame.normal) * n;
    vec3 tangent = across * inversesqrt(max(dot(across, across), 1e-36));
    return mat3(tangent, packed_frame.handedness * cross(n, tangent), n);
}

PointToShade load_point() {
    PointToShade point;
    if (SOURCE == SOURCE_POINTS) {
        uint index = group_index() * (TILE_SIZE * TILE_SIZE) + gl_LocalInvocationIndex;
        point.is_mine = index < push.point_count;
        point.index = min(index, push.point_count - 1u);
        SurfacePoint given = points[point.index];
        point.material = floatBitsToUint(given.omega_o.w);
        point.pixel = ivec2(0);
        point.group = group_index();
        point.position = given.position.xyz;
        point.frame = frame_from_tangent(given.normal.xyz, given.tangent.xyz, given.tangent.w);
        float cos_o = dot(given.normal.xyz, given.omega_o.xyz);
        point.is_seen = cos_o > 0.0;
        // Raised to MIN_COS like the cosine in the lobe's grazing power: where og and q would be rounding
        // alone.
        point.omega_o = given.omega_o.xyz + max(MIN_COS - cos_o, 0.0) * given.normal.xyz;
        return point;
    }
    ViewRecord view = load_view();
    bool is_inside = locate_pixel(view, point.pixel);
    uvec2 surface = imageLoad(surface_image, point.pixel).xy;
    point.index = uint(point.pixel.y) * view.width_px + uint(point.pixel.x);
    uvec2 tile = uvec2(point.pixel) / TILE_SIZE;
    point.group = tile.y * ((view.width_px + TILE_SIZE - 1u) / TILE_SIZE) + tile.x;
    point.material = has_surface(surface) ? unpack_material(surface) : 0u;
    point.is_mine =
        is_inside && has_surface(surface) && load_material(point.material).shade_class == SHADE_CLASS;
    point.omega_o = -pixel_ray(view, vec2(point.pixel));
    point.is_seen = true; // see facing_normal
    point.position = vec3(0.0);
    if (HAS_LIGHTS) {
        float depth = texelFetch(depth_image, point.pixel, 0).x;
        point.position = pixel_position(load_world_from_picture(), point.pixel, depth > 0.0 ? depth : 1.0);
    }
    if (HAS_TANGENT) {
        point.frame = facing_frame(unpack_frame(surface), point.omega_o);
    } else {
        point.frame = longitude_frame(facing_normal(unpack_normal(surface), point.omega_o));
    }
    return point;
}

vec3 point_diffuse(PointToShade point) {
    return HAS_VARYING ? imageLoad(varying_diffuse, point.pixel).rgb
                       : load_material(point.material).diffuse.rgb;
}

vec3 point_emissive(PointToShade point) {
    vec4 emissive = load_material(point.material).emissive;
    return HAS_VARYING && HAS_VARYING_EMISSIVE ? imageLoad(varying_emissive, point.pixel).rgb * emissive.a
                                               : emissive.rgb;
}

// Of a varying material the clear coat is the last lobe and the base the first; where the base reflects
// nothing, the coat is both.
bool is_coat(uint which) { return HAS_VARYING && HAS_COAT && which + 1u == LOBE_COUNT; }

// Between the two, one may be the same all over the surface.
bool is_fixed(uint which) {
    return HAS_VARYING && HAS_FIXED_LOBE && which + (HAS_COAT ? 2u : 1u) == LOBE_COUNT;
}

// Lobe `which` of the point.
SurfaceLobe point_lobe(PointToShade point, uint lobe_index, uint which) {
    SurfaceLobe lobe;
    if (HAS_VARYING && !is_coat(which) && !is_fixed(which)) {
        vec4 specular = imageLoad(varying_specular, point.pixel);
        lobe.specular = specular.rgb;
        float along = HAS_VARYING_EMISSIVE ? imageLoad(varying_emissive, point.pixel).a : 1.0;
        lobe.grazing = vec3(along) - specular.rgb;
        lobe.roughness = vec2(imageLoad(varying_diffuse, point.pixel).a, specular.a);
        return lobe;
    }
    LobeRecord record = load_lobe(lobe_index);
    lobe.specular = record.specular.rgb;
    lobe.grazing = record.grazing.rgb;
    lobe.roughness = vec2(record.specular.a, record.grazing.a);
    if (is_coat(which)) {
        vec2 coat = unpackHalf2x16(imageLoad(varying_coat, point.pixel).x); // weight, roughness
        lobe.specular *= coat.x;
        lobe.grazing *= coat.x;
        lobe.roughness = vec2(coat.y);
    }
    return lobe;
}

uint lobe_model(uint which) { return LOBE_MODELS >> (MODEL_BITS * which) & ((1u << MODEL_BITS) - 1u); }

// The frame of lobe `which`. A normal map bends the base alone: the clear coat, which is round, has its own
// normal.
mat3 point_frame(PointToShade point, uint which) {
    if (!HAS_COAT_NORMAL || !is_coat(which)) return point.frame;
    vec3 normal = octahedral_decode(unpackSnorm2x16(imageLoad(varying_coat, point.pixel).y));
    return longitude_frame(facing_normal(normal, point.omega_o));
}

vec3 environment_from_world(MapRecord map, vec3 v) {
    if (!HAS_MAP_ROTATION) return v;
    return vec3(dot(map.env_from_world_x.xyz, v), dot(map.env_from_world_y.xyz, v),
                dot(map.env_from_world_z.xyz, v));
}

mat3 environment_from_world(MapRecord map, mat3 frame) {
    return mat3(environment_from_world(map, frame[0]), environment_from_world(map, frame[1]),
                environment_from_world(map, frame[2]));
}

// The frame turned by the lobe's rotation, counter-clockwise about the normal, seen from outside.
mat3 lobe_frame(mat3 frame, LobeRecord record) {
    return mat3(record.rotation_cos * frame[0] + record.rotation_sin * frame[1],
                record.rotation_cos * frame[1] - record.rotation_sin * frame[0], frame[2]);
}

// The only way into the picture.
void store_radiance(PointToShade point, vec3 radiance, float alpha) {
    if (!point.is_mine) return;
    if (SOURCE == SOURCE_POINTS && !point.is_seen) radiance = vec3(0.0);
    if (COUNTS_NON_FINITE)
        radiance = stop_non_finite(radiance, point.index, alpha == 0.0 ? GUARD_BACKGROUND : GUARD_SHADE);
    uint place = COUNTS_NON_FINITE ? point.index : guarded_place(radiance, point.index);
    if (IS_DISPLAY) {
        uint pixel = display_pixel(vec4(radiance, alpha), push.display_scale);
        display_out[place] = place == point.index ? pixel : 1u; // behind the end anything but zero
    } else {
        radiance_out[place] = vec4(radiance, alpha);
    }
}

#endif
