"""Diffuse light: the cosine sum over every texel, and the small cube of such sums that samplers look up."""

from typing import Literal

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, normalize
from .cube_map import add_border, pad_cube, sample_cube, texel_directions, texel_solid_angle
from .estimator import shade_diffuse
from .reference import subdivide
from .spherical_harmonics import project_cube

DiffuseForm = Literal["cube", "harmonics"]

#: Texels along a face of the cube.
IRRADIANCE_FACE = 32

#: Coarser maps are taken in parts, so that the cosine is not one value over a wide texel.
LEAST_FACE = 64

#: Normals that are summed for at once: bounds memory.
_CHUNK = 256

_cubes: dict[tuple[tuple[int, ...], int], Array] = {}


def cosine_sum(faces: npt.ArrayLike, normals: npt.ArrayLike) -> Array:
    """Return E(n)/pi = 1/pi sum over texels of L max(0, n.w) dw, dw the texel's exact solid angle.

    Parameters
    ----------
    faces : (6, N, N, c)
        Radiance, level 0. Below N = 64 texels are split.
    normals : (..., 3)
        Of any length, in the map's axes.

    Returns
    -------
    values : (..., c)
    """
    faces = as_array(faces)
    faces = subdivide(faces, max(1, LEAST_FACE // faces.shape[1]))
    size, channels = faces.shape[1], faces.shape[-1]
    energy = (faces * texel_solid_angle(size)[None, :, :, None]).reshape(-1, channels) / np.pi
    directions = texel_directions(size).reshape(-1, 3).T
    n = normalize(normals)
    flat = n.reshape(-1, 3)
    total = np.zeros((len(flat), channels))
    for begin in range(0, len(flat), _CHUNK):
        part = slice(begin, begin + _CHUNK)
        for texels in np.array_split(np.arange(len(energy)), max(1, len(energy) // 65536)):
            total[part] += np.maximum(flat[part] @ directions[:, texels], 0) @ energy[texels]
    return total.reshape(*n.shape[:-1], channels)


def irradiance_cube(faces: npt.ArrayLike) -> Array:
    """Return the texels of a cube of 32 along a face that bilinear lookups give irradiance over pi from.

    They are the cosine sums at their centres, less 1/12 of the second differences along both axes: by so much
    a bilinear lookup of a smooth function is too large on the average.

    Returns
    -------
    texels : (6, 32, 32, 3)
        Beside light that sets they may fall below 0, where lookups are clamped.
    """
    faces = as_array(faces)
    key = (faces.shape, hash(faces.tobytes()))
    if key not in _cubes:
        if len(_cubes) >= 16:
            _cubes.clear()
        exact = cosine_sum(faces, texel_directions(IRRADIANCE_FACE))
        b = add_border(exact, 1)
        around = b[:, 1:-1, 2:] + b[:, 1:-1, :-2] + b[:, 2:, 1:-1] + b[:, :-2, 1:-1]
        _cubes[key] = exact - (around - 4 * exact) / 12
    return _cubes[key]


def diffuse_light(faces: npt.ArrayLike, normals: npt.ArrayLike, form: DiffuseForm | None) -> Array:
    """Irradiance over pi, (..., 3), as samplers of a form see it; None: exact, as the reference does."""
    if form is None:
        return cosine_sum(faces, normals)
    if form == "cube":
        return np.maximum(sample_cube(pad_cube([irradiance_cube(faces)]), normals), 0)
    if form == "harmonics":
        return shade_diffuse(project_cube(faces), normals, 1.0)
    raise ValueError(f'diffuse: expected "cube" or "harmonics", got {form!r}')
