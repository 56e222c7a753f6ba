"""The glossy lobe of Kurt et al. 2010: density, reflectance, sampling."""

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot, normalize

#: Smallest cosine of the view a lobe is evaluated at.
MIN_COS_O = 1e-4
#: Smallest first random number: ln of it is finite.
MIN_X1 = 2.0**-24
# Past this exponent q is 0 for every purpose, and exp would leave float64's normal range.
_MAX_EXPONENT = 700.0
# Below this cosine cos_h^4 leaves float32's range; q is 0 long before.
_MIN_COS_H = 1e-11


class LobeLike(Protocol):
    """What the oracle reads of a lobe; `burnish.KurtLobe` has it too."""

    @property
    def roughness(self) -> Any: ...  # noqa: D102
    @property
    def r0(self) -> Any: ...  # noqa: D102
    @property
    def alpha(self) -> float: ...  # noqa: D102
    @property
    def weight(self) -> Any: ...  # noqa: D102
    @property
    def rotation(self) -> float: ...  # noqa: D102
    @property
    def conserve_energy(self) -> bool: ...  # noqa: D102


@dataclass(frozen=True)
class KurtLobe:
    """f = weight F(u) D / (4 (o.h) ((i.n)(o.n))^alpha)."""

    roughness: Any = 0.2  # slope, or slopes along tangent and bitangent
    r0: Any = 1.0
    alpha: float = 0.0
    weight: Any = 1.0
    rotation: float = 0.0  # radians, turns the tangent counter-clockwise about the normal
    conserve_energy: bool = False  # divide by the albedo of r0 = 1 where that exceeds 1


def slopes(lobe: LobeLike) -> tuple[float, float]:
    """Roughness along tangent and bitangent."""
    mx, my = np.broadcast_to(as_array(lobe.roughness), 2)
    return float(mx), float(my)


def schlick_fresnel(u: npt.ArrayLike, r0: npt.ArrayLike) -> Array:
    """Return F(u) = r0 + (1 - r0)(1 - u)^5, u = o.h in [0, 1]; broadcasts."""
    r0 = as_array(r0)
    return r0 + (1 - r0) * (1 - np.clip(as_array(u), 0, 1)) ** 5


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


def kurt_brdf(omega_i: npt.ArrayLike, omega_o: npt.ArrayLike, lobe: LobeLike) -> Array:
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
