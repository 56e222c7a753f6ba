"""The truth of a glossy lobe: the reflectance integral as a sum over every texel of level 0."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array
from .cube_map import cube_direction, texel_solid_angle
from .estimator import local_frame
from .lobe.base import LobeLike, grazing_reflectance, rotation_of, schlick_fresnel
from .lobe.models import model_of

LEAST_QUADRATURE_FACE = 64
"""Least edge of the grid on a face in the engine's quadrature: texels of coarser maps are taken in parts."""


def quadrature_parts(face_size: int) -> int:
    """Parts along an edge that the engine's quadrature takes a texel of such faces in.

    Parameters
    ----------
    face_size : int
        Texels along the edge of a face, a power of two.
    """
    return max(1, LEAST_QUADRATURE_FACE // face_size)


def subdivide(faces: npt.ArrayLike, parts: int) -> Array:
    """Split each texel into parts x parts of the same radiance: for lobes narrower than a texel."""
    return np.repeat(np.repeat(as_array(faces), parts, axis=1), parts, axis=2)


def shade_reference(
    faces: npt.ArrayLike,
    n: npt.ArrayLike,
    t: npt.ArrayLike,
    omega_o: npt.ArrayLike,
    lobe: LobeLike,
    parts: int = 1,
) -> Array:
    """Radiance sum over texels of f cos_i L dw, dw the texel's exact solid angle.

    Parameters
    ----------
    faces : (6, N, N, c)
        Level 0; three channels, or any number where the lobe's r0 and weight are single numbers.
    n, t, omega_o : (..., 3)
    parts : int
        The lobe is evaluated at parts x parts points of each texel. One is enough while a texel (2/N radian)
        is narrower than the narrower slope.

    Returns
    -------
    radiance : (..., c)
    """
    faces = subdivide(faces, parts)
    size = faces.shape[1]
    frame = local_frame(n, t, omega_o, rotation_of(lobe))
    axes = np.stack([frame.tangent, frame.bitangent, frame.normal], axis=-2).reshape(-1, 3, 3)
    views = frame.omega_o.reshape(-1, 3)
    centers = (2 * np.arange(size) + 1) / size - 1
    grid_u, grid_v = np.meshgrid(centers, centers)
    energy = faces * texel_solid_angle(size)[None, :, :, None]
    channels = faces.shape[-1]
    total = np.zeros((len(views), channels))
    # One face at a time bounds memory; its texels are one matrix product per point.
    for face in range(6):
        directions = cube_direction(face, grid_u, grid_v).reshape(-1, 3).T
        for k, (axis, view) in enumerate(zip(axes, views, strict=True)):
            total[k] += _face_sum(axis @ directions, view, lobe, energy[face].reshape(-1, channels))
    return as_array(lobe.weight) * total.reshape(*frame.omega_o.shape[:-1], channels)


def _face_sum(omega_i: Array, omega_o: Array, lobe: LobeLike, energy: Array) -> Array:
    above = np.flatnonzero(omega_i[2] > 0)
    if len(above) == 0:
        return np.zeros(energy.shape[-1])
    values = model_of(lobe).values(omega_i[:, above], omega_o, lobe)
    r0, f90 = as_array(getattr(lobe, "r0", 1.0)), grazing_reflectance(lobe)
    fresnel = schlick_fresnel(values.o_h[:, None], r0, f90 if r0.ndim else f90[:1])
    result: Array = np.sum(values.value[:, None] * fresnel * energy[above[values.near]], axis=0)
    return result
