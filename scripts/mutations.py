"""Stable forms of the shaders, the naive formulas that they replace, and hard cases that tell them apart."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mutation:
    """One textual replacement.

    Parameters
    ----------
    name : str
        What the naive form does.
    file : str
        Relative to the repository; `stable` occurs in it once.
    stable, naive : str
        What is replaced, and by what.
    cases : tuple of str
        Names of hard cases, any of which must fail.
    samplers : tuple of str
        Those to run the cases with; all of the case's where empty.
    """

    name: str
    file: str
    stable: str
    naive: str
    cases: tuple[str, ...]
    samplers: tuple[str, ...] = ()


LOBE, MATCHED, POINT = "glsl/shade/lobe.glsl", "glsl/shade/matched.glsl", "glsl/shade/surface_point.glsl"
KURT, FRAME, LOOKUP = "glsl/lobe/kurt.glsl", "glsl/lib/frame.glsl", "glsl/lookup/map_lookup.glsl"

MUTATIONS = (
    Mutation(
        "tan^2 as 1/cos^2 - 1",
        KURT,
        "float exponent = (x * x + y * y) / max(h.z * h.z, 1e-24);",
        "float exponent = (1.0 / (h.z * h.z) - 1.0) / (m.x * m.y);",
        ("lobe of slope 1e-3 about a texel",),
        ("reference",),
    ),
    Mutation(
        "square root of a cosine below the horizon",
        LOBE,
        "    float i = max(cos_i, 0.0);\n    if (ALPHA == ALPHA_ZERO)",
        "    float i = cos_i;\n    if (ALPHA == ALPHA_ZERO)",
        ("alpha 0.5, view at cos 0.01",),
        ("regular", "importance"),
    ),
    Mutation(
        "cos_i/(cos_i cos_o)^alpha below the horizon",
        LOBE,
        "return cos_i > 0.0 ? pow(i, 1.0 - alpha) : 0.0;",
        "return cos_i / pow(cos_i, alpha);",
        ("alpha 1, view at cos 0.01",),
        ("regular", "importance"),
    ),
    Mutation(
        "cosine of the view without a floor",
        POINT,
        "max(MIN_COS - cos_o, 0.0) * given.normal.xyz",
        "0.0 * given.normal.xyz",
        ("view at cos 1e-6",),
    ),
    Mutation(
        "views from behind are shaded",
        POINT,
        "point.is_seen = cos_o > 0.0;",
        "point.is_seen = true;",
        ("view from behind, widest lobe",),
    ),
    Mutation(
        "basis that divides by 1 + n.z",
        FRAME,
        "float s = n.z >= 0.0 ? 1.0 : -1.0;",
        "float s = 1.0;",
        ("normal straight down", "normal 1e-4 off straight down"),
        ("regular", "matched"),
    ),
    Mutation(
        "tangents that are no direction are used",
        FRAME,
        "bool is_usable = length2 > 1e-36 && once2 > 1e-10;",
        "bool is_usable = true;",
        ("tangent zero", "tangent along the normal"),
        ("regular", "matched"),
    ),
    Mutation(
        "one Gram-Schmidt step",
        FRAME,
        "vec3 twice = tangent - n * dot(n, tangent);",
        "vec3 twice = tangent;",
        ("tangent 2e-5 off the normal, round lobe",),
    ),
    Mutation(
        "a texel's solid angle shrinks by r, not by r^3",
        "glsl/lib/footprint.glsl",
        "return texel_factor * cos_d_hz * (inverse_largest * inverse_largest * inverse_largest);",
        "return texel_factor * cos_d_hz * inverse_largest;",
        ("wide lobes about the corners",),
        ("regular", "importance"),
    ),
    Mutation(
        "lookups that do not grow by |di/dh|",
        "glsl/lib/footprint.glsl",
        "return texel_factor * cos_d_hz * (inverse",
        "return texel_factor * (inverse",
        ("wide lobes about the edges",),
        ("regular", "importance"),
    ),
    Mutation(
        "sums divided without looking",
        LOBE,
        "    bvec3 usable = greaterThan(denominator, vec3(1e-30));\n"
        "    return mix(vec3(0.0), numerator / max(denominator, vec3(1e-30)), usable);",
        "    return numerator / denominator;",
        ("weight 0",),
        ("regular", "matched"),
    ),
    Mutation(
        "levels beyond the coarsest",
        LOOKUP,
        "clamped = clamped < last ? clamped : last;",
        "",
        ("levels 16 above the coarsest",),
    ),
    Mutation(
        "pairs counted in float32",
        LOOKUP,
        "aim.at = cube_begin + pairs_before(level, int(s)) +\n             "
        "(int(cube.face) * (aim.pitch + 1) + texel.y) * aim.pitch + texel.x;",
        "aim.at = int(float(cube_begin) + float(pairs_before(level, int(s))) + "
        "(cube.face * float(aim.pitch + 1) + float(texel.y)) * float(aim.pitch) + float(texel.x));",
        ("faces of 2048 texels",),
        ("regular",),
    ),
    Mutation(
        "filters that stop at the edge of a face",
        "glsl/pyramid/border.comp.glsl",
        "uvec4 pair = uvec4(load_folded(level, layer, x, y), load_folded(level, layer, x + 1, y));",
        "uvec4 pair = uvec4(load_texel(level, layer, clamp(x, 0, size - 1), clamp(y, 0, size - 1)), "
        "load_texel(level, layer, clamp(x + 1, 0, size - 1), clamp(y, 0, size - 1)));",
        ("seams, levels of gauss6", "rounding, levels of gauss6", "rounding, levels of gauss4"),
    ),
    Mutation(
        "filters that forget the corners",
        "glsl/pyramid/reduce.comp.glsl",
        "int corner_texels = touches_corner ? 4 * REACH * REACH : 0;",
        "int corner_texels = 0;",
        ("rounding, levels of gauss6", "constant, levels of gauss6"),
    ),
    Mutation(
        "weights of a filter that are not dyadic",
        "glsl/pyramid/reduce.comp.glsl",
        "return outer == 0 ? 0.03125 : outer == 1 ? 0.15625 : 0.3125;",
        "return outer == 0 ? 0.031 : outer == 1 ? 0.156 : 0.313;",
        ("constant, levels of gauss6", "rounding, levels of gauss6"),
    ),
    Mutation(
        "prefiltered maps without their weights' sum",
        "glsl/pyramid/prefilter.comp.glsl",
        "sum /= weight;",
        "sum /= float(record.sample_count);",
        ("constant, levels of prefiltered",),
    ),
    Mutation(
        "mixtures beyond the table's end",
        MATCHED,
        "int(node < float(MATCHED_ROWS - 1u) ? node : float(MATCHED_ROWS - 1u))",
        "int(node)",
        ("aspect 1000", "aspect 1000, across"),
        ("matched",),
    ),
    Mutation(
        "azimuth of a view along the normal",
        MATCHED,
        "return vec3(sine > 1e-6 ? local_o.xy / sine : vec2(1.0, 0.0), sine);",
        "return vec3(local_o.xy / sine, sine);",
        ("view along the normal", "brushed lobe along the normal"),
        ("matched",),
    ),
    Mutation(
        "logarithm of a level below 1",
        MATCHED,
        "return share > 1.0 ? 1.0 + 0.5 * log2(share) : share;",
        "return 1.0 + 0.5 * log2(share);",
        ("aspect 10", "aspect 34"),
        ("matched",),
    ),
    Mutation(
        "components below the horizon without a direction",
        MATCHED,
        "const float trace = 1e-8;",
        "const float trace = 0.0;",
        ("very brushed lobe at cos 1e-3",),
        ("matched",),
    ),
    Mutation(
        "suns that are points",
        "glsl/shade/suns.glsl",
        "float scale = sqrt(0.5 * variance) / h.z;",
        "float scale = 0.0;",
        ("sun of half a degree, split off",),
    ),
    Mutation(
        "map as sharp as a lobe of level 1",
        "glsl/shade/prefiltered.glsl",
        "return level >= 1.0 ? level : max((level - map_level) / (1.0 - map_level), 0.0);",
        "return level;",
        ("aspect 10", "roughness 0.1"),
        ("prefiltered",),
    ),
    Mutation(
        "rings of a sun in the diffuse part",
        "glsl/lib/spherical_harmonics.glsl",
        "return max(sum, vec3(0.0));",
        "return sum;",
        ("diffuse part under a sun",),
    ),
    Mutation(
        "normals that face away stay so",
        POINT,
        "return cos_o < least ? normalize(n + (least - cos_o) * omega_o) : n;",
        "return n;",
        ("normals facing away",),
    ),
)
