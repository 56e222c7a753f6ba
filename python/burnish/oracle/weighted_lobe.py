"""Where a lobe lies once it is weighed by what it reflects: mean and covariance of its half-vectors.

Slopes of half-vectors are in units of roughness here, p = (hx/(mx hz), hy/(my hz)): the lobe's density is
exp(-|p|^2)/pi. At grazing views the horizon cuts it, and the Fresnel factor pulls it toward the horizon.
Lobes of other densities lie in a plane of what the eye sees, and their mixtures in its middle.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot
from .lobe.base import LobeLike, grazing_reflectance, normal_reflectance, slopes
from .lobe.kurt import KurtLobe
from .lobe.models import model_of
from .matched_table import half_square, plane_of_view, view_at

# Reflectance along the normal below which directions are no longer weighed by it.
_LEAST_SPECULAR = 1e-3
#: Moments are sums over a square of slopes, 25 by 25.
SUM_STEP, SUM_REACH = 0.25, 3.0
#: Views from the normal to the horizon that moments are made for; others are interpolated.
MOMENT_NODES = 32
# Place of the views on the square, close to the normal, between which the mean is a drift.
_DRIFT_RADIUS = 0.125
#: How far mixtures of narrow lobes follow the moments.
MOMENT_SHARE = 0.8


def grey_specular(lobe: LobeLike) -> float:
    """Reflectance along the normal over all channels, weighed as they are seen: mean(w r0)/mean(w f90)."""
    weight, r0 = np.broadcast_to(as_array(lobe.weight), 3), normal_reflectance(lobe)
    grazing = np.mean(weight * grazing_reflectance(lobe))
    if grazing <= 0:
        return 1.0
    return float(np.clip(np.mean(weight * r0) / grazing, _LEAST_SPECULAR, 1.0))


def moment_share(roughness: tuple[float, float]) -> float:
    """How far mixtures follow the moments: all the way they would leave a lobe's tails to too few samples.

    Of wide lobes, whose moments change most with the view, it is less.
    """
    return MOMENT_SHARE * math.exp(-roughness[0] * roughness[1])


@dataclass(frozen=True)
class Weighed:
    """What places of a lobe reflect; omega_i (..., 3), the others (...)."""

    omega_i: Array
    base: Array  # without Fresnel, see `Reflected`
    schlick: Array  # (1 - o.h)^5
    grey: Array  # F base, F over all channels


def reflect_slopes(omega_o: Array, lobe: LobeLike, slope: Array, bend: Array | float = 1.0) -> Weighed:
    """Mirror local views (..., 3) at places of the lobe, as its model does, and weigh them by Fresnel."""
    light = model_of(lobe).reflect(omega_o, lobe, slope, bend)
    specular = grey_specular(lobe)
    grey = light.base * (specular + (1 - specular) * light.schlick)
    return Weighed(light.omega_i, light.base, light.schlick, grey)


@dataclass(frozen=True)
class Moments:
    """Of p: mean (..., 2) and covariance (..., 2, 2)."""

    mean: Array
    covariance: Array


def sum_moments(omega_o: Array, lobe: LobeLike) -> Moments:
    """Moments at local views (n, 3), by sums."""
    line = np.arange(-SUM_REACH, SUM_REACH + 1e-9, SUM_STEP)
    p = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    value = reflect_slopes(omega_o[:, None], lobe, p * slopes(lobe)).grey * np.exp(-dot(p, p))
    share = value / np.sum(value, axis=-1, keepdims=True)
    mean = share @ p
    second = np.einsum("nk,ki,kj->nij", share, p, p)
    return Moments(mean, second - mean[:, :, None] * mean[:, None, :])


@lru_cache(maxsize=64)
def _drift(roughness: tuple[float, float], alpha: float, specular: float) -> Array:
    lobe = KurtLobe(roughness, specular, alpha)
    views = view_at(_DRIFT_RADIUS * np.eye(2))
    mean = np.diag(sum_moments(views, lobe).mean) / np.diag(views[:, :2])
    if roughness[0] == roughness[1]:
        mean = np.repeat(mean[:1], 2)
    return as_array((moment_share(roughness) * np.array(roughness) * mean).astype(np.float16))


def lobe_drift(lobe: Any) -> Array:
    """What the middle of a mixture moves by, a slope (2,), for a unit of o_x and o_y around the normal."""
    mx, my = slopes(lobe)
    if model_of(lobe).HAS_FIXED_HALF_VECTORS:
        return _drift((mx, my), float(lobe.alpha), grey_specular(lobe))
    views = view_at(_DRIFT_RADIUS * np.eye(2))
    half = views + model_of(lobe).reflect(views, lobe, np.zeros((2, 2))).omega_i
    drift = np.diag(half[:, :2] / half[:, 2:]) / np.diag(views[:, :2])
    return as_array(np.repeat(drift[:1], 2) if mx == my else drift).astype(np.float16).astype(np.float64)


@lru_cache(maxsize=64)
def _node_moments(roughness: tuple[float, float], alpha: float, specular: float) -> Moments:
    """Moments at the nodes: (MOMENT_NODES, ...) of round lobes, (lines, columns, ...) of brushed ones."""
    lobe = KurtLobe(roughness, specular, alpha)
    last = MOMENT_NODES - 1
    if roughness[0] == roughness[1]:
        square = np.stack([np.arange(last + 1) / last, np.zeros(last + 1)], axis=-1)
    else:
        x, y = np.arange(-last, last + 1) / last, np.arange(last + 1) / last
        square = np.stack(np.meshgrid(x, y), axis=-1)
    flat = sum_moments(view_at(square.reshape(-1, 2)), lobe)
    return Moments(
        flat.mean.reshape(*square.shape[:-1], 2), flat.covariance.reshape(*square.shape[:-1], 2, 2)
    )


def _interpolate(values: Array, at: Array) -> Array:
    """Interpolate linearly between nodes along the first axes, as many as `at` (..., k) has numbers."""
    dimensions = at.shape[-1]
    low = np.minimum(at.astype(np.int64), np.array(values.shape[:dimensions]) - 2)
    result = np.zeros((*at.shape[:-1], *values.shape[dimensions:]))
    for corner in np.ndindex(*(2,) * dimensions):
        share = np.prod(np.where(corner, at - low, 1 - (at - low)), axis=-1)
        node = values[tuple(np.moveaxis(low + corner, -1, 0))]
        result += share.reshape(*share.shape, *(1,) * (node.ndim - share.ndim)) * node
    return result


def lobe_moments(omega_o: npt.ArrayLike, lobe: Any) -> Moments:
    """Moments at local views (..., 3) of a lobe of Gaussian density, between those of the nodes."""
    omega_o = as_array(omega_o)
    mx, my = slopes(lobe)
    nodes = _node_moments((mx, my), float(lobe.alpha), grey_specular(lobe))
    last = MOMENT_NODES - 1
    square, side = half_square(omega_o)
    if mx != my:
        at = np.stack([square[..., 1] * last, (square[..., 0] + 1) * last], axis=-1)
        return Moments(side * _interpolate(nodes.mean, at), _interpolate(nodes.covariance, at))
    # Those of round lobes are along the plane of view.
    at = np.max(np.abs(square), axis=-1, keepdims=True) * last
    e = plane_of_view(omega_o)
    turn = np.stack([e, np.stack([-e[..., 1], e[..., 0]], axis=-1)], axis=-1)
    mean = np.einsum("...ij,...j->...i", turn, _interpolate(nodes.mean, at))
    return Moments(mean, turn @ _interpolate(nodes.covariance, at) @ np.swapaxes(turn, -1, -2))
