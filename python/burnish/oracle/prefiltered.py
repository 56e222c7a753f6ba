"""Prefiltered maps: one lookup a lobe, times its exact albedo (split sum)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .albedo import blend_albedo
from .arrays import Array, as_array, dot, normalize, reflect
from .cube_map import PaddedCube, pad_cube, sample_cube, texel_directions, texel_solid_angle
from .estimator import local_frame
from .lobe.base import LobeLike, grazing_reflectance, normal_reflectance, rotation_of, slopes
from .lobe.models import model_of

#: A level of n texels along an edge is filtered by the lobe of slope LEVEL_SLOPE/n.
LEVEL_SLOPE = 3.0
#: Level 0, the map itself, looks as if filtered by this over n: a bilinear lookup's variance is 1/4 texel^2.
MAP_SLOPE = 0.5**0.5


@dataclass(frozen=True)
class Prefiltered:
    """One lookup a lobe, as `burnish.Prefiltered`."""


def filter_environment(faces: npt.ArrayLike, directions: npt.ArrayLike, roughness: float) -> Array:
    """Radiance of a map as an isotropic lobe of F = 1, alpha = 0 sees it along its normal.

    With omega_o = n the reflected direction has cos_h^2 = (1 + cos_i)/2 and o.h = cos_h, so that D cos_i dh
    is D cos_i/(4 cos_h) di. The mean under this weight over every texel of level 0, its middle and its exact
    solid angle standing for it: right for lobes some texels wide.

    Parameters
    ----------
    faces : (6, N, N, 3)
    directions : (..., 3)
        Normals, any length but zero.
    roughness : float
        Slope m of the lobe.

    Returns
    -------
    radiance : (..., 3)
    """
    faces = as_array(faces)
    size = faces.shape[1]
    omega_i = texel_directions(size).reshape(-1, 3).T
    solid_angle = np.broadcast_to(texel_solid_angle(size), (6, size, size)).ravel()
    radiance = faces.reshape(-1, 3)
    normals = normalize(directions)
    flat = normals.reshape(-1, 3)
    result = np.empty_like(flat)
    chunk = max(1, 4_000_000 // len(solid_angle))
    for begin in range(0, len(flat), chunk):
        cos_i = np.clip(flat[begin : begin + chunk] @ omega_i, 0.0, 1.0)
        tan2 = (1 - cos_i) / (1 + cos_i)
        weight = np.exp(-tan2 / roughness**2) * (1 + cos_i) ** -2.5 * cos_i * solid_angle
        result[begin : begin + chunk] = weight @ radiance / weight.sum(axis=1, keepdims=True)
    return result.reshape(normals.shape)


def prefilter_environment(faces: npt.ArrayLike) -> list[Array]:
    """All levels of the prefiltered map, (6, n, n, 3) each: the map, then lobes twice as wide each time."""
    levels = [as_array(faces)]
    size = levels[0].shape[1] // 2
    while size >= 1:
        levels.append(filter_environment(faces, texel_directions(size), LEVEL_SLOPE / size))
        size //= 2
    return levels


def prefiltered_level(roughness: float, face_size: int) -> float:
    """Level whose lobe has this slope, linearly in the log between two; not yet clamped to the last one."""
    level = np.log2(roughness * face_size / LEVEL_SLOPE)
    if level < 1:
        map_level = np.log2(MAP_SLOPE / LEVEL_SLOPE)
        level = max((level - map_level) / (1 - map_level), 0.0)
    return float(level)


def shade_prefiltered(
    levels: PaddedCube | Sequence[npt.ArrayLike],
    n: npt.ArrayLike,
    t: npt.ArrayLike,
    omega_o: npt.ArrayLike,
    lobe: LobeLike,
    sampler: Any = None,
) -> Array:
    """Radiance of one lobe: its albedo times one lookup at the mirrored view, 0 for views from behind.

    A brushed lobe is looked up as the round one of slope sqrt(mx my). Levels are filtered by Kurt's lobe:
    another model has its slope for it.

    Parameters
    ----------
    levels : the prefiltered map's levels, or a `PaddedCube`
    n, t, omega_o : (..., 3)
        Normals, tangents and views in the map's axes.
    sampler : Prefiltered
        It has no settings.

    Returns
    -------
    radiance : (..., 3)
    """
    cube = pad_cube(levels)
    frame = local_frame(n, t, omega_o, rotation_of(lobe))
    mx, my = slopes(lobe)
    model = model_of(lobe)
    # What lies in the middle of the lobe's plane: of lobes that mirror, the mirrored view.
    mirrored = reflect(frame.omega_o, np.array([0.0, 0.0, 1.0]))
    if not model.HAS_HALF_VECTORS:
        mirrored = model.reflect(frame.omega_o, lobe, np.zeros((*frame.omega_o.shape[:-1], 2))).omega_i
    direction = frame.to_world(mirrored[..., None, :])[..., 0, :]
    level = prefiltered_level(model.FILTER_SLOPE * np.sqrt(mx * my), int(cube.sizes[0]))
    albedo = blend_albedo(
        model.albedo(frame.omega_o, lobe), normal_reflectance(lobe), grazing_reflectance(lobe)
    )
    seen = dot(normalize(omega_o), normalize(n))[..., None] > 0
    result: Array = as_array(lobe.weight) * albedo * sample_cube(cube, direction, level)
    return np.where(seen, result, 0.0)
