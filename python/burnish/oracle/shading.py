"""A whole material at surface points: what `burnish.shade` computes."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .albedo import directional_albedo
from .arrays import Array, as_array
from .cube_map import pad_cube
from .estimator import local_frame, shade_diffuse, shade_lobe
from .kurt_lobe import LobeLike
from .prefiltered import shade_prefiltered
from .reference import shade_reference
from .spherical_harmonics import project_cube


def conserving_scale(normals: Array, tangents: Array, views: Array, lobe: LobeLike) -> Array:
    """1 / max(1, E_1), (..., 1): keeps a lobe from giving back more than it gets; 1 unless it asks for it."""
    if not lobe.conserve_energy or lobe.alpha == 0.0:
        return np.ones((*normals.shape[:-1], 1))
    omega_o = local_frame(normals, tangents, views, lobe.rotation).omega_o
    albedo: Array = directional_albedo(omega_o, lobe.roughness, lobe.alpha)[..., :1]
    return 1.0 / np.maximum(albedo, 1.0)


def shade(
    env_levels: Sequence[npt.ArrayLike],
    material: Any,
    sampler: Any,
    normals: npt.ArrayLike,
    tangents: npt.ArrayLike,
    views: npt.ArrayLike,
) -> Array:
    """Radiance toward the eye: diffuse part by spherical harmonics, lobes by the sampler, and emission.

    Parameters
    ----------
    env_levels : list of (6, n, n, 3)
        From `build_pyramid`; for Prefiltered from `prefilter_environment`.
    material : Material, or `burnish.Material`
    sampler : Regular, Importance, Prefiltered or Reference, the oracle's or burnish's
    normals, tangents, views : (..., 3)

    Returns
    -------
    radiance : (..., 3)
    """
    normals, tangents, views = np.broadcast_arrays(as_array(normals), as_array(tangents), as_array(views))
    total = np.zeros(normals.shape)
    if np.any(as_array(material.diffuse) > 0):
        total = total + shade_diffuse(project_cube(env_levels[0]), normals, material.diffuse)
    if type(sampler).__name__ == "Reference":
        for lobe in material.lobes:
            light = shade_reference(env_levels[0], normals, tangents, views, lobe)
            total = total + light * conserving_scale(normals, tangents, views, lobe)
    elif material.lobes:
        cube = pad_cube(env_levels)
        shade_one = shade_prefiltered if type(sampler).__name__ == "Prefiltered" else shade_lobe
        for lobe in material.lobes:
            light = shade_one(cube, normals, tangents, views, lobe, sampler)
            total = total + light * conserving_scale(normals, tangents, views, lobe)
    return total + as_array(getattr(material, "emissive", 0.0))
