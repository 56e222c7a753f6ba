"""Suns taken out of a map: small bright discs shaded directly, so that no lookup has to carry them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot, normalize
from .cube_map import texel_directions, texel_solid_angle
from .estimator import LocalFrame
from .lobe.base import LobeLike, grazing_reflectance, normal_reflectance, schlick_fresnel
from .lobe.models import model_of

#: Most suns of a map.
MOST_SUNS = 4
# A sun's texel is this many times brighter than the mean.
_LEAST_CONTRAST = 100.0
# Radius of the cap that holds a sun, radians: 1 degree, at least 4 half-texels. The ring around is as wide.
_CAP_RADIUS, _CAP_HALF_TEXELS = np.radians(1.0), 4.0
# Of h_z, what a deviation of the sun may change it by in a linear change of slope.
_MOST_STEP = 0.1
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

    A variance v of directions is v/4 of half-vectors in the plane of view and light, and v/(4 (o.h)^2) across
    it, which at grazing views is much more. A step dh changes a slope s = h_xy/hz by (dh_xy - s dh_z)/hz. Of
    dh_z/hz no more than a tenth counts: where the half-vector lies along the surface, the linear change would
    give it the slopes of all others. The model says what the covariance of these slopes makes of its D.

    Returns
    -------
    radiance : (..., 3)
    """
    total = np.zeros(frame.omega_o.shape)
    for sun in suns:
        total = total + shade_small_light(sun.direction, sun.variance, frame, lobe) * sun.flux
    return total


def shade_small_light(
    direction: npt.ArrayLike, variance: npt.ArrayLike, frame: LocalFrame, lobe: LobeLike
) -> Array:
    """F f cos_i, (..., 3), of a lobe that is wider by a light; see `shade_suns`.

    Parameters
    ----------
    direction : (3,) or (..., 3)
        World frame, unit, to the light's middle.
    variance : float or (...)
        Of its directions, per axis, radian^2.
    frame : LocalFrame
        Of the lobe.
    lobe : lobe
        Its weight does not count.
    """
    omega_o, model = frame.omega_o, model_of(lobe)
    axes = np.stack([frame.tangent, frame.bitangent, frame.normal], axis=-2)
    omega_i = np.einsum("...ij,...j->...i", axes, as_array(direction))
    if not model.HAS_HALF_VECTORS:
        value = model.under_light(omega_i, omega_o, lobe, as_array(variance))
        return np.where((omega_i[..., 2] > 0)[..., None], value[..., None], 0.0) * np.ones(3)
    total = omega_i + omega_o
    length = np.linalg.norm(total, axis=-1, keepdims=True)
    h = total / np.maximum(length, 1e-300)
    seen = (omega_i[..., 2] > 0) & (h[..., 2] > 1e-3) & (length[..., 0] > 1e-6)
    h = np.where(seen[..., None], h, [0.0, 0.0, 1.0])
    o_h = np.maximum(dot(omega_o, h), 1e-4)
    covariance = _slope_covariance(h, omega_o, o_h, as_array(variance))
    i = np.where(seen[..., None], omega_i, [0.0, 0.0, 1.0])
    density = model.widened_d(h[..., :2] / h[..., 2:], lobe, covariance) / h[..., 2] ** 4
    value = np.where(seen, density * model.rest(i, omega_o, o_h, lobe), 0.0)
    fresnel = schlick_fresnel(o_h[..., None], normal_reflectance(lobe), grazing_reflectance(lobe))
    result: Array = value[..., None] * fresnel
    return result


def _slope_covariance(h: Array, omega_o: Array, o_h: Array, variance: Array) -> Array:
    """Covariance (..., 2, 2) of the slopes of half-vectors under a light of small extent."""
    across = np.cross(omega_o, h)
    # Toward the light any two directions will do.
    facing = dot(across, across) <= 1e-8
    other = np.stack([np.zeros_like(o_h), h[..., 2], -h[..., 1]], axis=-1)
    across = normalize(np.where(facing[..., None], other, across))
    along = np.cross(across, h)
    slope = h[..., :2] / h[..., 2:]
    scale = 0.5 * np.sqrt(variance) / h[..., 2]
    steps = scale[..., None] * along, (scale / o_h)[..., None] * across
    moved = [step[..., :2] - slope * np.clip(step[..., 2:], -_MOST_STEP, _MOST_STEP) for step in steps]
    first, second = (one[..., :, None] * one[..., None, :] for one in moved)
    result: Array = first + second
    return result
