"""Suns taken out of a map: small bright discs shaded directly, so that no lookup has to carry them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot, normalize
from .cube_map import texel_directions, texel_solid_angle
from .estimator import LocalFrame
from .kurt_lobe import LobeLike, grazing_factor, kurt_d, schlick_fresnel, slopes

#: Most suns of a map.
MOST_SUNS = 4
# A sun's texel is this many times brighter than the mean.
_LEAST_CONTRAST = 100.0
# Radius of the cap that holds a sun, radians: 1 degree, at least 4 half-texels. The ring around is as wide.
_CAP_RADIUS, _CAP_HALF_TEXELS = np.radians(1.0), 4.0
# What the ring may exceed the background by, relative to the sun's peak.
_RING_EXCESS = 0.02


@dataclass(frozen=True)
class Sun:
    """A light of small extent."""

    direction: Array  # (3,), unit
    flux: Array  # (3,), radiance times solid angle
    variance: float  # per axis of angle


def split_suns(faces: npt.ArrayLike) -> tuple[list[Sun], Array]:
    """Take up to four suns out of a map.

    The brightest texel above 100 times the mean is the middle of a cap of 1 degree; the median of the ring
    around it, 1 to 2 degrees, is the background. It is a sun if nothing in the ring exceeds the background by
    2 % of the peak's excess; then flux, centroid and variance of the excess make the light and the background
    fills the cap. The first texel that is none ends the search: the next ones would be its neighbours.

    Parameters
    ----------
    faces : (6, N, N, 3)

    Returns
    -------
    suns : list of Sun
    filled : (6, N, N, 3)
    """
    filled = np.array(as_array(faces))
    size = filled.shape[1]
    directions, solid_angle = (
        texel_directions(size),
        np.broadcast_to(texel_solid_angle(size), filled.shape[:3]),
    )
    radius = max(_CAP_RADIUS, _CAP_HALF_TEXELS / size)
    suns: list[Sun] = []
    while len(suns) < MOST_SUNS:
        grey = np.mean(filled, axis=-1)
        peak = np.unravel_index(np.argmax(grey), grey.shape)
        if not grey[peak] > _LEAST_CONTRAST * np.sum(grey * solid_angle) / (4 * np.pi):
            break
        chord = np.linalg.norm(directions - directions[peak], axis=-1)
        cap, ring = chord <= radius, (chord > radius) & (chord <= 2 * radius)
        background = np.median(filled[ring], axis=0)
        grey_background = np.mean(background)
        if np.max(grey[ring]) - grey_background > _RING_EXCESS * (grey[peak] - grey_background):
            break
        energy = np.maximum(filled[cap] - background, 0) * solid_angle[cap][:, None]
        weight = np.mean(energy, axis=-1)
        direction = normalize(weight @ directions[cap])
        squared = np.sum((directions[cap] - direction) ** 2, axis=-1)
        variance = 0.5 * float(weight @ squared / np.sum(weight))
        suns.append(Sun(direction, np.sum(energy, axis=0), variance))
        filled[cap] = background
    return suns, filled


def shade_suns(suns: Sequence[Sun], frame: LocalFrame, lobe: LobeLike) -> Array:
    """Radiance of one lobe, without its weight, under suns: flux f cos_i of a lobe that is wider by the sun.

    A variance v of directions is v/(4 o.h) of half-vectors and v/(4 (o.h) hz^3) of their slopes, geometric
    means of the two axes each; the lobe's slopes have m^2/2.

    Returns
    -------
    radiance : (..., 3)
    """
    omega_o = frame.omega_o
    total = np.zeros(omega_o.shape)
    mx, my = slopes(lobe)
    axes = np.stack([frame.tangent, frame.bitangent, frame.normal], axis=-2)
    for sun in suns:
        omega_i = axes @ sun.direction
        h = normalize(omega_i + omega_o)
        seen = (omega_i[..., 2] > 0) & (h[..., 2] > 1e-3)
        h = np.where(seen[..., None], h, [0.0, 0.0, 1.0])
        o_h = np.maximum(dot(omega_o, h), 1e-4)
        wider = sun.variance / (2 * o_h * h[..., 2] ** 3)
        density = kurt_d(h, np.sqrt(mx * mx + wider), np.sqrt(my * my + wider)) / (4 * o_h)
        grazing = grazing_factor(omega_i[..., 2], omega_o[..., 2], lobe.alpha)
        value = np.where(seen, density * grazing, 0.0)
        fresnel = schlick_fresnel(o_h[..., None], np.broadcast_to(as_array(lobe.r0), 3))
        total = total + value[..., None] * fresnel * sun.flux
    return total
