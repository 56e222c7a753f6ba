"""The glossy lobe of Kurt et al. 2010: density, reflectance, sampling."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..albedo import directional_albedo
from ..arrays import Array, as_array, dot, normalize
from ..lobe_map import reflection_map
from .base import MIN_COS_O, MIN_X1, Reflected, Values, quadratic_form, schlick_fresnel, slopes

#: Of the lobe in the plane of slopes: exp(-|p|^2)/pi, p in units of roughness.
DENSITY = "gaussian"
#: Half-vectors say all of it: they have a density D.
HAS_HALF_VECTORS = True
#: Half-vectors are the same for every view.
HAS_FIXED_HALF_VECTORS = True
#: Samples are placed once for every view.
HAS_VIEW_TABLES = True
#: Slope of the lobe that prefiltered levels show it by, over its own.
FILTER_SLOPE = 1.0
# Past this exponent q is 0 for every purpose, and exp would leave float64's normal range.
_MAX_EXPONENT = 700.0
# Below this cosine cos_h^4 leaves float32's range; q is 0 long before.
_MIN_COS_H = 1e-11


@dataclass(frozen=True)
class KurtLobe:
    """f = weight F(u) D / (4 (o.h) ((i.n)(o.n))^alpha)."""

    roughness: Any = 0.2  # slope, or slopes along tangent and bitangent
    r0: Any = 1.0
    alpha: float = 0.0
    weight: Any = 1.0
    rotation: float = 0.0  # radians, turns the tangent counter-clockwise about the normal
    conserve_energy: bool = False  # divide by the albedo of r0 = 1 where that exceeds 1


def kurt_exponent(h: npt.ArrayLike, mx: npt.ArrayLike, my: npt.ArrayLike) -> Array:
    """Return ((hx/mx)^2 + (hy/my)^2)/hz^2, the exponent of q; at most 700, which it is below the horizon."""
    x, y, z = np.moveaxis(as_array(h), -1, 0)
    above = z > _MIN_COS_H
    safe = np.where(above, z, 1.0)
    exponent = (x / safe / as_array(mx)) ** 2 + (y / safe / as_array(my)) ** 2
    return np.where(above, np.minimum(exponent, _MAX_EXPONENT), _MAX_EXPONENT)


def kurt_q(h: npt.ArrayLike, mx: npt.ArrayLike, my: npt.ArrayLike) -> Array:
    """Return q = exp(-((hx/mx)^2 + (hy/my)^2)/hz^2), what the pattern's threshold is compared with."""
    exponent = kurt_exponent(h, mx, my)
    return np.where(exponent < _MAX_EXPONENT, np.exp(-exponent), 0.0)


def kurt_d(h: npt.ArrayLike, mx: npt.ArrayLike, my: npt.ArrayLike) -> Array:
    """Return D = q/(pi mx my cos_h^4), per steradian; D cos_h integrates to 1 over the hemisphere."""
    cos_h = np.maximum(as_array(h)[..., 2], _MIN_COS_H)
    density: Array = kurt_q(h, mx, my) / (np.pi * as_array(mx) * as_array(my) * cos_h**4)
    return density


def grazing_factor(cos_i: npt.ArrayLike, cos_o: npt.ArrayLike, alpha: float) -> Array:
    """Return cos_i/(cos_i cos_o)^alpha = cos_i^(1-alpha) cos_o^-alpha; 0 for cos_i <= 0, cos_o >= 1e-4."""
    cos_i = as_array(cos_i)
    above = cos_i > 0
    power = np.where(above, np.where(above, cos_i, 1.0) ** (1 - alpha), 0.0)
    result: Array = power * np.maximum(as_array(cos_o), MIN_COS_O) ** -alpha
    return result


def kurt_brdf(omega_i: npt.ArrayLike, omega_o: npt.ArrayLike, lobe: Any) -> Array:
    """Return the reflectance per steradian, (..., 3), in the lobe's own frame (its rotation already applied).

    0 where light or eye are below the surface.
    """
    omega_i, omega_o = np.broadcast_arrays(as_array(omega_i), as_array(omega_o))
    cos_i, cos_o = omega_i[..., 2], omega_o[..., 2]
    seen = (cos_i > 0) & (cos_o > 0)
    h = normalize(np.where(seen[..., None], omega_i + omega_o, [0.0, 0.0, 1.0]))
    u = np.where(seen, dot(omega_o, h), 1.0)
    denominator = 4 * u * (np.where(seen, cos_i, 1.0) * np.maximum(cos_o, MIN_COS_O)) ** lobe.alpha
    value = np.where(seen, kurt_d(h, *slopes(lobe)) / denominator, 0.0)
    fresnel = schlick_fresnel(u[..., None], np.broadcast_to(as_array(lobe.r0), 3))
    return as_array(lobe.weight) * fresnel * value[..., None]


def kurt_sample(x1: npt.ArrayLike, x2: npt.ArrayLike, mx: npt.ArrayLike, my: npt.ArrayLike) -> Array:
    """Half-vectors of density D cos_h: slopes sqrt(-ln x1) (mx cos 2 pi x2, my sin 2 pi x2), x in [0, 1)."""
    x1, x2, mx, my = np.broadcast_arrays(as_array(x1), as_array(x2), as_array(mx), as_array(my))
    radius = np.sqrt(-np.log(np.maximum(x1, MIN_X1)))
    azimuth = 2 * np.pi * x2
    slope_x, slope_y = mx * radius * np.cos(azimuth), my * radius * np.sin(azimuth)
    return normalize(np.stack([slope_x, slope_y, np.ones_like(x1)], axis=-1))


def kurt_pdf(h: npt.ArrayLike, mx: npt.ArrayLike, my: npt.ArrayLike) -> Array:
    """Density of `kurt_sample` per steradian of half-vectors: D cos_h."""
    return kurt_d(h, mx, my) * np.maximum(as_array(h)[..., 2], 0)


def kurt_pdf_omega_i(h: npt.ArrayLike, omega_o: npt.ArrayLike, mx: npt.ArrayLike, my: npt.ArrayLike) -> Array:
    """Density per steradian of omega_i = reflect(omega_o, h): D cos_h/(4 o.h); 0 for o.h <= 0.

    The mapping stretches solid angles by |di/dh| = 4 o.h.
    """
    o_h = dot(omega_o, h)
    return np.where(o_h > 0, kurt_pdf(h, mx, my) / (4 * np.where(o_h > 0, o_h, 1.0)), 0.0)


# q = exp(-40) = 4e-18: what is narrower adds nothing to a sum in float64.
_LAST_EXPONENT = 40.0


def reflect(omega_o: Array, lobe: Any, slope: Array, bend: Array | float = 1.0) -> Reflected:
    """Mirror local views (..., 3) at half-vectors g = (slope, 1), to bend 2 (o.g)/|g|^2 g - o.

    The base is cos_i^(1-alpha) cos_o^-alpha/cos_h.
    """
    g = np.concatenate([slope, np.ones((*slope.shape[:-1], 1))], axis=-1)
    length2, product = dot(g, g), dot(omega_o, g)
    omega_i = (bend * 2 * product / length2)[..., None] * g - omega_o
    grazing = grazing_factor(np.where(product > 0, omega_i[..., 2], 0.0), omega_o[..., 2], lobe.alpha)
    schlick = schlick_fresnel(product / np.sqrt(length2), 0.0)
    return Reflected(omega_i, np.sqrt(length2) * grazing, schlick)


def linear_map(omega_o: Array, lobe: Any, slope: Array, columns: Array) -> Array:
    """Derivative of the direction for changes of the slope along two columns, see `reflection_map`."""
    return reflection_map(omega_o, slope, columns)


def stretch(omega_o: Array, lobe: Any, one: Array, other: Array) -> Array:
    """Solid angle of directions over the area of slopes between two, 4 (o.h) cos_h^3 (...).

    cos_h^-4 is the product of |g|^2 of both: they lie to either side of where half-vectors are reflected to
    the horizon the fastest.
    """
    product = np.maximum(dot(omega_o[..., :2], 0.5 * (one + other)) + omega_o[..., 2], 0)
    result: Array = 4 * product / ((1 + dot(one, one)) * (1 + dot(other, other)))
    return result


def values(omega_i: Array, omega_o: Array, lobe: Any) -> Values:
    """F cos_i at directions (3, k) above the horizon for one view (3,), without Fresnel."""
    mx, my = slopes(lobe)
    x, y, z = omega_i + omega_o[:, None]
    exponent = (x / (mx * z)) ** 2 + (y / (my * z)) ** 2
    near = np.flatnonzero(exponent < _LAST_EXPONENT)
    x, y, z = x[near], y[near], z[near]
    length2 = x * x + y * y + z * z
    # |i + o|^2 = 2 + 2 i.o and (o.h)^2 = (1 + i.o)/2: o.h = |i + o|/2.
    o_h = 0.5 * np.sqrt(length2)
    d = np.exp(-exponent[near]) * (length2 / (z * z)) ** 2 / (np.pi * mx * my)
    value = d / (4 * o_h) * grazing_factor(omega_i[2, near], omega_o[2], lobe.alpha)
    return Values(near, value, o_h)


def widened_d(slope: Array, lobe: Any, covariance: Array) -> Array:
    """D cos_h^4 of a lobe whose slopes have a covariance (..., 2, 2) on top of their own, diag(m^2)/2."""
    mx, my = slopes(lobe)
    square, determinant = quadratic_form(covariance + 0.5 * np.diag([mx * mx, my * my]), slope)
    result: Array = np.exp(-0.5 * square) / (2 * np.pi * np.sqrt(determinant))
    return result


def rest(omega_i: Array, omega_o: Array, o_h: Array, lobe: Any) -> Array:
    """F cos_i/D without Fresnel, (...)."""
    return grazing_factor(omega_i[..., 2], omega_o[..., 2], lobe.alpha) / (4 * o_h)


def lit_exponent(lobe: Any) -> float:
    """Power of cos_i in the base, which changes most from view to view."""
    return 1 - float(lobe.alpha)


def albedo(omega_o: Array, lobe: Any) -> Array:
    """E_1 and E_s, (..., 2), see `directional_albedo`."""
    return directional_albedo(omega_o, lobe.roughness, lobe.alpha)
