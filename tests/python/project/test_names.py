"""One concept, one name: what glsl/lib and glsl/lobe define has its float64 twin, or a reason."""

import importlib
import pkgutil
import re
from pathlib import Path

import burnish.oracle

REPOSITORY = Path(__file__).resolve().parents[3]
FUNCTION = re.compile(r"^(?:void|bool|u?int|float|u?vec[234]|mat[234](?:x[234])?)\s+(\w+)\s*\(", re.MULTILINE)

# Twins under another name: why it differs.
NAMED_OTHERWISE = {
    "mip_level": ("level_of_texels", "the oracle's also adds the bias and clamps"),
    "texels_exact": (
        "exact_texels",
        "the shader's part that does not depend on the pattern is hoisted into its table",
    ),
    "texels_published": (
        "published_texels",
        "the shader's part that does not depend on the pattern is hoisted",
    ),
    "published_area_term": ("published_area", "the factor that depends on the view only"),
    "grazing_term": ("grazing_factor", "the shader's takes cosines that are already clamped"),
    "sample_kurt": ("kurt_sample", "sampling triples are spelled differently on the two sides"),
    "kurt_value": ("kurt_brdf", "without Fresnel and weight, which the kernel applies to colours"),
    "sample_ggx": ("ggx_sample", "sampling triples are spelled differently on the two sides"),
    "ggx_pdf": ("ggx_pdf_omega_i", "of directions, the only one that there is"),
    "ggx_linear_map": ("linear_map", "models are modules in the oracle"),
    "ggx_rest": ("rest", "models are modules in the oracle"),
    "ggx_widened_d": ("widened_d", "models are modules in the oracle"),
    "lafortune_value": ("lafortune_brdf", "times the cosine, without the weight"),
    "lafortune_under_light": ("under_light", "models are modules in the oracle"),
    "lafortune_linear_map": ("linear_map", "models are modules in the oracle"),
    "kurt_widened_d": ("widened_d", "models are modules in the oracle"),
    "widened_form": ("quadratic_form", "the oracle's has the sum of both covariances"),
    "irradiance_over_pi": ("irradiance", "the shader's coefficients have 1/pi in them"),
    "slope_from_perceptual": ("map_metallic_roughness", "the first step of the mapping"),
    "schlick_weight": ("schlick_fresnel", "the fifth power alone"),
}

# Functions without a twin: why none is needed.
WITHOUT_TWIN = {
    f"lobe_{name}": "the switch between models, which are modules in the oracle"
    for name in (
        *("d", "rest", "value", "pdf", "linear_map", "widened_d", "under_light", "axis", "filter_slope"),
        *("albedo_width", "albedo_gain"),
    )
} | {
    "has_half_vectors": "a constant of the oracle's modules",
    "has_fixed_half_vectors": "a constant of the oracle's modules",
    "has_tail": "the oracle's modules name their density",
    "cosine_power": "float64 needs no other form than the power",
    "lafortune_pdf": "the oracle draws by places of the plane",
    "lafortune_axes": "the oracle's is private",
    "sheen_d": "a line of the oracle's value",
    "sheen_curve": "the oracle's is private",
    "sheen_half_vector": "the oracle's arrays are normalised in place",
}


def glsl_functions():
    files = [
        path for folder in ("lib", "lobe") for path in sorted((REPOSITORY / "glsl" / folder).glob("*.glsl"))
    ]
    return {name: path.name for path in files for name in FUNCTION.findall(path.read_text())}


def oracle_functions():
    names = set()
    for module in pkgutil.walk_packages(burnish.oracle.__path__, "burnish.oracle."):
        names |= {n for n in vars(importlib.import_module(module.name)) if not n.startswith("_")}
    return names


def test_every_lib_function_has_a_twin_or_a_reason():
    twins = oracle_functions()
    missing = [
        f"{name} ({path})"
        for name, path in glsl_functions().items()
        if name not in twins and name not in NAMED_OTHERWISE and name not in WITHOUT_TWIN
    ]
    assert not missing, (
        f"no function of that name in burnish.oracle, and no reason here: {', '.join(missing)}"
    )


def test_the_exceptions_are_not_stale():
    functions, twins = glsl_functions(), oracle_functions()
    assert not [name for name in [*NAMED_OTHERWISE, *WITHOUT_TWIN] if name not in functions]
    assert not [name for name in [*NAMED_OTHERWISE, *WITHOUT_TWIN] if name in twins]
    assert not [twin for twin, _ in NAMED_OTHERWISE.values() if twin not in twins]
