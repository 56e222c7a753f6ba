// Radiance of one lobe by a pattern of half-vectors (maths: sections 3 and 4), in slope form:
// with g = n + sx t + sy b (so that g.n = 1, |g|^2 = 1/c), og = g.o and q = 2 c og,
//   i = q g - o is the mirrored direction, already unit;  cos_i = q - cos_o;  o.h = og sqrt(c).
#ifndef BURNISH_SHADE_LOBE
#define BURNISH_SHADE_LOBE

#include "lib/footprint.glsl"
#include "lobe/lobe.glsl"
#include "shade/albedo.glsl"
#include "shade/bindings.glsl"
#include "lookup/map_lookup.glsl"

layout(constant_id = SPEC_TABLE) const uint TABLE = TABLE_BUFFER;
layout(constant_id = SPEC_FOOTPRINT) const uint FOOTPRINT = FOOTPRINT_EXACT;
layout(constant_id = SPEC_NORMALIZATION) const uint NORMALIZATION = NORMALIZATION_FURNACE;
layout(constant_id = SPEC_SAMPLE_COUNT) const uint SAMPLE_COUNT = 1u; // 0 where each table has its own

layout(constant_id = SPEC_WITHOUT_LOOKUPS) const bool IS_WITHOUT_LOOKUPS = false;

layout(constant_id = SPEC_SAMPLE_TABLE_IS_STORED) const bool SAMPLE_TABLE_IS_STORED = false;
layout(binding = BINDING_SAMPLE_TABLE, rgba32f) uniform readonly imageBuffer sample_table;
layout(std430, binding = BINDING_STORED_SAMPLE_TABLE) readonly buffer StoredSampleTable {
    vec4 stored_sample_table[];
};

vec4 sample_entry(int index) {
    if (SAMPLE_TABLE_IS_STORED) return stored_sample_table[index];
    return imageLoad(sample_table, index);
}

// What all samples of one lobe at one point share.
struct LobeView {
    mat3 frame;      // environment space
    vec3 omega_o;    // environment space
    vec3 local_o;    // omega_o in the frame
    float area_term; // of the published footprint
    uint model;      // MODEL_...
    vec2 roughness;
    float alpha;
    vec4 own;          // of its model
    float cos_o_power; // max(cos_o, MIN_COS)^-alpha
    float threshold_log;
    float layer;
};

LobeShape shape_of(LobeView v) { return LobeShape(v.model, v.roughness, v.alpha, v.own); }

struct LobeSums {
    vec3 base;         // sum of w L
    vec3 schlick;      // sum of w (1 - o.h)^5 L
    float base_weight; // sum of w
    float schlick_weight;
    float density; // scaled tables: what the weights must be divided by
};

struct Lookup {
    MapAim aim;
    float weight;
    float schlick;
    float density;
};

float cos_i_power(float cos_i, float alpha) {
    float i = max(cos_i, 0.0);
    if (ALPHA == ALPHA_ZERO) return i;
    if (ALPHA == ALPHA_HALF) return sqrt(i);
    return cos_i > 0.0 ? pow(i, 1.0 - alpha) : 0.0;
}

float cos_o_power(float cos_o, float alpha) {
    float o = max(cos_o, MIN_COS);
    if (ALPHA == ALPHA_ZERO) return 1.0;
    if (ALPHA == ALPHA_HALF) return inversesqrt(o);
    return pow(o, -alpha);
}

// A place of the lobe's plane, its weight and its texels: face_texels/4 times the area it stands for.
Lookup place_in_plane(LobeView v, vec4 entry) {
    LobePoint point = lobe_at(shape_of(v), v.local_o, entry.xy);
    Lookup lookup;
    lookup.weight = entry.z * point.base;
    lookup.schlick = HAS_FRESNEL ? schlick_weight(point.cos_d) : 0.0;
    lookup.density = 0.0;
    CubePlace place = place_on_cube(v.frame * point.omega_i);
    lookup.aim =
        aim_at_map(place, v.layer, mip_level(texels_exact(entry.w, point.stretch, place.inverse_largest)));
    return lookup;
}

Lookup place_lookup(LobeView v, vec4 entry) {
    if (!has_fixed_half_vectors(v.model)) return place_in_plane(v, entry);
    vec2 slope = TABLE >= TABLE_SCALED_REGULAR ? entry.xy * v.roughness : entry.xy;
    float inverse_c = 1.0 + dot(slope, slope);
    float c = 1.0 / inverse_c;
    vec3 g = v.frame[2] + slope.x * v.frame[0] + slope.y * v.frame[1];
    float og = v.local_o.z + slope.x * v.local_o.x + slope.y * v.local_o.y;
    float q = 2.0 * c * og;

    Lookup lookup;
    vec3 direction = q * g - v.omega_o;
    float cos_i = q - v.local_o.z;
    float weight = entry.z;
    float texel_factor = entry.w;
    lookup.density = 0.0;
    if (TABLE == TABLE_SCALED_REGULAR) {
        weight *= inverse_c * inverse_c; // D = q / cos_h^4
        lookup.density = NORMALIZATION == NORMALIZATION_PUBLISHED ? weight : weight * sqrt(c);
        float reach = v.threshold_log * v.roughness.x * v.roughness.y; // tan^2 of the lobe's edge
        float narrowing =
            FOOTPRINT == FOOTPRINT_EXACT ? 2.0 / (1.0 + reach + sqrt(1.0 + reach)) : 1.0 / (1.0 + reach);
        texel_factor *= v.roughness.x * v.roughness.y * narrowing *
                        (FOOTPRINT == FOOTPRINT_EXACT ? sqrt(c) : sqrt(inverse_c));
    }
    if (TABLE == TABLE_SCALED_IMPORTANCE) {
        weight *= sqrt(inverse_c); // 1 / cos_h
        texel_factor *= v.roughness.x * v.roughness.y * c * c;
    }
    lookup.weight = weight * cos_i_power(cos_i, v.alpha);
    lookup.schlick = HAS_FRESNEL ? schlick_weight(og * inversesqrt(inverse_c)) : 0.0;

    CubePlace place = place_on_cube(direction);
    float level = mip_level(FOOTPRINT == FOOTPRINT_EXACT
                                ? texels_exact(texel_factor, og, place.inverse_largest)
                                : texels_published(texel_factor, v.area_term, og, place.inverse_largest));
    lookup.aim = aim_at_map(place, v.layer, level);
    return lookup;
}

void add_lookup(inout LobeSums sums, Lookup lookup) {
    vec3 light = IS_WITHOUT_LOOKUPS ? lookup.aim.direction + lookup.aim.level : load_map(lookup.aim);
    sums.base += lookup.weight * light;
    sums.base_weight += lookup.weight;
    if (HAS_FRESNEL) {
        float weight = lookup.weight * lookup.schlick;
        sums.schlick += weight * light;
        sums.schlick_weight += weight;
    }
    sums.density += lookup.density;
}

// Lookups go in phases of four: first all are aimed, then all are loaded, so that a CPU can overlap the
// loads. (In phases of one for drivers that compile slowly.)
layout(constant_id = SPEC_PHASE) const uint PHASE = 4u;

void gather_phase(LobeView v, uint first, uint count, inout LobeSums sums) {
    Lookup lookups[PHASE];
    [[unroll]] for (uint j = 0u; j < PHASE; ++j) {
        if (j < count) lookups[j] = place_lookup(v, sample_entry(int(first + j)));
    }
    [[unroll]] for (uint j = 0u; j < PHASE; ++j) if (j < count) add_lookup(sums, lookups[j]);
}

// Tables are padded with entries of weight zero: to SAMPLE_COUNT, or to whole phases. A loop that a CPU
// driver keeps stores all it carries in memory at every turn (measured: 1.5 times the cost of a lobe).
LobeSums gather_pattern(LobeView v, uint table_begin, uint table_count) {
    LobeSums sums = LobeSums(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    if (SAMPLE_COUNT > 0u) {
        [[unroll]] for (uint k = 0u; k < SAMPLE_COUNT; k += PHASE)
            gather_phase(v, table_begin + k, SAMPLE_COUNT - k, sums);
        return sums;
    }
    [[dont_unroll]] for (uint k = 0u; k < table_count; k += PHASE)
        gather_phase(v, table_begin + k, PHASE, sums);
    return sums;
}

vec3 divide_or_zero(vec3 numerator, vec3 denominator) {
    bvec3 usable = greaterThan(denominator, vec3(1e-30));
    return mix(vec3(0.0), numerator / max(denominator, vec3(1e-30)), usable);
}

vec3 finish_lobe(LobeView v, LobeSums sums, vec3 specular, vec3 grazing, vec2 albedo) {
    vec3 light = specular * sums.base;
    vec3 weight = specular * sums.base_weight;
    vec3 exact = specular * albedo.x;
    if (HAS_FRESNEL) {
        // F = r0 + (1 - r0) s: with r0 = 1 the second term is absent, and `grazing` is zero.
        light += grazing * sums.schlick;
        weight += grazing * sums.schlick_weight;
        exact += grazing * albedo.y;
    }
    if (NORMALIZATION == NORMALIZATION_FURNACE) return divide_or_zero(light, weight) * exact * v.cos_o_power;
    if (TABLE == TABLE_SCALED_REGULAR && has_fixed_half_vectors(v.model))
        return light / max(sums.density, 1e-30) * v.cos_o_power;
    return light * v.cos_o_power;
}

#endif
