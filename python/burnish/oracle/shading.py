"""A whole material at surface points: what `burnish.shade` computes."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .albedo import blend_albedo
from .arrays import Array, as_array, dot
from .cube_map import PaddedCube, pad_cube
from .estimator import local_frame, shade_importance, shade_regular
from .importance import importance_half_vectors
from .irradiance import DiffuseForm, diffuse_light
from .lobe.base import grazing_reflectance, normal_reflectance, rotation_of
from .lobe.models import model_of
from .matched import MatchedMap, Placement, read_matched, shade_matched
from .plane import shade_plane
from .prefiltered import shade_prefiltered
from .reference import shade_reference
from .regular_pattern import choose_pattern


def energy_scale(normals: Array, tangents: Array, views: Array, lobe: Any, reflectance: Any = None) -> Array:
    """What a lobe is multiplied by for its energy, (..., 1) or (..., 3); 1 unless it asks for something.

    `conserve_energy`, and sheen: 1/max(1, E_1), E_1 the albedo for a reflectance of 1: no more comes back
    than came in.
    `compensate` "scale": 1 + r (1/E_1 - 1) with r = r0/f90, or `reflectance`: what light lost between facets.
    """
    compensates = getattr(lobe, "compensate", "none") == "scale"
    conserves = getattr(lobe, "conserve_energy", False) and lobe.alpha > 0.0
    if not (compensates or conserves or getattr(model_of(lobe), "ALWAYS_CONSERVES", False)):
        return np.ones((*normals.shape[:-1], 1))
    omega_o = local_frame(normals, tangents, views, rotation_of(lobe)).omega_o
    albedo: Array = model_of(lobe).albedo(omega_o, lobe)[..., :1]
    if not compensates:
        return 1.0 / np.maximum(albedo, 1.0)
    r = reflectance if reflectance is not None else normal_reflectance(lobe) / grazing_reflectance(lobe)
    scale: Array = 1 + as_array(r) * (1 / albedo - 1)
    return scale


def lobe_through(normals: Array, tangents: Array, views: Array, lobe: Any, share: Any) -> Array:
    """What a layer lets through of light from below, (..., 1): 1 - (a E_1 + b E_s), or 1 - max(E)."""
    omega_o = local_frame(normals, tangents, views, rotation_of(lobe)).omega_o
    parts: Array = model_of(lobe).albedo(omega_o, lobe)
    if share is None:
        reflected = as_array(lobe.weight) * blend_albedo(
            parts, normal_reflectance(lobe), grazing_reflectance(lobe)
        )
        reflected = reflected * energy_scale(normals, tangents, views, lobe)
        taken = np.max(reflected, axis=-1, keepdims=True)
    else:
        scale = energy_scale(normals, tangents, views, lobe, share[0] / max(sum(share), 1e-20))
        taken = (parts @ as_array(share))[..., None] * scale
    through: Array = 1 - np.clip(taken, 0, 1)
    return through


def add_layers(
    material: Any,
    lobes: Sequence[Array],
    below: Array,
    normals: Array,
    tangents: Array,
    views: Array,
    *,
    has_emission: bool = True,
) -> Array:
    """Sum of the light of the diffuse part (`below`), of lobes and of emission, (..., 3).

    Where a material has covers each lobe is a layer over those before it: they and the diffuse part are
    multiplied by what it lets through.
    """
    emissive = as_array(getattr(material, "emissive", 0.0)) if has_emission else np.zeros(3)
    total, shining = below, np.broadcast_to(emissive, below.shape)
    covers = getattr(material, "covers", None)
    for k, (lobe, light) in enumerate(zip(material.lobes, lobes, strict=True)):
        if covers is not None:
            share, is_over_emission = covers[k]
            through = lobe_through(normals, tangents, views, lobe, share)
            total = total * through
            shining = shining * through if is_over_emission else shining
        total = total + light
    return total + shining


def diffuse_form(sampler: Any) -> DiffuseForm | None:
    """How a sampler sees the light on diffuse surfaces; None for a reference, which sums exactly."""
    return None if type(sampler).__name__ == "Reference" else getattr(sampler, "diffuse", "cube")


def shade_lobe(
    cube: PaddedCube, n: npt.ArrayLike, t: npt.ArrayLike, omega_o: npt.ArrayLike, lobe: Any, sampler: Any
) -> Array:
    """Radiance of one lobe by the regular pattern or importance sampling, the oracle's or burnish's own."""
    name = type(sampler).__name__
    if name in ("Regular", "Importance") and not model_of(lobe).HAS_FIXED_HALF_VECTORS:
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


def _matched_lights(
    light_map: MatchedMap,
    material: Any,
    samples: int,
    frame: tuple[Array, Array, Array],
    placement: Placement | None,
) -> list[Array]:
    return [
        shade_matched(light_map, *frame, lobe, samples, placement) * energy_scale(*frame, lobe)
        for lobe in material.lobes
    ]


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
    frame = (normals, tangents, views)
    lights = _matched_lights(light_map, material, samples, frame, placement)
    return add_layers(material, lights, np.zeros(normals.shape), *frame, has_emission=False)


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
    frame = (normals, tangents, views)
    below = np.zeros(normals.shape)
    if np.any(as_array(material.diffuse) > 0):
        light = diffuse_light(env_levels[0], normals, diffuse_form(sampler))
        below = as_array(material.diffuse) * light
    name = type(sampler).__name__
    if name == "Reference":
        lights = [
            shade_reference(env_levels[0], *frame, lobe) * energy_scale(*frame, lobe)
            for lobe in material.lobes
        ]
    elif material.lobes and name == "Matched":
        light_map = read_matched(env_levels, sampler)
        placement = getattr(sampler, "placement", None)
        lights = _matched_lights(light_map, material, sampler.samples, frame, placement)
    else:
        cube = pad_cube(env_levels)
        shade_one = shade_prefiltered if name == "Prefiltered" else shade_lobe
        lights = [
            shade_one(cube, *frame, lobe, sampler) * energy_scale(*frame, lobe) for lobe in material.lobes
        ]
    seen = dot(normals, views)[..., None] > 0
    return np.where(seen, add_layers(material, lights, below, *frame), 0.0)
