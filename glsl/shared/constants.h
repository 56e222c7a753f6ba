// Binding numbers, specialization constants and sizes that GLSL and C++ must agree on.
#ifndef BURNISH_SHARED_CONSTANTS_H
#define BURNISH_SHARED_CONSTANTS_H

#include "shared/types.h"

SHARED_BEGIN

// Shading runs over tiles of TILE_SIZE^2 pixels; lanes of a CPU device lie along x, so it is a multiple of 8.
SHARED_CONST uint TILE_SIZE = 8u;
// Pipelines ("shade classes") one frame may use; a tile's classes are one bit each. The last is the
// background.
SHARED_CONST uint MAX_SHADE_CLASSES = 32u;
// Dispatches of more groups are folded into rows of equal length: one dimension may hold only 65535.
SHARED_CONST uint GROUPS_PER_ROW = 32768u;
// Lookups of all lobes of a point that are written out one by one; beyond, they are a loop: 56 take a CPU
// driver about 2 s to compile, 240 took 18 s.
SHARED_CONST uint MAX_UNROLLED_SAMPLES = 80u;

// Nodes of albedo tables, see cpp/burnish/lobe/albedo_table.h: cosines of the view and roughnesses lie at
// squares, so that they are dense where both are small.
SHARED_CONST uint ALBEDO_COS_NODES = 128u;
SHARED_CONST uint ALBEDO_ROUGHNESS_NODES = 32u; // of round lobes whose roughness varies
// Of brushed lobes whose roughness varies.
SHARED_CONST uint ALBEDO_BRUSHED_COS_NODES = 64u;
SHARED_CONST uint ALBEDO_ALONG_NODES = 32u;
SHARED_CONST uint ALBEDO_ACROSS_NODES = 12u;
SHARED_CONST uint ALBEDO_CORRELATION_NODES = 8u;

// The matched table is fitted at MATCHED_NODES aspects of the lobe on the map, evenly in their log up to 100,
// and read from MATCHED_ROWS: so many that the nearest will do.
SHARED_CONST uint MATCHED_NODES = 52u;
SHARED_CONST uint MATCHED_STUDENT_NODES = 18u; // of lobes with tails
SHARED_CONST uint MATCHED_ROWS = 1024u;
SHARED_CONST float MATCHED_LOG2_LARGEST_RHO = 6.6438562f;
// Mixtures of lobes with tails stand for the density in a window exp(-r^2/(2 R^2)): the wider a lobe the
// narrower its window, as what is beyond lies below the horizon. Lobes have the first window from none on,
// the others from a width on; a window leaves a share of the density, and its quotient grows no further than
// exp of the last.
SHARED_CONST uint MATCHED_WINDOWS = 3u;
SHARED_CONST float MATCHED_SECOND_WINDOW_WIDTH = 0.25f;
SHARED_CONST float MATCHED_SECOND_WINDOW = 2.7f;
SHARED_CONST float MATCHED_SECOND_WINDOW_SHARE = 0.8406213f;
SHARED_CONST float MATCHED_THIRD_WINDOW_WIDTH = 0.4f;
SHARED_CONST float MATCHED_THIRD_WINDOW = 1.4f;
SHARED_CONST float MATCHED_THIRD_WINDOW_SHARE = 0.6614072f;
SHARED_CONST float MATCHED_MOST_WINDOW_EXPONENT = 2.5f;
// Tables of placed samples hold MATCHED_ROWS views of a round lobe; of a brushed one, up to an aspect, a grid
// of views with so many nodes from the normal to the horizon.
SHARED_CONST uint MATCHED_VIEW_NODES = 128u;
SHARED_CONST float MATCHED_MOST_VIEW_ASPECT = 16.0f;
// A component of a mixture has this share of the linear map's variance if its lobe is wide or long, and less
// by (LESS - LESS_OF_ONE/n) exp(-DECAY mx my)/rho if it is narrow and round: the mean of two levels is wider
// than a level between them.
SHARED_CONST float MATCHED_VARIANCE_SHARE = 0.95f;
SHARED_CONST float MATCHED_NARROW_LESS = 0.13f;
SHARED_CONST float MATCHED_NARROW_LESS_OF_ONE = 0.25f;
SHARED_CONST float MATCHED_NARROW_DECAY = 16.0f;
// A component's variance is at least this share of the spread of what its points reflect; the linear map
// leaves next to nothing of one whose centre reflects the horizon.
SHARED_CONST float MATCHED_LEAST_SPREAD_SHARE = 0.5f;
// Mixtures by view follow the mean and covariance of what is reflected of a narrow lobe so far of the way,
// see moment_share. Moments are summed at a grid of views with so many from the normal to the horizon.
SHARED_CONST float MATCHED_MOMENT_SHARE = 0.8f;
SHARED_CONST uint MATCHED_MOMENT_NODES = 32u;
// Lobes of greater slopes have means over many points.
SHARED_CONST float MATCHED_WIDE_SLOPE = 0.35f;

// Texels along a face of an irradiance cube, the same with a border of one texel on each side, and all texels
// of the six faces.
SHARED_CONST uint IRRADIANCE_FACE = 32u;
SHARED_CONST uint IRRADIANCE_PITCH = 34u;
SHARED_CONST uint IRRADIANCE_TEXELS = 6936u;

// Points along a face at which a quadrature reference takes the lobe at least: texels of coarser maps are
// taken in parts.
SHARED_CONST uint LEAST_QUADRATURE_FACE = 64u;

// Words of a list of lights: how many, and which.
SHARED_CONST uint LIGHT_LIST_WORDS = 64u;

// Suns that may be taken out of one map.
SHARED_CONST uint MAX_SUNS = 4u;

// Bindings of the shade kernels.
SHARED_CONST uint BINDING_VIEW = 0u;
SHARED_CONST uint BINDING_MATERIALS = 1u;
SHARED_CONST uint BINDING_LOBES = 2u;
SHARED_CONST uint BINDING_MAP_RECORDS = 3u;
SHARED_CONST uint BINDING_SAMPLE_TABLE = 4u;
SHARED_CONST uint BINDING_ALBEDO_TABLE = 5u;
SHARED_CONST uint BINDING_MAPS = 6u;
SHARED_CONST uint BINDING_SURFACE = 7u;
SHARED_CONST uint BINDING_VARYING_DIFFUSE = 8u;
SHARED_CONST uint BINDING_VARYING_SPECULAR = 9u;
SHARED_CONST uint BINDING_VARYING_EMISSIVE = 10u;
SHARED_CONST uint BINDING_VARYING_COAT = 11u;
SHARED_CONST uint BINDING_POINTS = 12u;
SHARED_CONST uint BINDING_TILES = 13u;
SHARED_CONST uint BINDING_RADIANCE = 14u;
SHARED_CONST uint BINDING_COUNTERS = 15u;
SHARED_CONST uint BINDING_TEXEL_ALIAS = 16u;
SHARED_CONST uint BINDING_STATISTICS = 17u;
SHARED_CONST uint BINDING_TILE_COUNTS = 18u; // xyz: indirect dispatch, w: tiles
SHARED_CONST uint BINDING_MAP_PAIRS = 19u;
SHARED_CONST uint BINDING_STORED_PAIRS = 20u;
SHARED_CONST uint BINDING_STORED_SAMPLE_TABLE = 21u;
SHARED_CONST uint BINDING_IRRADIANCE = 23u; // cubes, by map
SHARED_CONST uint BINDING_STORED_IRRADIANCE = 24u;
SHARED_CONST uint BINDING_LIGHTS = 25u;
SHARED_CONST uint BINDING_LIGHT_LISTS = 26u; // of LIGHT_LIST_WORDS each, by tile or group of points
SHARED_CONST uint BINDING_DEPTH = 27u;
SHARED_CONST uint BINDING_DISPLAY = 22u; // 8 bits a channel in place of BINDING_RADIANCE

SHARED_CONST uint BINDING_ACCUMULATE_SAMPLE = 0u;
SHARED_CONST uint BINDING_ACCUMULATE_SUM = 1u;
SHARED_CONST uint BINDING_ACCUMULATE_DISPLAY = 2u;

// Specialization constants of the shade kernels.
SHARED_CONST uint SPEC_SOURCE = 0u;
SHARED_CONST uint SPEC_LOBE_COUNT = 1u;
SHARED_CONST uint SPEC_HAS_FRESNEL = 2u;
SHARED_CONST uint SPEC_ALPHA = 3u;
SHARED_CONST uint SPEC_HAS_TANGENT = 4u;
SHARED_CONST uint SPEC_TABLE = 5u;
SHARED_CONST uint SPEC_FOOTPRINT = 6u;
SHARED_CONST uint SPEC_NORMALIZATION = 7u;
SHARED_CONST uint SPEC_HAS_DIFFUSE = 8u;
SHARED_CONST uint SPEC_HAS_EMISSIVE = 9u;
SHARED_CONST uint SPEC_HAS_VARYING = 10u;
SHARED_CONST uint SPEC_HAS_MAP_ROTATION = 11u;
SHARED_CONST uint SPEC_SAMPLE_COUNT = 12u;
SHARED_CONST uint SPEC_SHADE_CLASS = 13u;
SHARED_CONST uint SPEC_CLASS_COUNT = 14u;
SHARED_CONST uint SPEC_HAS_COAT = 15u;
SHARED_CONST uint SPEC_LOBE_MODELS = 16u; // four bits a lobe, MODEL_...
SHARED_CONST uint SPEC_IS_QUADRATURE = 17u;
SHARED_CONST uint SPEC_WITHOUT_LOOKUPS = 18u; // for benchmarks: shading alone
SHARED_CONST uint SPEC_CONSERVES_ENERGY = 19u;
SHARED_CONST uint SPEC_WIDE_COMPONENTS = 20u;
SHARED_CONST uint SPEC_SUN_COUNT = 21u;
SHARED_CONST uint SPEC_LOOKUP = 22u;
SHARED_CONST uint SPEC_LAST_LEVEL = 23u;             // log2 of the size of the map's faces
SHARED_CONST uint SPEC_SAMPLE_TABLE_IS_STORED = 24u; // in a storage buffer: a texel buffer holds fewer
SHARED_CONST uint SPEC_IS_DISPLAY = 25u;             // of the accumulation too
SHARED_CONST uint SPEC_COUNTS_NON_FINITE = 26u;      // what is not finite is counted, too
SHARED_CONST uint SPEC_PHASE = 27u;                  // lookups at a turn, of tables in a buffer
SHARED_CONST uint SPEC_HAS_COAT_NORMAL = 28u;        // the clear coat's normal is not the base's
SHARED_CONST uint SPEC_HAS_HARMONICS = 29u; // diffuse light by nine harmonics, not by an irradiance cube
SHARED_CONST uint SPEC_IRRADIANCE_IS_STORED = 30u; // in a storage buffer: a texel buffer holds fewer
SHARED_CONST uint SPEC_HAS_LAYERS = 31u;           // lobes take light from what lies below them
SHARED_CONST uint SPEC_HAS_LIGHTS = 32u;           // direct lights
SHARED_CONST uint SPEC_LISTS_LIGHTS = 33u;         // tiles read which of them reach them
SHARED_CONST uint SPEC_TILE_LIST = 34u;            // of tiles that a kernel shades
SHARED_CONST uint SPEC_HAS_FIXED_LOBE = 35u;       // of a textured material, one that no texture varies
SHARED_CONST uint SPEC_HAS_VARYING_EMISSIVE =
    36u;                               // emission and reflectances along the surface are read, too
SHARED_CONST uint SPEC_SAMPLES = 100u; // of the lookups alone, for benchmarks: four floats a sample follow

SHARED_CONST uint LOOKUP_SAMPLER = 0u; // the device's
SHARED_CONST uint LOOKUP_TEXELS = 1u;  // our own (lookup/map_lookup.glsl), from a texel buffer
SHARED_CONST uint LOOKUP_STORAGE = 2u; // our own, from a storage buffer: more pairs than texel buffers hold

// Passes whose values are stopped where they are not finite.
SHARED_CONST uint GUARD_SHADE = 0u;
SHARED_CONST uint GUARD_BACKGROUND = 1u;
SHARED_CONST uint GUARD_REFERENCE = 2u;
SHARED_CONST uint GUARD_COUNT = 3u;

SHARED_CONST uint SOURCE_PIXELS = 0u;
SHARED_CONST uint SOURCE_POINTS = 1u;
// Models of lobes.
SHARED_CONST uint MODEL_KURT = 0u;
SHARED_CONST uint MODEL_GGX = 1u;
SHARED_CONST uint MODEL_LAFORTUNE = 2u;
SHARED_CONST uint MODEL_SHEEN = 3u;
SHARED_CONST uint MODEL_BITS = 4u;
// What is done about a lobe's energy: nothing; more than it gets is divided out; what is lost between facets
// is put back.
SHARED_CONST uint ENERGY_AS_IT_IS = 0u;
SHARED_CONST uint ENERGY_CONSERVED = 1u;
SHARED_CONST uint ENERGY_COMPENSATED = 2u;
SHARED_CONST uint ALPHA_ZERO = 0u;    // cos_i
SHARED_CONST uint ALPHA_HALF = 1u;    // a square root
SHARED_CONST uint ALPHA_GENERAL = 2u; // a power
SHARED_CONST uint TABLE_BUFFER = 1u;  // any lobes
// Any lobes, slopes in units of a roughness that varies over the surface.
SHARED_CONST uint TABLE_SCALED_REGULAR = 2u;
SHARED_CONST uint TABLE_SCALED_IMPORTANCE = 3u;
SHARED_CONST uint TABLE_MATCHED =
    4u; // mixtures by the aspect of the lobe's mirrored axes, placed at every point
SHARED_CONST uint TABLE_MATCHED_BY_VIEW = 6u; // mixtures by the view, placed for the material
SHARED_CONST uint TABLE_PREFILTERED = 5u;     // one lookup in a map prefiltered for the roughness
SHARED_CONST uint FOOTPRINT_PUBLISHED = 0u;
SHARED_CONST uint FOOTPRINT_EXACT = 1u;
SHARED_CONST uint NORMALIZATION_CONSTANT = 0u;  // the table's weights sum as they must
SHARED_CONST uint NORMALIZATION_FURNACE = 1u;   // divided by the sum of weights, times the albedo
SHARED_CONST uint NORMALIZATION_PUBLISHED = 2u; // scaled tables: divided by the sum of D
SHARED_CONST uint NORMALIZATION_PROJECTED = 3u; // scaled tables: divided by the sum of D cos_h

// Bindings and specialization constants of the surface pass.
SHARED_CONST uint BINDING_SURFACE_VIEW = 0u;
SHARED_CONST uint BINDING_SURFACE_MATERIALS = 1u;
SHARED_CONST uint BINDING_SURFACE_TEXTURE_RECORDS = 2u;
SHARED_CONST uint BINDING_SURFACE_TEXTURES = 3u; // eleven from here on, one for each texture kind
SHARED_CONST uint TEXTURE_BASE_COLOR = 0u;
SHARED_CONST uint TEXTURE_METALLIC_ROUGHNESS = 1u;
SHARED_CONST uint TEXTURE_NORMAL = 2u;
SHARED_CONST uint TEXTURE_OCCLUSION = 3u;
SHARED_CONST uint TEXTURE_EMISSIVE = 4u;
SHARED_CONST uint TEXTURE_SPECULAR = 5u;
SHARED_CONST uint TEXTURE_SPECULAR_COLOR = 6u;
SHARED_CONST uint TEXTURE_ANISOTROPY = 7u;
SHARED_CONST uint TEXTURE_CLEARCOAT = 8u;
SHARED_CONST uint TEXTURE_CLEARCOAT_ROUGHNESS = 9u;
SHARED_CONST uint TEXTURE_CLEARCOAT_NORMAL = 10u;
SHARED_CONST uint TEXTURE_KINDS = 11u;
// Alpha of a masked texture's mip levels: averaged, or coverage that is averaged, and how levels go over into
// each other.
SHARED_CONST uint COVERAGE_LEVELS_NONE = 0u;
SHARED_CONST uint COVERAGE_LEVELS_NEAREST = 1u;
SHARED_CONST uint COVERAGE_LEVELS_LINEAR = 2u;
SHARED_CONST uint SPEC_TEXTURES = 0u; // bit k: texture kind k is read
SHARED_CONST uint SPEC_VERTEX_COLOR = 1u;
SHARED_CONST uint SPEC_ALPHA_MASK = 2u;
SHARED_CONST uint SPEC_DOUBLE_SIDED = 3u;
SHARED_CONST uint SPEC_SURFACE_TANGENT = 4u;
SHARED_CONST uint SPEC_UNLIT = 5u; // KHR_materials_unlit: vertex colours multiply the emission

SHARED_END

#endif
