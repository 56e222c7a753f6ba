// Maps a metallic-roughness material to diffuse + lobes where textures or vertex colours make it vary. An
// entry point defines HAS_ALL_TARGETS: without it emission, reflectances along the surface and clear coats
// are not written.

#include "lib/frame.glsl"
#include "lib/metallic_roughness.glsl"
#include "lib/random.glsl"
#include "shared/constants.h"
#include "shared/records.h"
#include "surface/records.glsl"

layout(constant_id = SPEC_TEXTURES) const uint TEXTURES = 0u;
layout(constant_id = SPEC_VERTEX_COLOR) const bool HAS_VERTEX_COLOR = false;
layout(constant_id = SPEC_ALPHA_MASK) const bool HAS_ALPHA_MASK = false;
layout(constant_id = SPEC_UNLIT) const bool IS_UNLIT = false;
layout(constant_id = SPEC_DOUBLE_SIDED) const bool IS_DOUBLE_SIDED = false;

layout(push_constant) uniform Push { DrawRecord draw; };
layout(std430, binding = BINDING_SURFACE_VIEW) readonly buffer Views { ViewRecord view; };
layout(binding = BINDING_SURFACE_TEXTURES) uniform sampler2D textures[TEXTURE_KINDS];

layout(location = 0) in vec3 normal_world;
layout(location = 1) in vec4 tangent_world;
layout(location = 2) in vec4 uv;
layout(location = 3) in vec4 color;

layout(location = 0) out uvec2 surface;
layout(location = 1) out vec4 diffuse_out;  // rgb: kd; a: roughness_x
layout(location = 2) out vec4 specular_out; // rgb: weight r0; a: roughness_y
#if HAS_ALL_TARGETS
layout(location = 3) out vec4 emissive_out; // rgb: radiance; a: weight at grazing
layout(location =
           4) out uvec2 coat_out; // x: weight and roughness, two halves; y: octahedral normal, two snorm16
#endif

SurfaceRecord material;
vec4 uv_dx, uv_dy;

bool has_texture(uint kind) { return (TEXTURES & (1u << kind)) != 0u; }

// The kind's texel, or `absent` for kinds the material does not use: a constant, so that no lookup is
// compiled.
vec4 read_texture(uint kind, vec4 absent) {
    if (!has_texture(kind)) return absent;
    TextureRecord record = load_texture(material.texture_begin + kind);
    bool is_first = record.uv_set == 0u;
    vec2 set = is_first ? uv.xy : uv.zw;
    mat2 scale_rotation = mat2(record.scale_rotation.xy, record.scale_rotation.zw);
    // Gradients of the inputs, not of what was computed with the record: lavapipe loads zeros for the
    // invocations beside a triangle that exist for gradients only, and every edge would be sampled at a wrong
    // level.
    vec2 dx = scale_rotation * (is_first ? uv_dx.xy : uv_dx.zw);
    vec2 dy = scale_rotation * (is_first ? uv_dy.xy : uv_dy.zw);
    return textureGrad(textures[kind], scale_rotation * set + record.offset, dx, dy);
}

// The normal that a texture of normals asks for in a frame.
vec3 bend_normal(uint kind, float scale, mat3 frame) {
    if (!has_texture(kind)) return frame[2];
    vec3 mapped = read_texture(kind, vec4(0.5, 0.5, 1.0, 1.0)).xyz * 2.0 - 1.0;
    mapped.xy *= scale;
    vec3 bent = frame * mapped;
    return dot(bent, bent) > 1e-12 ? normalize(bent) : frame[2];
}

// How much of the base colour's alpha, as it was read, is coverage: level 0 of its texture holds alpha, all
// others the share of level 0 that shows.
float coverage_share() {
    TextureRecord record = load_texture(material.texture_begin + TEXTURE_BASE_COLOR);
    if (record.coverage_levels == COVERAGE_LEVELS_NONE) return 0.0;
    mat2 scale_rotation = mat2(record.scale_rotation.xy, record.scale_rotation.zw);
    vec2 size = vec2(textureSize(textures[TEXTURE_BASE_COLOR], 0));
    vec2 dx = size * (scale_rotation * (record.uv_set == 0u ? uv_dx.xy : uv_dx.zw));
    vec2 dy = size * (scale_rotation * (record.uv_set == 0u ? uv_dy.xy : uv_dy.zw));
    float level = 0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)), 1e-30));
    if (record.coverage_levels == COVERAGE_LEVELS_NEAREST) return level > 0.5 ? 1.0 : 0.0;
    return clamp(level, 0.0, 1.0);
}

// Whether a masked material lets the pixel through. `most`: alpha without the texture. Coverage is held
// against thresholds spread evenly over the pixels and over the pictures that are averaged: as many let
// through as are covered.
bool is_cut_out(float alpha, float most) {
    float cutoff = material.emissive.a;
    if (most < cutoff) return true;
    if (!has_texture(TEXTURE_BASE_COLOR)) return false;
    float threshold =
        0.5 / 255.0 + 254.0 / 255.0 * dither(uvec2(gl_FragCoord.xy), view.picture); // 0 never, 1 always shows
    return alpha < mix(cutoff, most * threshold, coverage_share());
}

// Half-precision targets truncate on some drivers: round to nearest first.
vec4 round_to_half(vec4 v) {
    v = min(v, vec4(65504.0));
    return vec4(unpackHalf2x16(packHalf2x16(v.xy)), unpackHalf2x16(packHalf2x16(v.zw)));
}

void main() {
    uv_dx = dFdx(uv);
    uv_dy = dFdy(uv);
    material = load_surface(draw.material);
    vec4 base = material.base_color;
    if (HAS_VERTEX_COLOR) base *= color;
    float most_alpha = base.a;
    base *= read_texture(TEXTURE_BASE_COLOR, vec4(1.0));
    if (HAS_ALPHA_MASK && is_cut_out(base.a, most_alpha)) discard;

    float handedness = tangent_world.w;
    mat3 frame = frame_from_tangent(normalize(normal_world), tangent_world.xyz, handedness);
    vec3 coat_normal = bend_normal(TEXTURE_CLEARCOAT_NORMAL, material.clearcoat_normal_scale, frame);
    if (has_texture(TEXTURE_NORMAL))
        frame = frame_from_tangent(bend_normal(TEXTURE_NORMAL, material.normal_scale, frame), frame[0],
                                   handedness);

    vec4 direction_strength = read_texture(TEXTURE_ANISOTROPY, vec4(1.0, 0.5, 1.0, 1.0));
    float anisotropy = material.anisotropy * direction_strength.b;
    if (has_texture(TEXTURE_ANISOTROPY)) {
        vec2 direction = direction_strength.rg * 2.0 - 1.0;
        float length2 = dot(direction, direction);
        direction = length2 > 1e-4 ? direction * inversesqrt(length2) : vec2(1.0, 0.0);
        frame[0] = direction.x * frame[0] + direction.y * frame[1];
    }
    // Seen from behind the mapped normals turn around, and tangent and bitangent stay: what is brushed lies
    // on both sides the same way.
    if (IS_DOUBLE_SIDED && !gl_FrontFacing) {
        frame[2] = -frame[2];
        coat_normal = -coat_normal;
        handedness = -handedness;
    }

    vec4 metallic_roughness = read_texture(TEXTURE_METALLIC_ROUGHNESS, vec4(1.0));
    float specular = material.specular.a * read_texture(TEXTURE_SPECULAR, vec4(1.0)).a;
    vec3 specular_color = read_texture(TEXTURE_SPECULAR_COLOR, vec4(1.0)).rgb;
    vec3 dielectric = min(material.specular.rgb * specular_color, vec3(1.0)) * specular;
    MappedMaterial mapped =
        map_metallic_roughness(base.rgb, material.metallic * metallic_roughness.b,
                               material.roughness * metallic_roughness.g, dielectric, specular, anisotropy);
    float below = 1.0 - (1.0 - material.is_layered) * max(max(dielectric.r, dielectric.g), dielectric.b);
    float occlusion =
        1.0 + material.occlusion_strength * (read_texture(TEXTURE_OCCLUSION, vec4(1.0)).r - 1.0);
    vec3 emissive = material.emissive.rgb * read_texture(TEXTURE_EMISSIVE, vec4(1.0)).rgb;
    if (IS_UNLIT && HAS_VERTEX_COLOR) emissive *= color.rgb;
    float coat = material.clearcoat * read_texture(TEXTURE_CLEARCOAT, vec4(1.0)).r;
    float coat_roughness =
        material.clearcoat_roughness * read_texture(TEXTURE_CLEARCOAT_ROUGHNESS, vec4(1.0)).g;

    surface = pack_surface(frame[2], frame[0], handedness, draw.material);
    diffuse_out = round_to_half(vec4(mapped.diffuse * (below * occlusion), mapped.roughness.x));
    specular_out = round_to_half(vec4(mapped.specular, mapped.roughness.y));
#if HAS_ALL_TARGETS
    emissive_out = round_to_half(vec4(emissive, mapped.specular.r + mapped.grazing.r));
    coat_out = uvec2(packHalf2x16(vec2(coat, slope_from_perceptual(coat_roughness))),
                     packSnorm2x16(octahedral_encode(coat_normal)));
#endif
}
