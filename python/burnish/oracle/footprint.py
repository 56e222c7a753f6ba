"""Mip levels: how many level-0 texels one lookup stands for."""

import math
from typing import Literal

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array
from .cube_map import cube_stretch
from .pyramid import LOOKUP_VARIANCE, Filter

Footprint = Literal["published", "exact"]

# Smallest texel count and cosine that enter a logarithm or a quotient.
_TINY = 1e-12


def level_of_texels(texels: npt.ArrayLike, face_texels: int, mip_bias: float = 0.0) -> Array:
    """Level whose texel covers `texels` level-0 texels, .5 log2(texels) + bias, clamped to [0, log2 N]."""
    last = 0.5 * math.log2(face_texels)
    return np.clip(0.5 * np.log2(np.maximum(as_array(texels), _TINY)) + mip_bias, 0.0, last)


def exact_texels(
    i_h: npt.ArrayLike, direction: npt.ArrayLike, lobe_area: float, count: int, face_texels: int
) -> Array:
    """Level-0 texels under one of `count` samples of a lobe of half-vectors of solid angle `lobe_area`.

    A sample stands for lobe_area/count steradian of half-vectors, thus for 4 (h.i) times that of directions;
    a texel subtends 4/(face_texels r^3).

    Parameters
    ----------
    i_h : (...)
        Cosine between light direction and half-vector.
    direction : (..., 3)
        The lookup's direction in the map's axes.
    """
    result: Array = cube_stretch(direction) ** 3 * np.maximum(as_array(i_h), 0)
    return result * (face_texels * lobe_area / count)


def published_area(omega_o: npt.ArrayLike, mx: float, my: float, threshold: float) -> Array:
    """Solid angle of the lobe of directions as eqs. 14-15 have it, pi u v, by its stable form.

    sin(a_U/2) = sin theta_U sqrt(ox^2 + oz^2), sin(a_V/2) = sin theta_V sqrt(oy^2 + oz^2),
    area = 4 pi sin(a_U/2) sin(a_V/2); theta_U = atan(mx sqrt(-ln threshold)), theta_V with my.
    It depends on the azimuth of the view even for isotropic lobes, which the exact form does not.
    """
    x, y, z = np.moveaxis(as_array(omega_o), -1, 0)
    reach = math.sqrt(-math.log(threshold))
    sin_u = math.sin(math.atan(mx * reach)) * np.sqrt(x * x + z * z)
    sin_v = math.sin(math.atan(my * reach)) * np.sqrt(y * y + z * z)
    result: Array = 4 * np.pi * sin_u * sin_v
    return result


def published_texels(
    i_h: npt.ArrayLike, direction: npt.ArrayLike, lobe_area: npt.ArrayLike, count: int, face_texels: int
) -> Array:
    """Level-0 texels under a sample as eq. 16 has it: face_texels r area/(4 n (i.h)), r not cubed."""
    result: Array = cube_stretch(direction) * as_array(lobe_area) / np.maximum(as_array(i_h), _TINY)
    return result * (face_texels / (4 * count))


def importance_texels(pdf: npt.ArrayLike, direction: npt.ArrayLike, count: int, face_texels: int) -> Array:
    """Level-0 texels under one of `count` samples of density `pdf` per steradian: 1/(n p) over a texel's."""
    result: Array = cube_stretch(direction) ** 3 / np.maximum(as_array(pdf), _TINY)
    return result * (face_texels / (4 * count))


def planar_level(
    variance: npt.ArrayLike, direction: npt.ArrayLike, face_texels: int, filter: Filter = "gauss6"
) -> Array:
    """Level at which a lookup has this variance per axis of angle, not clamped.

    A kernel round in a face's (u, v) spans r^-2 of its width on the sphere along the radius of the face and
    r^-1 across: v = 2 variance/(r^-4 + r^-2) in (u, v), and c_f 4^l texels squared are c_f 4^l 4/face_texels.

    Parameters
    ----------
    variance : (...), > 0
    direction : (..., 3)
        In the map's axes.
    """
    r2 = cube_stretch(direction) ** 2
    v = 2 * as_array(variance) / (r2**-2 + 1 / r2)
    result: Array = 0.5 * np.log2(v * (face_texels / (4 * LOOKUP_VARIANCE[filter])))
    return result
