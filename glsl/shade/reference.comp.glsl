// The truth a frame is judged by, one batch per dispatch. Two methods, for the diffuse part and every lobe
// alike:
//   quadrature:  L = sum over level-0 texels of L_t f(i_t) cos_i solid angle_t;
//   progressive: multiple importance sampling (balance heuristic) of map and lobe or cosine, level-0 lookups,
//   a new random shift
//                each batch, so that batches are independent and their spread gives the standard error.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lib/cube_map.glsl"
#include "lobe/lobe.glsl"
#include "lib/random.glsl"
#include "shade/albedo.glsl"
#include "lookup/map_lookup.glsl"
#include "shade/layers.glsl"
#include "shade/lights.glsl"
#include "shade/surface_point.glsl"

layout(constant_id = SPEC_IS_QUADRATURE) const bool IS_QUADRATURE = false;

layout(std430, binding = BINDING_TEXEL_ALIAS) readonly buffer Alias { TexelAlias texel_alias[]; };
// Per point: rgb: sum of the batches' means; a: sum of the squares of their luminances. In the unit of the
// brightest map.
layout(std430, binding = BINDING_STATISTICS) buffer Statistics { vec4 statistics[]; };

struct LobeView {
    mat3 frame; // environment space
    vec3 local_o;
    SurfaceLobe lobe;
    LobeShape shape;
    float layer;
};

// f cos_i, with Fresnel and weight, for a local direction and the half-vector between.
vec3 reflectance(LobeView v, vec3 local_i, vec3 h) {
    if (local_i.z <= 0.0) return vec3(0.0);
    float value = lobe_value(v.shape, local_i, v.local_o, h);
    return value * (v.lobe.specular + v.lobe.grazing * schlick_weight(dot(v.local_o, h)));
}

vec3 half_vector(vec3 a, vec3 b) {
    vec3 h = a + b;
    return h * inversesqrt(max(dot(h, h), 1e-20));
}

// Points of a quadrature along a face: the texels, or parts of them, as many in each.
uint quadrature_size(MapRecord map) { return max(map.face_size, LEAST_QUADRATURE_FACE); }

// Where a point of the quadrature lies, not normalised, and the light of its texel times its solid angle.
struct LitPoint {
    vec3 w;
    vec3 light;
};

vec2 face_place(uvec2 texel, uint size) { return (2.0 * vec2(texel) + 1.0) / float(size) - 1.0; }

LitPoint lit_point(uint index, MapRecord map) {
    uint size = quadrature_size(map);
    uint face = index / (size * size), in_face = index % (size * size);
    uvec2 place = uvec2(in_face % size, in_face / size);
    vec2 uv = face_place(place, size);
    vec2 texel_uv = face_place(place / (size / map.face_size), map.face_size);
    LitPoint point;
    point.w = cube_direction(face, uv.x, uv.y);
    point.light = look_up_finest(cube_direction(face, texel_uv.x, texel_uv.y), float(map.layer)) *
                  texel_solid_angle(float(size * size), point.w);
    return point;
}

uint quadrature_end(MapRecord map) {
    uint size = quadrature_size(map);
    return min(push.texel_end, 6u * size * size);
}

vec3 quadrature(LobeView v, MapRecord map) {
    vec3 sum = vec3(0.0);
    for (uint index = push.texel_begin; index < quadrature_end(map); ++index) {
        LitPoint point = lit_point(index, map);
        vec3 local_i = normalize(point.w) * v.frame;
        sum += reflectance(v, local_i, half_vector(local_i, v.local_o)) * point.light;
    }
    return sum;
}

// Irradiance / pi, as all sums of diffuse light here.
vec3 diffuse_quadrature(vec3 n, MapRecord map) {
    vec3 sum = vec3(0.0);
    for (uint index = push.texel_begin; index < quadrature_end(map); ++index) {
        LitPoint point = lit_point(index, map);
        sum += max(dot(normalize(point.w), n), 0.0) * point.light;
    }
    return sum / PI;
}

// Density of `draw_texel` per solid angle in direction w.
float texel_pdf(vec3 w, MapRecord map) {
    uint face_size = map.face_size;
    vec2 uv;
    uint face = cube_face_uv(w, uv);
    uvec2 texel = min(uvec2(max((uv * 0.5 + 0.5) * float(face_size), vec2(0.0))), uvec2(face_size - 1u));
    float face_texels = float(face_size * face_size);
    return texel_alias[map.alias_begin + (face * face_size + texel.y) * face_size + texel.x].probability /
           texel_solid_angle(face_texels, w);
}

// A direction in proportion to the map's light: a texel by its alias table, a place in it at random. The
// texel comes from 32 bits: a large map has six million, which 24 bits would draw unevenly.
vec3 draw_texel(uint index, uint seed, MapRecord map) {
    uint face_size = map.face_size;
    uint texel, fraction;
    umulExtended(recurrence_3d_x(index, seed), 6u * face_size * face_size, texel, fraction);
    TexelAlias drawn = texel_alias[map.alias_begin + texel];
    if (unit_from_uint(hash_uint(fraction)) >= drawn.threshold) texel = drawn.alias;
    vec2 place = recurrence_3d(index, seed).yz;
    uint in_face = texel % (face_size * face_size);
    vec2 uv = 2.0 * (vec2(in_face % face_size, in_face / face_size) + place) / float(face_size) - 1.0;
    return normalize(cube_direction(texel / (face_size * face_size), uv.x, uv.y));
}

vec3 weigh(LobeView v, vec3 direction, vec3 local_i, vec3 h, MapRecord map) {
    vec3 value = reflectance(v, local_i, h);
    float pdf = lobe_pdf(v.shape, local_i, v.local_o, h) + texel_pdf(direction, map);
    return value * look_up_finest(direction, v.layer) / max(pdf, 1e-20);
}

vec3 progressive(LobeView v, MapRecord map, uint seed) {
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < push.batch_size; ++k) {
        LobeDraw drawn = lobe_draw(v.shape, v.local_o, recurrence_2d(k, seed));
        vec3 term = vec3(0.0);
        if (dot(v.local_o, drawn.h) > 0.0 && drawn.omega_i.z > 0.0)
            term = weigh(v, v.frame * drawn.omega_i, drawn.omega_i, drawn.h, map);
        vec3 direction = draw_texel(k, seed, map);
        vec3 local_i = direction * v.frame;
        if (local_i.z > 0.0) term += weigh(v, direction, local_i, half_vector(local_i, v.local_o), map);
        sum += term;
    }
    return sum / float(push.batch_size);
}

// The cosine and the map each bring a direction, weighed by the sum of both densities.
vec3 weigh_cosine(vec3 direction, float cos_i, MapRecord map) {
    if (cos_i <= 0.0) return vec3(0.0);
    float value = cos_i / PI;
    return value * look_up_finest(direction, float(map.layer)) /
           max(value + texel_pdf(direction, map), 1e-20);
}

vec3 diffuse_progressive(mat3 frame, MapRecord map, uint seed) {
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < push.batch_size; ++k) {
        vec2 x = recurrence_2d(k, seed);
        float cos_i = sqrt(1.0 - x.x), sin_i = sqrt(x.x), azimuth = 2.0 * PI * x.y;
        vec3 direction = frame * vec3(sin_i * cos(azimuth), sin_i * sin(azimuth), cos_i);
        sum += weigh_cosine(direction, cos_i, map);
        direction = draw_texel(k, seed, map);
        sum += weigh_cosine(direction, dot(direction, frame[2]), map);
    }
    return sum / float(push.batch_size);
}

vec3 diffuse_batch(PointToShade point, MapRecord map) {
    mat3 frame = environment_from_world(map, point.frame);
    // Numbers of its own, apart from those of the lobes.
    uint seed = hash_uint(point.index ^ 0x9e3779b9u) ^ hash_uint(push.batch + 0x2545f491u);
    return IS_QUADRATURE ? diffuse_quadrature(frame[2], map) : diffuse_progressive(frame, map, seed);
}

// Of points of a quadrature on a light's disc, and of as many drawn from the lobe.
const uint LIGHT_POINTS = 256u;

// From the disc that a light is seen as, all of which is equally bright, and from the lobe, weighed by the
// sum of both densities.
vec3 shade_disc(LobeView v, vec3 middle, ArrivingLight light, uint seed) {
    uint count = IS_QUADRATURE ? LIGHT_POINTS : push.batch_size;
    float height = light.sine2 / (1.0 + sqrt(max(1.0 - light.sine2, 0.0))); // 1 - cos of the radius
    float disc_pdf = 1.0 / (2.0 * PI * height);
    mat3 basis = orthonormal_basis(middle);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < count; ++k) {
        vec2 x = recurrence_2d(k, seed);
        float depth = x.x * height, azimuth = 2.0 * PI * x.y;
        float sine = sqrt(depth * (2.0 - depth));
        vec3 local_i = basis * vec3(sine * cos(azimuth), sine * sin(azimuth), 1.0 - depth);
        vec3 h = half_vector(local_i, v.local_o);
        sum += reflectance(v, local_i, h) / (disc_pdf + lobe_pdf(v.shape, local_i, v.local_o, h));
        LobeDraw drawn = lobe_draw(v.shape, v.local_o, x);
        vec3 beside = cross(drawn.omega_i, middle);
        bool is_lit = dot(v.local_o, drawn.h) > 0.0 && dot(drawn.omega_i, middle) > 0.0 &&
                      dot(beside, beside) <= light.sine2;
        float pdf = disc_pdf + lobe_pdf(v.shape, drawn.omega_i, v.local_o, drawn.h);
        if (is_lit) sum += reflectance(v, drawn.omega_i, drawn.h) / pdf;
    }
    return sum * (light.irradiance / (PI * light.sine2 * float(count)));
}

vec3 reference_lights(LobeView v, PointToShade point, mat3 frame, uint seed) {
    vec3 sum = vec3(0.0);
    LightRange range = lights_of(point);
    for (uint k = 0u; k < range.count; ++k) {
        ArrivingLight light = light_of(range, k, point.position);
        vec3 middle = light.omega_i * frame;
        if (light.sine2 < 1e-12)
            sum += light.irradiance * reflectance(v, middle, half_vector(middle, v.local_o));
        else
            sum += shade_disc(v, middle, light, hash_uint(seed + k));
    }
    return sum;
}

void main() {
    PointToShade point = load_point();
    MaterialRecord material = load_material(point.material);
    MapRecord map = load_map_record(material.map);

    Layers layers = Layers(vec3(0.0), 1.0);
    if (HAS_DIFFUSE) layers.light = point_diffuse(point) * diffuse_batch(point, map);
    // A quadrature adds parts of a sum: direct lights are of the first.
    bool has_lights = HAS_LIGHTS && (!IS_QUADRATURE || push.texel_begin == 0u);
    if (HAS_DIFFUSE && has_lights)
        layers.light += point_diffuse(point) * diffuse_lights(point) / map.radiance_scale;
    for (uint which = 0u; which < LOBE_COUNT; ++which) {
        LobeRecord record = load_lobe(material.lobe_begin + which);
        LobeView v;
        v.lobe = point_lobe(point, material.lobe_begin + which, which);
        mat3 frame = lobe_frame(point_frame(point, which), record);
        v.local_o = point.omega_o * frame;
        v.frame = environment_from_world(map, frame);
        v.shape = LobeShape(lobe_model(which), v.lobe.roughness, record.alpha, record.own);
        v.layer = float(map.layer);
        uint seed = hash_uint(point.index * 4u + which) ^ hash_uint(push.batch + 0x51633e2du);
        vec3 light = IS_QUADRATURE ? quadrature(v, map) : progressive(v, map, seed);
        if (has_lights) light += reference_lights(v, point, frame, seed) / map.radiance_scale;
        float through = 1.0;
        if (CONSERVES_ENERGY || HAS_LAYERS) {
            vec2 albedo = lobe_albedo_gain(v.shape, v.local_o) *
                          lobe_albedo(record, lobe_albedo_width(v.shape), v.local_o);
            float power = pow(max(v.local_o.z, MIN_COS), -record.alpha);
            albedo *= power;
            vec3 scale = energy_scale(record, reflectance_of(v.lobe), albedo.x);
            light *= scale;
            through = lobe_through(record, v.lobe, albedo, scale);
        }
        add_lobe(layers, record, light, through);
    }
    vec3 batch = layers.light;
    if (!point.is_mine) return;
    batch = stop_non_finite(batch, point.index, GUARD_REFERENCE);
    vec4 sum = push.batch == 0u ? vec4(0.0) : statistics[point.index];
    float unit = map.env_from_world_x.w;
    float luminance = unit * dot(batch, vec3(0.2126, 0.7152, 0.0722));
    sum += vec4(unit * batch, luminance * luminance);
    statistics[point.index] = sum;

    // Quadrature batches are parts of one sum, progressive ones are estimates of it.
    vec3 radiance = sum.rgb / (IS_QUADRATURE ? unit : unit * float(push.batch + 1u));
    radiance *= map.radiance_scale;
    if (HAS_EMISSIVE) radiance += point_emissive(point) * layers.emission;
    store_radiance(point, stop_non_finite(radiance, point.index, GUARD_REFERENCE), 1.0);
}
