"""How much light an environment carries at every angular scale: what decides the error of a sampler.

The map is halved again and again by exact area means, so the energies that are lost from level to level add
up to the whole: the variance of radiance in octaves of the angle (Haar's wavelets).
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from burnish._core import Environment
from burnish.cube_layout import cube_solid_angles
from burnish.oracle.sun_split import split_suns

Float64 = NDArray[np.float64]

FINEST_FACE = 256
"""Finer structure is below the lookups of every count: it costs time and predicts nothing."""


@dataclass(frozen=True)
class Spectrum:
    """Energy of radiance below and in octaves of angle.

    Parameters
    ----------
    log2_angles : (k,) float64
        Width of the texels of each level in radians, log2, rising.
    lost : (k,) float64
        Mean square radiance that the map has lost when it is blurred to such texels; rising from 0.
    lost_without_suns : (k,) float64
        The same of the map whose suns have been taken out, as `Matched` does.
    total, total_without_suns : float
        Mean square radiance of the map, over the sphere and the channels, with and without its suns.
    """

    log2_angles: Float64
    lost: Float64
    lost_without_suns: Float64
    total: float
    total_without_suns: float

    def lost_below(self, angles: Float64, has_suns: bool = True) -> Float64:
        """Mean square that structure narrower than the angles holds, interpolated in log2 of the angle.

        Parameters
        ----------
        angles : array
            Radians.
        has_suns : bool
            False: of the map without its suns.
        """
        lost = self.lost if has_suns else self.lost_without_suns
        return np.asarray(np.interp(np.log2(np.maximum(angles, 1e-9)), self.log2_angles, lost))

    def left_without_suns(self, angles: Float64) -> Float64:
        """Mean square that the map without its suns keeps when it is blurred to the angles.

        Parameters
        ----------
        angles : array
            Radians.
        """
        return self.total_without_suns - self.lost_below(angles, has_suns=False)


@cache
def _weights(face_size: int) -> Float64:
    return cube_solid_angles(face_size)[..., None]


def _halve(faces: Float64, face_size: int) -> Float64:
    """Means of 2x2 texels over their solid angles."""
    half = face_size // 2
    cells = (6, half, 2, half, 2, -1)
    sums = (faces * _weights(face_size)).reshape(cells).sum((2, 4))
    return np.asarray(sums / _weights(half))


def _energies(faces: Float64) -> tuple[Float64, Float64]:
    """Width of the texels in log2 of radians, and mean square radiance, of the map halved again and again."""
    face_size = faces.shape[1]
    energies, angles = [], []
    while True:
        energies.append(
            float(np.mean(np.sum(faces**2 * _weights(face_size), axis=(0, 1, 2)))) / (4 * math.pi)
        )
        angles.append(math.log2(2.0 / face_size))
        if face_size == 1:
            break
        faces, face_size = _halve(faces, face_size), face_size // 2
    # Coarser than a face there is the mean over the sphere.
    mean = (faces * _weights(1)).sum(axis=(0, 1, 2)) / (4 * math.pi)
    return np.array([*angles, math.log2(4.0)]), np.array([*energies, float(np.mean(mean**2))])


def measure_spectrum(environment: Environment) -> Spectrum:
    """Measure the energies of an environment.

    Parameters
    ----------
    environment : Environment
        Its exposure and rotation do not matter: errors are relative, and the sphere is taken as a whole.

    Returns
    -------
    spectrum : Spectrum
    """
    faces = environment.faces.astype(np.float64)
    while faces.shape[1] > FINEST_FACE:
        faces = _halve(faces, faces.shape[1])
    angles, energies = _energies(faces)
    suns, filled = split_suns(faces)
    without = _energies(filled)[1] if suns else energies
    lost, lost_without_suns = (np.maximum(one[0] - one, 0.0) for one in (energies, without))
    return Spectrum(angles, lost, lost_without_suns, float(energies[0]), float(without[0]))
