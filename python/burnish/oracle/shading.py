"""A whole material at surface points: what `burnish.shade` computes."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot
from .cube_map import PaddedCube, pad_cube
from .estimator import local_frame, shade_importance, shade_regular
from .importance import importance_half_vectors
from .irradiance import DiffuseForm, diffuse_light
from .lobe.models import model_of
from .matched import MatchedMap, Placement, read_matched, shade_matched
from .plane import shade_plane
from .prefiltered import shade_prefiltered
from .reference import shade_reference
from .regular_pattern import choose_pattern


def conserving_scale(normals: Array, tangents: Array, views: Array, lobe: Any) -> Array:
    """1 / max(1, E_1), (..., 1): keeps a lobe from giving back more than it gets; 1 unless it asks for it."""
    if not getattr(lobe, "conserve_energy", False) or lobe.alpha == 0.0:
        return np.ones((*normals.shape[:-1], 1))
    omega_o = local_frame(normals, tangents, views, lobe.rotation).omega_o
    albedo: Array = model_of(lobe).albedo(omega_o, lobe)[..., :1]
    return 1.0 / np.maximum(albedo, 1.0)


def diffuse_form(sampler: Any) -> DiffuseForm | None:
    """How a sampler sees the light on diffuse surfaces; None for a reference, which sums exactly."""
    return None if type(sampler).__name__ == "Reference" else getattr(sampler, "diffuse", "cube")


def shade_lobe(
    cube: PaddedCube, n: npt.ArrayLike, t: npt.ArrayLike, omega_o: npt.ArrayLike, lobe: Any, sampler: Any
) -> Array:
    """Radiance of one lobe by the regular pattern or importance sampling, the oracle's or burnish's own."""
    name = type(sampler).__name__
    if name in ("Regular", "Importance") and model_of(lobe).DENSITY != "gaussian":
        return shade_plane(cube, n, t, omega_o, lobe, sampler)
    if name == "Regular":
        pattern = choose_pattern(lobe.roughness, sampler.samples, sampler.threshold)
        return shade_regular(
            cube, n, t, omega_o, lobe, pattern,
            sampler.threshold, sampler.footprint, sampler.normalization, sampler.mip_bias,
        )  # fmt: skip
    if name == "Importance":
        half_vectors = importance_half_vectors(lobe.roughness, sampler.points, sampler.samples)
        return shade_importance(cube, n, t, omega_o, lobe, half_vectors, sampler.mip_bias)
    raise ValueError(f"sampler: expected Regular, Importance, Matched or Reference, got {name}")


def shade_matched_lobes(
    light_map: MatchedMap,
    material: Any,
    samples: int,
    normals: Array,
    tangents: Array,
    views: Array,
    placement: Placement | None = None,
) -> Array:
    """Radiance of all lobes of a material from a map that has been read for `matched`, (..., 3)."""
    total = np.zeros(normals.shape)
    for lobe in material.lobes:
        light = shade_matched(light_map, normals, tangents, views, lobe, samples, placement)
        total = total + light * conserving_scale(normals, tangents, views, lobe)
    return total


def shade(
    env_levels: Sequence[npt.ArrayLike],
    material: Any,
    sampler: Any,
    normals: npt.ArrayLike,
    tangents: npt.ArrayLike,
    views: npt.ArrayLike,
) -> Array:
    """Radiance toward the eye: the diffuse part in the sampler's form, lobes by the sampler, and emission.

    Points seen from behind are black.

    Parameters
    ----------
    env_levels : list of (6, n, n, 3)
        From `build_pyramid`; for Prefiltered from `prefilter_environment`.
    material : Material, or `burnish.Material`
    sampler : Regular, Importance, Matched, Prefiltered or Reference, the oracle's or burnish's
    normals, views : (..., 3)
    tangents : (..., 3), or (..., 4) with the bitangent's sign in the last

    Returns
    -------
    radiance : (..., 3)
    """
    normals, tangents, views = as_array(normals), as_array(tangents), as_array(views)
    shape = np.broadcast_shapes(normals.shape[:-1], tangents.shape[:-1], views.shape[:-1])
    normals, tangents, views = (np.broadcast_to(v, (*shape, v.shape[-1])) for v in (normals, tangents, views))
    total = np.zeros(normals.shape)
    if np.any(as_array(material.diffuse) > 0):
        light = diffuse_light(env_levels[0], normals, diffuse_form(sampler))
        total = total + as_array(material.diffuse) * light
    if type(sampler).__name__ == "Reference":
        for lobe in material.lobes:
            light = shade_reference(env_levels[0], normals, tangents, views, lobe)
            total = total + light * conserving_scale(normals, tangents, views, lobe)
    elif material.lobes and type(sampler).__name__ == "Matched":
        light_map = read_matched(env_levels, sampler)
        placement = getattr(sampler, "placement", None)
        total = total + shade_matched_lobes(
            light_map, material, sampler.samples, normals, tangents, views, placement
        )
    elif material.lobes:
        cube = pad_cube(env_levels)
        shade_one = shade_prefiltered if type(sampler).__name__ == "Prefiltered" else shade_lobe
        for lobe in material.lobes:
            light = shade_one(cube, normals, tangents, views, lobe, sampler)
            total = total + light * conserving_scale(normals, tangents, views, lobe)
    seen = dot(normals, views)[..., None] > 0
    return np.where(seen, total + as_array(getattr(material, "emissive", 0.0)), 0.0)
