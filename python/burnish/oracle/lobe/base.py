"""What the oracle asks of every model of lobe, and what models share."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ..arrays import Array, as_array

#: Smallest cosine of the view a lobe is evaluated at.
MIN_COS_O = 1e-4
#: Smallest first random number: ln of it is finite.
MIN_X1 = 2.0**-24


class LobeLike(Protocol):
    """What the oracle reads of a lobe; `burnish.KurtLobe` and `burnish.GgxLobe` have it too."""

    @property
    def roughness(self) -> Any: ...  # noqa: D102
    @property
    def r0(self) -> Any: ...  # noqa: D102
    @property
    def weight(self) -> Any: ...  # noqa: D102
    @property
    def rotation(self) -> float: ...  # noqa: D102


class KurtLike(LobeLike, Protocol):
    """What the oracle reads of Kurt's lobe."""

    @property
    def alpha(self) -> float: ...  # noqa: D102


@dataclass(frozen=True)
class Reflected:
    """What places in a lobe's plane reflect; omega_i (..., 3), the others (...)."""

    omega_i: Array
    base: Array  # f cos_i without Fresnel, over the plane's density; 0 below the horizon
    schlick: Array  # (1 - o.h)^5


@dataclass(frozen=True)
class Values:
    """A lobe at directions: those that reflect anything, f cos_i without Fresnel there, and o.h."""

    near: npt.NDArray[np.int64]
    value: Array
    o_h: Array


#: Width of a lobe's plane, as a slope of half-vectors, of models that have no roughness for it.
WIDTHS: dict[str, Callable[[Any], float]] = {
    "LafortuneLobe": lambda lobe: 0.5 * float(np.sqrt(2 / (lobe.exponent + 1))),
    "SheenLobe": lambda lobe: 0.5,
}


def slopes(lobe: Any) -> tuple[float, float]:
    """Widths along tangent and bitangent, as slopes of half-vectors: of most models their roughness."""
    width = WIDTHS.get(type(lobe).__name__)
    mx, my = np.broadcast_to(as_array(width(lobe) if width else lobe.roughness), 2)
    return float(mx), float(my)


def normal_reflectance(lobe: Any) -> Array:
    """Reflectance (3,) along the normal, 1 of models without."""
    return np.broadcast_to(as_array(getattr(lobe, "r0", 1.0)), 3)


def rotation_of(lobe: Any) -> float:
    """Radians that the tangent turns by, 0 of models without."""
    return float(getattr(lobe, "rotation", 0.0))


def quadratic_form(covariance: Array, slope: Array) -> tuple[Array, Array]:
    """s^T C^-1 s and the determinant of C, (...), for C (..., 2, 2) and s (..., 2)."""
    a, b, c = covariance[..., 0, 0], covariance[..., 0, 1], covariance[..., 1, 1]
    determinant = np.linalg.det(covariance)
    x, y = slope[..., 0], slope[..., 1]
    return (c * x * x - 2 * b * x * y + a * y * y) / determinant, determinant


def schlick_fresnel(u: npt.ArrayLike, r0: npt.ArrayLike, f90: npt.ArrayLike = 1.0) -> Array:
    """Return F(u) = r0 + (f90 - r0)(1 - u)^5, u = o.h in [0, 1]; broadcasts."""
    r0 = as_array(r0)
    return r0 + (as_array(f90) - r0) * (1 - np.clip(as_array(u), 0, 1)) ** 5


def grazing_reflectance(lobe: LobeLike) -> Array:
    """Reflectance (3,) along the surface."""
    return np.broadcast_to(as_array(getattr(lobe, "f90", 1.0)), 3)
