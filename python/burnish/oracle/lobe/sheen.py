"""Charlie sheen of KHR_materials_sheen (Estevez and Kulla 2017): the glow of cloth toward grazing.

Its plane is that of the cosine about the normal: K = exp(-|x|^2)/pi is carried to cos/pi by cos =
exp(-r^2/2), and all of the lobe is in the weight pi f.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Array, as_array, dot, normalize, remembered
from .base import MIN_COS_O, Reflected, Values, slopes

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
#: Divided by its albedo where that exceeds 1.
ALWAYS_CONSERVES = True
#: Least alpha, and the least cosine of light that it is divided by.
MIN_ALPHA, MIN_COS_I = 1e-3, 1e-3
# Nodes of albedos along the cosine and around half of the hemisphere.
_HEIGHTS, _AZIMUTHS = 128, 128


@dataclass(frozen=True)
class SheenLobe:
    """f = weight D V."""

    roughness: float = 0.3  # perceptual
    weight: Any = 1.0


def sheen_alpha(lobe: Any) -> float:
    """Roughness squared, at least .001."""
    return max(float(lobe.roughness) ** 2, MIN_ALPHA)


def _curve(x: Array, alpha: float) -> Array:
    t = (1 - alpha) ** 2
    first = np.array([21.5473, 3.82987, 0.19823, -1.97760, -4.32054])
    second = np.array([25.3245, 3.32435, 0.16801, -1.27393, -4.85967])
    a, b, c, d, e = first * (1 - t) + second * t
    result: Array = a / (1 + b * x**c) + d * x + e
    return result


def sheen_lambda(cosine: Array, alpha: float) -> Array:
    """L of V = 1/((1 + L(co) + L(ci)) 4 co ci): exp of a fitted curve, point-symmetric about cos = 1/2."""
    half = _curve(np.array(0.5), alpha)
    near, far = _curve(cosine, alpha), 2 * half - _curve(1 - cosine, alpha)
    result: Array = np.exp(np.where(cosine < 0.5, near, far))
    return result


def _value(omega_i: Array, omega_o: Array, lobe: Any) -> Array:
    """D V, (...), above the surface."""
    alpha = sheen_alpha(lobe)
    h = normalize(omega_i + omega_o)
    sine2 = np.maximum(h[..., 0] ** 2 + h[..., 1] ** 2, 1e-30)
    d = (2 + 1 / alpha) * np.exp(0.5 / alpha * np.log(sine2)) / (2 * np.pi)
    ci, co = np.clip(omega_i[..., 2], MIN_COS_I, 1), np.clip(omega_o[..., 2], MIN_COS_O, 1)
    result: Array = d / ((1 + sheen_lambda(co, alpha) + sheen_lambda(ci, alpha)) * 4 * co * ci)
    return result


def sheen_brdf(omega_i: Array, omega_o: Array, lobe: Any) -> Array:
    """Reflectance per steradian, (..., 3), in the local frame; 0 below the surface."""
    omega_i, omega_o = np.broadcast_arrays(as_array(omega_i), as_array(omega_o))
    seen = (omega_i[..., 2] > 0) & (omega_o[..., 2] > 0)
    up = np.array([0.0, 0.0, 1.0])
    i, o = np.where(seen[..., None], omega_i, up), np.where(seen[..., None], omega_o, up)
    return np.broadcast_to(as_array(lobe.weight), 3) * np.where(seen, _value(i, o, lobe), 0.0)[..., None]


def reflect(omega_o: Array, lobe: Any, slope: Array, bend: Array | float = 1.0) -> Reflected:
    """What places slope/width of the plane reflect: pi f; `bend` is of other lobes."""
    place = slope / np.array(slopes(lobe))
    r2 = dot(place, place)
    square = np.where(r2 > 0, -np.expm1(-r2) / np.where(r2 > 0, r2, 1.0), 1.0)
    height = np.exp(-0.5 * r2)
    omega_i = np.concatenate([np.sqrt(square)[..., None] * place, height[..., None]], axis=-1)
    omega_i, omega_o = np.broadcast_arrays(omega_i, omega_o)
    base = np.pi * _value(omega_i, omega_o, lobe)
    return Reflected(omega_i, base, np.zeros_like(base))


def linear_map(omega_o: Array, lobe: Any, slope: Array, columns: Array) -> Array:
    """Derivative of the direction at the middle of the plane, about the normal."""
    return np.broadcast_to(columns / np.array(slopes(lobe))[:, None], (*omega_o.shape[:-1], 2, 2))


def stretch(omega_o: Array, lobe: Any, one: Array, other: Array) -> Array:
    """Solid angle of directions over the area of slopes in the middle between two, (...)."""
    width, place = np.array(slopes(lobe)), 0.5 * (one + other) / np.array(slopes(lobe))
    result: Array = np.exp(-0.5 * dot(place, place)) / np.prod(width)
    return np.broadcast_to(result, np.broadcast_shapes(result.shape, omega_o.shape[:-1]))


def values(omega_i: Array, omega_o: Array, lobe: Any) -> Values:
    """F cos_i at directions (3, k) above the horizon for one view (3,)."""
    value = _value(omega_i.T, omega_o, lobe) * omega_i[2]
    return Values(np.arange(len(value)), value, np.ones(len(value)))


def under_light(omega_i: Array, omega_o: Array, lobe: Any, variance: Array) -> Array:
    """F cos_i, (...): sheen is wider than any light."""
    omega_i, omega_o = np.broadcast_arrays(omega_i, omega_o)
    above = omega_i[..., 2] > 0
    i = np.where(above[..., None], omega_i, [0.0, 0.0, 1.0])
    result: Array = np.where(above, _value(i, omega_o, lobe) * i[..., 2], 0.0)
    return result


def albedo(omega_o: Array, lobe: Any) -> Array:
    """E_1, and 0 for E_s, (..., 2): int D V ci, nodes crowding toward the horizon."""
    return _sum_albedo(omega_o, lobe.roughness)


@remembered
def _sum_albedo(omega_o: Array, roughness: Array) -> Array:
    lobe = SheenLobe(float(roughness))
    x, w = np.polynomial.legendre.leggauss(_HEIGHTS)
    share = 0.5 * (x + 1)
    height, height_weight = share**3, 1.5 * share**2 * w
    y, v = np.polynomial.legendre.leggauss(_AZIMUTHS)
    phi, phi_weight = 0.5 * np.pi * (y + 1), np.pi * v  # half of the circle stands for all of it
    sine = np.sqrt(1 - height**2)[:, None]
    omega_i = np.stack(
        np.broadcast_arrays(sine * np.cos(phi), sine * np.sin(phi), height[:, None]), axis=-1
    ).reshape(-1, 3)
    weight = np.outer(height_weight * height, phi_weight).ravel()
    flat = as_array(omega_o).reshape(-1, 3)
    cosine = np.clip(flat[:, 2], MIN_COS_O, 1)
    first = np.empty(len(flat))
    for k, co in enumerate(cosine):
        first[k] = weight @ _value(omega_i, np.array([np.sqrt(1 - co * co), 0.0, co]), lobe)
    return np.stack([first, np.zeros_like(first)], axis=-1).reshape(*np.shape(omega_o)[:-1], 2)


def lit_exponent(lobe: Any) -> float:
    """Power of cos_i in the base."""
    return 0.0
