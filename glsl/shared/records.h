// Records in buffers, written by C++ and read by shaders.
#ifndef BURNISH_SHARED_RECORDS_H
#define BURNISH_SHARED_RECORDS_H

#include "shared/constants.h"
#include "shared/types.h"

SHARED_BEGIN

// Rows of 16 bytes: shade kernels read records by them (shade/records.glsl).
SHARED_CONST uint LOBE_ROWS = 7u;
SHARED_CONST uint MATERIAL_ROWS = 3u;
SHARED_CONST uint MAP_ROWS = 21u;
SHARED_CONST uint LIGHT_ROWS = 4u;
SHARED_CONST uint SURFACE_ROWS = 6u;
SHARED_CONST uint TEXTURE_ROWS = 2u;

// One lobe of one material.
struct LobeRecord {
    vec4 specular; // rgb: weight * r0; a: width along the tangent
    vec4 grazing;  // rgb: weight * (f90 - r0); a: width along the bitangent
    float alpha;   // grazing exponent, 0..1, of Kurt's
    float rotation_cos;
    float rotation_sin;
    uint table_begin;  // first entry of its sample table
    uint table_count;  // samples
    uint albedo_begin; // first entry of its albedo table
    uint
        albedo_width_nodes; // of a fixed roughness; 1 = round; 0: of one that no texture varies beside others
    float threshold_log;    // -ln xi0, for scaled tables of the regular pattern
    uint energy;            // ENERGY_...
    float level_share;      // of matched lookups: what a variance of 1 is of level 1's, face_texels / (16
                            // SPHERICAL_VARIANCE)
    uint view_columns;      // of a table by view: 1 = isotropic
    uint view_drift; // of a table by view, two halves: what slopes move by for a unit of the view along and
                     // across
    vec4 cover;      // of layers, see Cover (scene/material.h). xy: what it takes from what lies below, x E1
                     // + y Es of its albedo; x < 0: what it reflects; z: 1 if emission lies below, too
    vec4 own;        // of models that have more than widths, see glsl/lobe
};
SHARED_SIZE(LobeRecord, 16 * LOBE_ROWS)

// One material seen with one map.
struct MaterialRecord {
    vec4 diffuse;  // rgb: kd
    vec4 emissive; // rgb: radiance; a: unit in which the wide G-buffer holds it, a power of two
    uint lobe_begin;
    uint lobe_count;
    uint map;         // index of its MapRecord
    uint shade_class; // which specialised pipeline shades it
};
SHARED_SIZE(MaterialRecord, 16 * MATERIAL_ROWS)

// One environment map: where it lies and how it is turned. Columns of the matrix are rows of env_from_world.
// All light in it is in the unit that its halves have, a power of two of radiance (scene/half_range.h).
struct MapRecord {
    vec4 env_from_world_x; // xyz: environment x axis in world space; w: its unit in that of the reference's
                           // statistics
    vec4 env_from_world_y; // w: 1 over the unit
    vec4 env_from_world_z;
    vec4 irradiance[9];      // rgb: spherical-harmonic coefficients of irradiance / pi, in environment space
    float radiance_scale;    // 2^exposure times the unit
    uint layer;              // cube in its array
    uint face_size;          // texels
    uint alias_begin;        // first entry of its TexelAlias table
    vec4 suns[2 * MAX_SUNS]; // each: direction, environment space, and its variance; rgb: flux
};
SHARED_SIZE(MapRecord, 16 * MAP_ROWS)

// One direct light. Places are relative to the origin of positions: the eye, or the middle of a list of
// points.
struct LightRecord {
    vec4 place;     // xyz: where it is, or, of directional ones, where it comes from, unit; w: radius, or the
                    // sine of half the angle that it is seen under
    vec4 intensity; // rgb: W/sr, or, of directional ones, irradiance; w: 1/range^2, 0: no end
    vec4 axis;      // xyz: where a spot shines, unit; w: 1: directional
    vec4 cone; // xy: scale and offset of a spot's edge by the cosine; zw: cosine and sine of the outer angle,
               // 0 of others
};
SHARED_SIZE(LightRecord, 16 * LIGHT_ROWS)

// The view a frame is drawn from. A pixel's ray is ray_corner + (x + .5) ray_dx + (y + .5) ray_dy, x right, y
// down.
struct ViewRecord {
    mat4 clip_from_world; // reverse z; the world's axes, its origin at the eye
    vec4 ray_corner;      // xyz: world direction through the picture's top left corner, not normalised
    vec4 ray_dx;
    vec4 ray_dy;
    uint width_px;
    uint height_px;
    uint background_map;     // MapRecord behind everything
    uint picture;            // of those that are averaged, counted from 0
    mat4 world_from_picture; // pixel, depth and 1 to what was drawn there, homogeneous; axes and origin as
                             // above
};
SHARED_SIZE(ViewRecord, 192)

// One surface point given from outside instead of a G-buffer pixel.
struct SurfacePoint {
    vec4 normal;   // xyz: unit, world
    vec4 tangent;  // xyz: world; w: handedness, bitangent = w cross(normal, tangent)
    vec4 omega_o;  // xyz: unit, toward the eye; w: material index
    vec4 position; // xyz: relative to the middle of all
};
SHARED_SIZE(SurfacePoint, 64)

// Values that were stopped because they were not finite, by the pass that they come from, GUARD_*.
struct Counters {
    uint stopped[4];
    uint first[4]; // complement of the lowest index into the picture or the list of points; 0 where none was
                   // stopped
};
SHARED_SIZE(Counters, 32)

// What the surface pass needs of a metallic-roughness material to map it at every pixel.
struct SurfaceRecord {
    vec4 base_color; // linear RGB, coverage
    vec4 emissive;   // rgb: radiance in the material's unit (MaterialRecord); a: alpha cutoff
    vec4 specular;   // rgb: reflectance at normal incidence of a dielectric, from ior and specular colour; a:
                     // specular
    float metallic;
    float roughness;  // perceptual
    float anisotropy; // strength
    float clearcoat;
    float clearcoat_roughness; // perceptual
    float normal_scale;
    float occlusion_strength;
    uint texture_begin; // first of its TEXTURE_KINDS TextureRecords
    float clearcoat_normal_scale;
    float is_layered; // 1: the dielectric's lobe takes from the diffuse part what it reflects; else it lacks
                      // what that reflects along the normal
    uint pad1;
    uint pad2;
};
SHARED_SIZE(SurfaceRecord, 16 * SURFACE_ROWS)

// Push constants of one draw.
struct DrawRecord {
    mat4 world_from_object;    // to the world's axes with the origin at the eye
    vec4 normal_from_object_x; // columns of the inverse transpose; x.w: +-1, the sign of its determinant
    vec4 normal_from_object_y;
    vec4 normal_from_object_z;
    uint material; // index into MaterialRecords and SurfaceRecords
    uint pad0;
    uint pad1;
    uint pad2;
};
SHARED_SIZE(DrawRecord, 128)

// Push constants of the shade kernels.
struct ShadeRecord {
    uint point_count;   // or of pixels; behind as many lies what was not finite (shade/guard.glsl)
    uint tile_capacity; // tiles a class's list can hold
    uint batch;         // of a progressive reference, counted from 0
    uint batch_size;    // samples in a batch
    uint texel_begin;   // of a quadrature reference: texels of the map done in this dispatch
    uint texel_end;
    float display_scale; // of display output: 2^exposure
    uint light_count;
};
SHARED_SIZE(ShadeRecord, 32)

// Push constants of the accumulation.
struct AccumulateRecord {
    uint count;    // pixels
    uint is_first; // 1: the sum starts anew
    float weight;
    float display_scale; // of display output: 2^exposure
};
SHARED_SIZE(AccumulateRecord, 16)

// One texel of the table that draws texels in proportion to their light (Walker's alias method).
struct TexelAlias {
    float threshold;   // keep the texel drawn while the fraction is below
    uint alias;        // else take this one
    float probability; // of this texel
    uint pad0;
};
SHARED_SIZE(TexelAlias, 16)

// One texture of a material: uv' = (scale_rotation) uv + offset.
struct TextureRecord {
    vec4 scale_rotation; // columns of the 2x2 matrix: xy, zw
    vec2 offset;
    uint uv_set;          // 0 or 1
    uint coverage_levels; // COVERAGE_LEVELS_*: of the base colour, what alpha of its mip levels is
};
SHARED_SIZE(TextureRecord, 16 * TEXTURE_ROWS)

SHARED_END

#endif
