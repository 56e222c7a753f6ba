"""Lafortune's lobe (o^T diag(c) i)^n (McAllister, Lastra and Heidrich 2002): a power lobe around p = c o.

Its plane carries K = exp(-|x|^2)/pi to the density (n + 1)/(2 pi) cos^n around p: a place at the radius r
lies at the angle of cos = exp(-r^2/(n + 1)).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Array, as_array, dot
from .base import Reflected, Values, slopes

#: Of the lobe in its plane: exp(-|x|^2)/pi.
DENSITY = "gaussian"
#: It is about directions, not half-vectors.
HAS_HALF_VECTORS = False
#: Half-vectors depend on the view.
HAS_FIXED_HALF_VECTORS = False
#: Samples are placed at every point.
HAS_VIEW_TABLES = False
#: Slope of Kurt's lobe that prefiltered maps show it by, over its width.
FILTER_SLOPE = 1.0
# Exponent beyond which a power is no float32.
_MOST_EXPONENT = 60.0
# Sines below this have no azimuth.
_SMALL = 1e-9
_NODES = 256


@dataclass(frozen=True)
class LafortuneLobe:
    """f = weight max(o^T diag(c) i, 0)^exponent."""

    c: Any = (-1.0, -1.0, 1.0)
    exponent: float = 10.0
    weight: Any = 1.0
    rotation: float = 0.0  # radians, turns the tangent counter-clockwise about the normal


def _axis(omega_o: Array, lobe: Any) -> tuple[Array, Array]:
    """p/|p| (..., 3) and |p|^n (...); 0 where p is."""
    p = omega_o * as_array(lobe.c)
    length = np.linalg.norm(p, axis=-1)
    safe = np.where(length > 1e-15, length, 1.0)
    power = np.exp(np.clip(lobe.exponent * np.log(safe), -_MOST_EXPONENT, _MOST_EXPONENT))
    axis = np.where(length[..., None] > 1e-15, p / safe[..., None], [0.0, 0.0, 1.0])
    return axis, np.where(length > 1e-15, power, 0.0)


def _axes(axis: Array) -> Array:
    """Axes of the plane across the lobe's, columns (..., 3, 2): along the normal they are the lobe's own."""
    sine = np.hypot(axis[..., 0], axis[..., 1])
    has_azimuth = sine > _SMALL
    safe = np.where(has_azimuth, sine, 1.0)
    x, y = (np.where(has_azimuth, axis[..., k] / safe, float(k == 0)) for k in (0, 1))
    along = np.stack([axis[..., 2] * x, axis[..., 2] * y, -sine], axis=-1)
    across = np.stack([-y, x, np.zeros_like(x)], axis=-1)
    first = x[..., None] * along - y[..., None] * across
    return np.stack([first, y[..., None] * along + x[..., None] * across], axis=-1)


def lafortune_brdf(omega_i: Array, omega_o: Array, lobe: Any) -> Array:
    """Reflectance per steradian, (..., 3), in the lobe's own frame; 0 below the surface."""
    omega_i, omega_o = np.broadcast_arrays(as_array(omega_i), as_array(omega_o))
    product = dot(omega_i * as_array(lobe.c), omega_o)
    seen = (omega_i[..., 2] > 0) & (omega_o[..., 2] > 0) & (product > 0)
    value = np.where(seen, np.where(seen, product, 1.0) ** lobe.exponent, 0.0)
    return np.broadcast_to(as_array(lobe.weight), 3) * value[..., None]


def reflect(omega_o: Array, lobe: Any, slope: Array, bend: Array | float = 1.0) -> Reflected:
    """What places slope/width of the plane reflect: |p|^n 2 pi/(n + 1) cos_i; `bend` is of other lobes."""
    axis, gain = _axis(omega_o, lobe)
    place = slope / np.array(slopes(lobe))
    r2 = dot(place, place)
    angle = r2 / (lobe.exponent + 1)
    with np.errstate(invalid="ignore"):
        square = np.where(r2 > 0, -np.expm1(-2 * angle) / np.where(r2 > 0, r2, 1.0), 2 / (lobe.exponent + 1))
    tangential = np.einsum("...ij,...j->...i", _axes(axis), place)
    omega_i = np.exp(-angle)[..., None] * axis + np.sqrt(square)[..., None] * tangential
    base = gain * 2 * np.pi / (lobe.exponent + 1) * np.maximum(omega_i[..., 2], 0)
    return Reflected(omega_i, base, np.zeros_like(base))


def linear_map(omega_o: Array, lobe: Any, slope: Array, columns: Array) -> Array:
    """Derivative of the direction at the middle of the plane: (2/(n + 1))^1/2 along its axes."""
    scale = np.sqrt(2 / (lobe.exponent + 1))
    result: Array = scale * (columns / np.array(slopes(lobe))[:, None])
    return np.broadcast_to(result, (*omega_o.shape[:-1], 2, 2))


def stretch(omega_o: Array, lobe: Any, one: Array, other: Array) -> Array:
    """Solid angle of directions over the area of slopes in the middle between two, (...)."""
    width, place = np.array(slopes(lobe)), 0.5 * (one + other) / np.array(slopes(lobe))
    cosine = np.exp(-dot(place, place) / (lobe.exponent + 1))
    result: Array = 2 / (lobe.exponent + 1) * cosine / np.prod(width)
    return result


def values(omega_i: Array, omega_o: Array, lobe: Any) -> Values:
    """F cos_i at directions (3, k) above the horizon for one view (3,)."""
    plain = LafortuneLobe(lobe.c, lobe.exponent)
    value = lafortune_brdf(omega_i.T, omega_o, plain)[:, 0] * omega_i[2]
    return Values(np.arange(len(value)), value, np.ones(len(value)))


def under_light(omega_i: Array, omega_o: Array, lobe: Any, variance: Array) -> Array:
    """F cos_i, (...), under a light whose directions have a variance per axis.

    A lobe's is 1/(n + 1); the sum is that of a lobe of a smaller n, which shines as much.
    """
    axis, gain = _axis(omega_o, lobe)
    n = np.maximum(1 / (1 / (lobe.exponent + 1) + variance) - 1, 0)
    cosine = dot(axis, omega_i)
    power = np.where(cosine > 0, np.where(cosine > 0, cosine, 1.0) ** n, 0.0)
    result: Array = gain * (n + 1) / (lobe.exponent + 1) * power * np.maximum(omega_i[..., 2], 0)
    return result


def albedo(omega_o: Array, lobe: Any) -> Array:
    """E_1, and 0 for E_s, (..., 2): |p|^n 2 pi/(n + 1) H, H the mean of (N.i)+ over the lobe.

    On a circle at the angle theta around the axis N.i = a + b cos phi, a = c cos theta, b = s sin theta: its
    positive part has the mean (a e + b sin e)/pi, e = acos(-a/b). cos^(n + 1) is uniform in 0..1.
    """
    axis, gain = _axis(as_array(omega_o), lobe)
    x, w = np.polynomial.legendre.leggauss(_NODES)
    cosine = (0.5 * (x + 1)) ** (1 / (lobe.exponent + 1))
    c = np.clip(axis[..., 2], -1, 1)[..., None]
    middle, reach = c * cosine, np.sqrt(1 - c**2) * np.sqrt(1 - cosine**2)
    end = np.arccos(np.clip(-middle / np.maximum(reach, 1e-300), -1, 1))
    mean = (middle * end + reach * np.sin(end)) / np.pi
    first = gain * 2 * np.pi / (lobe.exponent + 1) * (np.maximum(mean, 0) @ (0.5 * w))
    return np.stack([first, np.zeros_like(first)], axis=-1)


def lit_exponent(lobe: Any) -> float:
    """Power of cos_i in the base."""
    return 1.0
