"""Means of `matched` samples: what a Gaussian of half-vectors reflects, where to, and how wide."""

from dataclasses import dataclass

import numpy as np

from .albedo import blend_albedo
from .arrays import Array, dot
from .lobe.base import LobeLike, grazing_reflectance, normal_reflectance, slopes
from .lobe.models import model_of
from .lobe_map import lobe_map, principal_axes
from .matched_table import Mixture, plane_of_view, window_ratio
from .weighted_lobe import lobe_moments, moment_share, reflect_slopes

# Where less than this is reflected, the sample lies below the horizon.
_SMALL = 1e-9

#: Lobes of greater slopes have means over many points.
WIDE_SLOPE = 0.35
#: Of the linear map's variance, what a sample of a wide or a long lobe has.
VARIANCE_SHARE = 0.95
#: Of a narrow round lobe it is less by (first - second/n) exp(-third mx my)/rho.
NARROW_LESS = (0.13, 0.25, 16.0)
#: Of the spread of what a sample's points reflect, what its variance is at least.
LEAST_SPREAD_SHARE = 0.5


@dataclass(frozen=True)
class Place:
    """Where a mixture lies: slopes center + y1 axis1 + y2 axis2 of half-vectors, (..., 2) each."""

    center: Array
    axis1: Array
    axis2: Array
    rho: Array  # (...), aspect of the axes once they are mirrored: a sample is s/rho wide in y1, s in y2

    @property
    def area(self) -> Array:
        """Parallelogram of the axes, axis1 x axis2."""
        area: Array = self.axis1[..., 0] * self.axis2[..., 1] - self.axis1[..., 1] * self.axis2[..., 0]
        return area


@dataclass(frozen=True)
class Means:
    """Means over each sample's Gaussian of half-vectors, local axes."""

    gains: Array  # (..., n, 3), w E[g] of each channel
    direction: Array  # (..., n, 3), unit
    variance: Array  # (..., n), per axis


def linear_place(omega_o: Array, lobe: LobeLike) -> Place:
    """Over the lobe itself along the principal axes of `lobe_map`; of other densities `weighted_place`."""
    mx, my = slopes(lobe)
    if not model_of(lobe).HAS_FIXED_HALF_VECTORS:
        return weighted_place(omega_o, lobe)
    a, b, v1, v2 = principal_axes(lobe_map(omega_o, mx, my)[0])
    axis1, axis2 = np.stack([mx * v1, my * v2], axis=-1), np.stack([-mx * v2, my * v1], axis=-1)
    return Place(np.zeros_like(axis1), axis1, axis2, a / b)


def weighted_place(omega_o: Array, lobe: LobeLike) -> Place:
    """Over what is reflected of the lobe, `moment_share` of the way there.

    With mean mu and covariance S of `lobe_moments`, both mixed with the lobe's own 0 and 1/2: R = (2 S)^1/2
    carries the lobe to where it lies. J, the derivative of the reflection at mu times R, has the principal
    axes. Of round lobes they are the plane of view and across it, whichever is longer:
    around the normal of a wide one that changes, and a step would show.
    """
    mx, my = slopes(lobe)
    model = model_of(lobe)
    if model.HAS_FIXED_HALF_VECTORS:
        moments, share = lobe_moments(omega_o, lobe), moment_share((mx, my))
        center, covariance = share * moments.mean, share * moments.covariance
    else:
        # The plane itself follows what is seen.
        share, center, covariance = 0.0, np.zeros((*omega_o.shape[:-1], 2)), np.zeros((2, 2))
    doubled = 2 * covariance + (1 - share) * np.eye(2)
    # The root of a symmetric matrix S is (S + det^1/2)/(trace + 2 det^1/2)^1/2.
    determinant = np.sqrt(np.linalg.det(doubled))[..., None, None]
    trace = np.trace(doubled, axis1=-2, axis2=-1)[..., None, None]
    root = (doubled + determinant * np.eye(2)) / np.sqrt(trace + 2 * determinant)
    roughness = np.array([mx, my])
    center, columns = (
        center * roughness,
        np.broadcast_to(root * roughness[:, None], (*omega_o.shape[:-1], 2, 2)),
    )
    mirrored = model.linear_map(omega_o, lobe, center, columns)
    if mx == my:
        v1, v2 = np.moveaxis(plane_of_view(omega_o), -1, 0)
        along, across = (
            np.linalg.norm(np.einsum("...ij,...j->...i", mirrored, v), axis=-1)
            for v in (np.stack([v1, v2], axis=-1), np.stack([-v2, v1], axis=-1))
        )
        rho = np.maximum(along / across, 1.0)
    else:
        a, b, v1, v2 = principal_axes(mirrored)
        rho = a / b
    axis1 = columns[..., 0] * v1[..., None] + columns[..., 1] * v2[..., None]
    axis2 = columns[..., 1] * v1[..., None] - columns[..., 0] * v2[..., None]
    return Place(center, axis1, axis2, rho)


def _slopes_at(place: Place, y1: Array, y2: Array) -> Array:
    """Slopes (..., n, 2) or (..., n, points, 2) at places in the mixture."""
    center, axis1, axis2 = (
        v.reshape(*v.shape[:-1], *(1,) * (y1.ndim - v.ndim + 1), 2)
        for v in (place.center, place.axis1, place.axis2)
    )
    return center + y1[..., None] * axis1 + y2[..., None] * axis2


def _spread_over(mixture: Mixture, place: Place, points: Array) -> tuple[Array, Array]:
    """Places y1 and y2, (..., n, k), of points (k, 2) in deviations of each sample."""
    y1 = mixture.y1[..., None] + (mixture.s / place.rho[..., None])[..., None] * points[:, 0]
    y2 = mixture.y2[..., None] + mixture.s[..., None] * points[:, 1]
    return y1, y2


@dataclass(frozen=True)
class _Pair:
    """The points one deviation to either side of a sample's centre along h, the direction of half-vectors in
    which cos_i changes most for the covariance s^2 (axis1 axis1^T/rho^2 + axis2 axis2^T).
    """

    slope: Array  # (..., n, 2, 2)
    p: Array  # (..., 1, 2), one deviation of s = 1 across h, o.p = 0


def _pair(omega_o: Array, mixture: Mixture, place: Place) -> _Pair:
    tangential, narrow = omega_o[..., :2], place.axis1 / place.rho[..., None]
    change = np.stack([dot(tangential, narrow), dot(tangential, place.axis2)], axis=-1)
    steepness = np.linalg.norm(change, axis=-1, keepdims=True)
    u = np.where(steepness > 1e-7, change / np.where(steepness > 1e-7, steepness, 1.0), [0.0, 1.0])
    h = u[..., :1] * narrow + u[..., 1:] * place.axis2
    p = -u[..., 1:] * narrow + u[..., :1] * place.axis2
    center = _slopes_at(place, mixture.y1, mixture.y2)
    offset = mixture.s[..., None] * h[..., None, :]
    return _Pair(np.stack([center + offset, center - offset], axis=-2), p[..., None, :])


def variance_share(lobe: LobeLike, samples: int, rho: Array) -> Array:
    """Of the linear map's variance, what a sample has (...).

    A lookup between two levels is wider than its variance says, which is that of a level between them; a
    narrow round lobe, whose picture is sharp, shows it. Among few samples other errors hide it.
    """
    mx, my = slopes(lobe)
    most, of_one, decay = NARROW_LESS
    share: Array = VARIANCE_SHARE * (1 - (most - of_one / samples) * np.exp(-decay * mx * my) / rho)
    return share


def _means(
    omega_o: Array,
    lobe: LobeLike,
    mixture: Mixture,
    place: Place,
    points: Array,
    shares: Array,
    bend: Array,
) -> Means:
    """Means over points of slopes (..., n, k, 2) with shares (..., n, k).

    The variance per axis is `variance_share` of the linear map's, s^2 |axis1 x axis2|/rho times the model's
    stretch between the pair. Where a sample's centre reflects the horizon, that is next to nothing: half of
    the spread of what its points reflect, 1 - |M|/G, is the least.
    """
    light = reflect_slopes(omega_o[..., None, None, :], lobe, points, bend)
    parts = [np.sum(shares * part, axis=-1) for part in (light.base, light.base * light.schlick)]
    gains = blend_albedo(np.stack(parts, axis=-1), normal_reflectance(lobe), grazing_reflectance(lobe))
    gain = np.sum(shares * light.grey, axis=-1)
    mean = np.sum((shares * light.grey)[..., None] * light.omega_i, axis=-2)
    # Where nothing is reflected, the mirror direction.
    seen = gain > _SMALL
    length = np.where(seen, np.linalg.norm(mean, axis=-1), 1.0)
    mirror = omega_o[..., None, :] * [-1.0, -1.0, 1.0]
    direction = np.where(seen[..., None], mean / length[..., None], mirror)

    pair = _pair(omega_o, mixture, place)
    stretch = model_of(lobe).stretch(
        omega_o[..., None, :], lobe, pair.slope[..., 0, :], pair.slope[..., 1, :]
    )
    linear = mixture.s**2 * (np.abs(place.area) / place.rho)[..., None] * stretch
    spread = np.where(seen, np.maximum(1 - length / np.where(seen, gain, 1.0), 0.0), 0.0)
    # The map is far from linear where it makes more than the sphere holds.
    share = variance_share(lobe, mixture.w.shape[-1], place.rho)[..., None]
    variance = np.clip(np.maximum(share * linear, LEAST_SPREAD_SHARE * spread), 1e-20, 1.0)
    return Means(mixture.w[..., None] * gains, direction, variance)


def mean_points(*, is_wide: bool) -> tuple[Array, Array]:
    """Points (k, 2) of a mean, in deviations of a sample, and their shares.

    They are a hexagonal grid, with the normal density there for shares. Seven are exact to the fifth degree;
    wide lobes have 37: each that the horizon passes from one view to the next would be a step.
    """
    step, reach = (0.95, 2.9) if is_wide else (np.sqrt(2 * np.log(6)), np.sqrt(2 * np.log(6)))
    i, j = np.meshgrid(np.arange(-6, 7), np.arange(-6, 7))
    grid = step * np.stack([i + 0.5 * j, np.sqrt(0.75) * j], axis=-1).reshape(-1, 2)
    grid = grid[dot(grid, grid) <= reach**2 + 1e-9]
    share = np.exp(-0.5 * dot(grid, grid))
    share /= np.sum(share)
    return grid / np.sqrt(share @ grid[:, 0] ** 2), share


def view_means(omega_o: Array, lobe: LobeLike, mixture: Mixture, place: Place) -> Means:
    """Weight and direction of each sample from points over it.

    With g = F cos_i^(1-alpha) cos_o^-alpha/cos_h times the lobe's density over the mixture's, 0 below the
    horizon, G = E[g] and M = E[g omega_i]: the direction is M/|M| with F over all channels, the weight G for
    each channel. In units y of the mixture's axes and p of roughness the densities' ratio is
    |dp/dy| exp(|y|^2 - |p|^2) of a Gaussian, else `window_ratio`.

    Parameters
    ----------
    omega_o : (..., 3)
        Local views.
    """
    mx, my = slopes(lobe)
    grid, shares = mean_points(is_wide=max(mx, my) > WIDE_SLOPE)
    y1, y2 = _spread_over(mixture, place, grid)
    points = _slopes_at(place, y1, y2)
    p = points / [mx, my]
    if model_of(lobe).DENSITY == "gaussian":
        ratio = (place.area / (mx * my))[..., None, None] * np.exp(y1**2 + y2**2 - dot(p, p))
    else:
        ratio = window_ratio(max(mx, my), y1**2 + y2**2)
    return _means(omega_o, lobe, mixture, place, points, shares * ratio, np.ones(1))


def corner_means(omega_o: Array, lobe: LobeLike, mixture: Mixture, place: Place) -> Means:
    """Weight and direction of each sample of a wide lobe from its centre and four corners at sqrt(1.2)
    deviations: exact to the third degree.
    """
    corners = np.sqrt(1.2) * np.array([[0, 0], [1, 1], [1, -1], [-1, 1], [-1, -1]])
    y1, y2 = _spread_over(mixture, place, corners)
    shares = np.array([4, 5, 5, 5, 5]) / 24
    if model_of(lobe).DENSITY != "gaussian":
        shares = shares * window_ratio(max(slopes(lobe)), y1**2 + y2**2)
    return _means(omega_o, lobe, mixture, place, _slopes_at(place, y1, y2), shares, np.ones(1))


def two_point_means(omega_o: Array, lobe: LobeLike, mixture: Mixture, place: Place) -> Means:
    """Weight and direction of each sample of a narrow lobe from two points, one deviation to either side.

    Exact to second order in the product of weight and direction along h. Across it, along p, the reflection
    bends: on average q = 2 (o.g)/|g|^2 is shorter there by s^2 |p|^2.
    """
    pair = _pair(omega_o, mixture, place)
    bend = 1 - mixture.s**2 * dot(pair.p, pair.p)
    return _means(omega_o, lobe, mixture, place, pair.slope, np.full(2, 0.5), bend[..., None])
