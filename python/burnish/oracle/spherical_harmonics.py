"""Diffuse light from nine spherical-harmonic coefficients (Ramamoorthi and Hanrahan 2001)."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array
from .cube_map import texel_directions, texel_solid_angle

#: The clamped cosine's factors for bands 0, 1, 2, one for each coefficient.
COSINE_FACTORS = np.pi * np.array([1, 2 / 3, 2 / 3, 2 / 3, 1 / 4, 1 / 4, 1 / 4, 1 / 4, 1 / 4])


def harmonics(d: npt.ArrayLike) -> Array:
    """Real harmonics of unit directions, (..., 9), in the order (l, m) = 00 1-1 10 11 2-2 2-1 20 21 22."""
    x, y, z = np.moveaxis(as_array(d), -1, 0)
    band0 = 0.5 * np.sqrt(1 / np.pi)
    band1 = 0.5 * np.sqrt(3 / np.pi)
    band2 = 0.5 * np.sqrt(15 / np.pi)
    return np.stack(
        [
            np.full_like(x, band0),
            band1 * y,
            band1 * z,
            band1 * x,
            band2 * x * y,
            band2 * y * z,
            0.25 * np.sqrt(5 / np.pi) * (3 * z * z - 1),
            band2 * x * z,
            0.5 * band2 * (x * x - y * y),
        ],
        axis=-1,
    )


def project_cube(faces: npt.ArrayLike) -> Array:
    """Coefficients (9, 3) of level 0: the sum over texels of radiance, harmonic and exact solid angle."""
    faces = as_array(faces)
    size = faces.shape[1]
    weighted = faces * texel_solid_angle(size)[None, :, :, None]
    basis = harmonics(texel_directions(size)).reshape(-1, 9)
    coefficients: Array = basis.T @ weighted.reshape(-1, faces.shape[-1])
    return coefficients


def irradiance(coefficients: npt.ArrayLike, normals: npt.ArrayLike) -> Array:
    """Return E(n) = sum A_l L_lm Y_lm(n), (..., 3); ringing can take it below 0."""
    result: Array = harmonics(normals) @ (COSINE_FACTORS[:, None] * as_array(coefficients))
    return result
