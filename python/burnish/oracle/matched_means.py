"""Means of `matched` samples: what a Gaussian of half-vectors reflects, where to, and how wide."""

from dataclasses import dataclass

import numpy as np

from .albedo import blend_albedo
from .arrays import Array, as_array, dot
from .kurt_lobe import LobeLike, grazing_factor, schlick_fresnel, slopes
from .matched_table import Mixture

# Where less than this is reflected, the sample lies below the horizon.
_SMALL = 1e-9
# Reflectance along the normal below which directions are no longer weighed by it.
_LEAST_SPECULAR = 1e-3

_CORNER = np.sqrt(1.2)
#: Points of a mean, in units of the width of a sample, and their weights: exact to the third degree. At a
#: distance of sqrt(2.4) they give wide lobes and dielectrics less error than other rules of up to nine.
CORNER_POINTS = _CORNER * np.array([[0, 0], [1, 1], [1, -1], [-1, 1], [-1, -1]])
CORNER_WEIGHTS = np.array([4, 5, 5, 5, 5]) / 24
#: Of the linear map's variance, what a sample has.
VARIANCE_SHARE = 0.95

Axes = tuple[Array, Array, Array, Array]


@dataclass(frozen=True)
class Means:
    """Means over each sample's Gaussian of half-vectors, local axes."""

    gains: Array  # (..., n, 3), w E[g] of each channel
    direction: Array  # (..., n, 3), unit
    variance: Array  # (..., n), per axis


def grey_specular(lobe: LobeLike) -> float:
    """Reflectance along the normal over all channels, weighed as they are seen: mean(w r0)/mean(w)."""
    weight, r0 = np.broadcast_to(as_array(lobe.weight), 3), np.broadcast_to(as_array(lobe.r0), 3)
    if np.mean(weight) <= 0:
        return 1.0
    return float(np.clip(np.mean(weight * r0) / np.mean(weight), _LEAST_SPECULAR, 1.0))


def _unit_axes(lobe: LobeLike, axes: Axes) -> tuple[Array, Array]:
    """Slopes of the lobe's two axes on the sphere, (..., 1, 2) each."""
    mx, my = slopes(lobe)
    v1, v2 = axes[2][..., None], axes[3][..., None]
    return np.stack([mx * v1, my * v2], axis=-1), np.stack([-mx * v2, my * v1], axis=-1)


def _sum_points(omega_o: Array, lobe: LobeLike, g: Array, shares: Array, bend: Array) -> tuple[Array, ...]:
    """Sums over points g = (slope, 1), (..., n, points, 3): gains (..., n, 3), E[F g] and E[F g omega_i].

    A point mirrors the view to q g - o, q = 2 (o.g)/|g|^2 bend, and weighs
    F cos_i^(1-alpha) cos_o^-alpha |g|.
    """
    o = omega_o[..., None, None, :]
    length2 = dot(g, g)
    product = dot(o, g)
    omega_i = (2 * product / length2 * bend)[..., None] * g - o
    grazing = grazing_factor(np.where(product > 0, omega_i[..., 2], 0.0), o[..., 2], lobe.alpha)
    value = shares * np.sqrt(length2) * grazing
    o_h = product / np.sqrt(length2)
    r0 = np.broadcast_to(as_array(lobe.r0), 3)
    sums = [np.sum(value, axis=-1), np.sum(value * schlick_fresnel(o_h, 0.0), axis=-1)]
    grey = value * schlick_fresnel(o_h, grey_specular(lobe))
    return (
        blend_albedo(np.stack(sums, axis=-1), r0),
        np.sum(grey, axis=-1),
        np.sum(grey[..., None] * omega_i, axis=-2),
    )


def _mean_direction(omega_o: Array, gain: Array, mean: Array) -> Array:
    """Unit mean directions; where nothing is reflected the mirror direction."""
    seen = gain > _SMALL
    length = np.where(seen, np.linalg.norm(mean, axis=-1), 1.0)
    mirror = omega_o[..., None, :] * [-1.0, -1.0, 1.0]
    direction: Array = np.where(seen[..., None], mean / length[..., None], mirror)
    return direction


@dataclass(frozen=True)
class _Pair:
    """The points one deviation to either side of a sample's centre along h, the direction of half-vectors in
    which cos_i changes most for the covariance s^2 (along along^T/rho^2 + across across^T).
    """

    g: Array  # (..., n, 2, 3), 1 along the normal
    center: Array  # (..., n, 2), slope
    p: Array  # (..., 1, 2), one deviation of s = 1 across h, o.p = 0


def _pair(omega_o: Array, lobe: LobeLike, mixture: Mixture, axes: Axes) -> _Pair:
    a, b = axes[0][..., None], axes[1][..., None]
    along, across = _unit_axes(lobe, axes)
    tangential = omega_o[..., None, :2]
    change = np.stack([dot(tangential, along) * b / a, dot(tangential, across)], axis=-1)
    steepness = np.linalg.norm(change, axis=-1, keepdims=True)
    u = np.where(steepness > 1e-7, change / np.where(steepness > 1e-7, steepness, 1.0), [0.0, 1.0])
    h = u[..., :1] * (b / a)[..., None] * along + u[..., 1:] * across
    p = -u[..., 1:] * (b / a)[..., None] * along + u[..., :1] * across
    center = mixture.y1[..., None] * along + mixture.y2[..., None] * across
    offset = mixture.s[..., None] * h
    slope = np.stack([center + offset, center - offset], axis=-2)
    return _Pair(np.concatenate([slope, np.ones((*slope.shape[:-1], 1))], axis=-1), center, p)


def _variance(omega_o: Array, mixture: Mixture, axes: Axes, stretch: Array, pair: _Pair) -> Array:
    """Per axis: .95 of the linear map's, (s b)^2 (o.h) cos_h^3/c with |g|^4 the product of the pair's."""
    product = np.maximum(dot(omega_o[..., None, :2], pair.center) + omega_o[..., None, 2], 0)
    lengths = np.prod(dot(pair.g, pair.g), axis=-1)
    linear = (mixture.s * axes[1][..., None]) ** 2 * product / lengths / stretch[..., None]
    variance: Array = np.maximum(VARIANCE_SHARE * linear, 1e-20)
    return variance


def corner_means(omega_o: Array, lobe: LobeLike, mixture: Mixture, axes: Axes, stretch: Array) -> Means:
    """Weight and direction of each sample from its centre and four corners.

    With g = F cos_i^(1-alpha) cos_o^-alpha/cos_h, 0 below the horizon, G = E[g] and M = E[g omega_i]: the
    direction is M/|M| with F over all channels, the weight G for each channel. The spread of the points'
    directions, -ln(|M|/G), is no better a variance than the linear map's: it errs 5 to 25 % more.

    Parameters
    ----------
    omega_o : (..., 3)
        Local views.
    axes : (a, b, v1, v2), (...) each
        From `principal_axes`.
    stretch : (...)
        From `lobe_map`.
    """
    a, b = axes[0][..., None], axes[1][..., None]
    along, across = _unit_axes(lobe, axes)
    y1 = mixture.y1[..., None] + (mixture.s * b / a)[..., None] * CORNER_POINTS[:, 0]
    y2 = mixture.y2[..., None] + mixture.s[..., None] * CORNER_POINTS[:, 1]
    slope = y1[..., None] * along[..., None, :] + y2[..., None] * across[..., None, :]
    g = np.concatenate([slope, np.ones((*slope.shape[:-1], 1))], axis=-1)
    gains, gain, mean = _sum_points(omega_o, lobe, g, CORNER_WEIGHTS, np.ones(1))
    variance = _variance(omega_o, mixture, axes, stretch, _pair(omega_o, lobe, mixture, axes))
    # The map is far from linear where it makes more than the sphere holds.
    variance = np.minimum(variance, 1.0)
    return Means(mixture.w[..., None] * gains, _mean_direction(omega_o, gain, mean), variance)


def two_point_means(omega_o: Array, lobe: LobeLike, mixture: Mixture, axes: Axes, stretch: Array) -> Means:
    """Weight and direction of each sample of a narrow lobe from two points, one deviation to either side.

    Exact to second order in the product of weight and direction along h. Across it, along p, the reflection
    bends: on average q = 2 (o.g)/|g|^2 is shorter there by s^2 |p|^2.

    Parameters
    ----------
    omega_o, axes, stretch
        As of `corner_means`.
    """
    pair = _pair(omega_o, lobe, mixture, axes)
    bend = 1 - mixture.s**2 * dot(pair.p, pair.p)
    gains, gain, mean = _sum_points(omega_o, lobe, pair.g, np.ones(2), bend[..., None])
    variance = _variance(omega_o, mixture, axes, stretch, pair)
    return Means(mixture.w[..., None] * gains, _mean_direction(omega_o, gain, mean), variance)
