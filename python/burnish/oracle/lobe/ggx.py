"""Trowbridge and Reitz' lobe (GGX), with height-correlated shadowing of Smith and Schlick's Fresnel.

Its plane is the disc of normals that the eye sees (Heitz 2018): a place x of density (1 + |x|^2)^-2/pi is
the point (x1, x2)/(1 + |x|^2)^1/2 of a unit disc, which is squeezed to what is seen of a hemisphere,
stretched by the roughness. What is drawn so reflects with a weight G_2/G_1(o) <= 1 beside Fresnel.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from ..arrays import Array, as_array, dot, normalize, remembered
from .base import MIN_COS_O, Reflected, Values, grazing_reflectance, quadratic_form, schlick_fresnel, slopes

#: Of the lobe in its plane: (1 + |x|^2)^-2/pi.
DENSITY = "student"
#: Half-vectors say all of it: they have a density D.
HAS_HALF_VECTORS = True
#: Half-vectors depend on the view.
HAS_FIXED_HALF_VECTORS = False
#: Samples are placed once for every view.
HAS_VIEW_TABLES = True
#: Slope of Kurt's lobe, by which prefiltered maps are made, that serves it best, over alpha.
FILTER_SLOPE = 1.1
# Least height of a normal of the stretched hemisphere: its half-vector has a slope.
_LEAST_HEIGHT = 1e-9
# Sines below this have no azimuth.
_SMALL = 1e-9
# Nodes of the albedo along the radius and around.
_RADIUS_NODES, _AZIMUTH_NODES = 96, 192
# Views handled at once.
_CHUNK = 128


@dataclass(frozen=True)
class GgxLobe:
    """f = weight F(u) D V, u = o.h."""

    roughness: Any = 0.2  # alpha, or alphas along tangent and bitangent; not perceptual
    r0: Any = 1.0
    f90: Any = 1.0
    weight: Any = 1.0
    rotation: float = 0.0  # radians, turns the tangent counter-clockwise about the normal
    compensate: str = "none"  # "scale": times 1 + r0/f90 (1/E_1 - 1)


def ggx_d(h: npt.ArrayLike, ax: npt.ArrayLike, ay: npt.ArrayLike) -> Array:
    """Return D = 1/(pi ax ay ((hx/ax)^2 + (hy/ay)^2 + hz^2)^2), per steradian."""
    x, y, z = np.moveaxis(as_array(h), -1, 0)
    ax, ay = as_array(ax), as_array(ay)
    q = (x / ax) ** 2 + (y / ay) ** 2 + z * z
    result: Array = 1 / (np.pi * ax * ay * q * q)
    return result


def projected_width(v: npt.ArrayLike, ax: float, ay: float) -> Array:
    """Return a(v) = (vz^2 + (ax vx)^2 + (ay vy)^2)^1/2; Smith's G_1 is 2 vz/(vz + a)."""
    x, y, z = np.moveaxis(as_array(v), -1, 0)
    width: Array = np.sqrt(z * z + (ax * x) ** 2 + (ay * y) ** 2)
    return width


def ggx_visibility(omega_i: npt.ArrayLike, omega_o: npt.ArrayLike, ax: float, ay: float) -> Array:
    """Return V = 1/(2 (co a(i) + ci a(o))), G_2/(4 ci co); ci > 0, co is raised to 1e-4."""
    ci, co = as_array(omega_i)[..., 2], np.maximum(as_array(omega_o)[..., 2], MIN_COS_O)
    result: Array = 0.5 / (co * projected_width(omega_i, ax, ay) + ci * projected_width(omega_o, ax, ay))
    return result


def ggx_brdf(omega_i: npt.ArrayLike, omega_o: npt.ArrayLike, lobe: Any) -> Array:
    """Return the reflectance per steradian, (..., 3), in the lobe's own frame; 0 below the surface."""
    omega_i, omega_o = np.broadcast_arrays(as_array(omega_i), as_array(omega_o))
    seen = (omega_i[..., 2] > 0) & (omega_o[..., 2] > 0)
    up = np.array([0.0, 0.0, 1.0])
    i, o = np.where(seen[..., None], omega_i, up), np.where(seen[..., None], omega_o, up)
    h = normalize(i + o)
    value = np.where(seen, ggx_d(h, *slopes(lobe)) * ggx_visibility(i, o, *slopes(lobe)), 0.0)
    r0, f90 = np.broadcast_to(as_array(lobe.r0), 3), grazing_reflectance(lobe)
    fresnel = schlick_fresnel(dot(o, h)[..., None], r0, f90)
    return as_array(lobe.weight) * fresnel * value[..., None]


def _disc_frame(omega_o: Array, ax: float, ay: float) -> tuple[Array, Array, Array, Array]:
    """The stretched view O, tangents T1 (level) and T2 = O x T1, and c = (1 + O_z)/2."""
    stretched = normalize(omega_o * [ax, ay, 1.0])
    sine = np.hypot(stretched[..., 0], stretched[..., 1])
    has_azimuth = sine > _SMALL
    safe = np.where(has_azimuth, sine, 1.0)
    level = [
        np.where(has_azimuth, -stretched[..., 1] / safe, 0.0),
        np.where(has_azimuth, stretched[..., 0] / safe, 1.0),
    ]
    t1 = np.stack([*level, np.zeros_like(sine)], axis=-1)
    return stretched, t1, np.cross(stretched, t1), 0.5 * (1 + stretched[..., 2])


def _turn(t1: Array) -> Array:
    """Turns places of the lobe's axes to the disc's, (..., 2, 2): seen along the normal they are slopes."""
    level = t1[..., :2]
    return np.stack([level, np.stack([-level[..., 1], level[..., 0]], axis=-1)], axis=-2)


def half_vectors(omega_o: Array, place: Array, ax: float, ay: float) -> Array:
    """Half-vectors (..., 3) of places of the plane, (..., 2), at local views that broadcast."""
    stretched, t1, t2, c = _disc_frame(omega_o, ax, ay)
    place = np.einsum("...ij,...j->...i", _turn(t1), place)
    k = 1 / np.sqrt(1 + dot(place, place))
    first = k * place[..., 0]
    second = (1 - c) * np.sqrt(1 - first**2) + c * k * place[..., 1]
    third = np.sqrt(np.maximum(1 - first**2 - second**2, 0))
    normal = first[..., None] * t1 + second[..., None] * t2 + third[..., None] * stretched
    height = np.maximum(normal[..., 2], _LEAST_HEIGHT)
    return normalize(np.stack([ax * normal[..., 0], ay * normal[..., 1], height], axis=-1))


def ggx_sample(omega_o: npt.ArrayLike, x1: npt.ArrayLike, x2: npt.ArrayLike, ax: float, ay: float) -> Array:
    """Half-vectors of density D G_1(o) (o.h)/co: places (x1/(1 - x1))^1/2 (cos 2 pi x2, sin 2 pi x2)."""
    x1, x2 = np.minimum(as_array(x1), 1 - 2.0**-24), as_array(x2)
    radius, azimuth = np.sqrt(x1 / (1 - x1)), 2 * np.pi * x2
    return half_vectors(
        as_array(omega_o), np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth)], -1), ax, ay
    )


def ggx_pdf_omega_i(h: npt.ArrayLike, omega_o: npt.ArrayLike, ax: float, ay: float) -> Array:
    """Density per steradian of the mirrored direction of `ggx_sample`: D/(2 (co + a(o))); 0 for o.h <= 0."""
    omega_o = as_array(omega_o)
    co = np.maximum(omega_o[..., 2], MIN_COS_O)
    density = ggx_d(h, ax, ay) / (2 * (co + projected_width(omega_o, ax, ay)))
    return np.where(dot(omega_o, h) > 0, density, 0.0)


def reflect(omega_o: Array, lobe: Any, slope: Array, bend: Array | float = 1.0) -> Reflected:
    """Mirror local views (..., 3) at the half-vectors of places slope/alpha; `bend` is of other lobes.

    The base is G_2/G_1(o) = ci (a(o) + co)/(a(i) co + a(o) ci).
    """
    ax, ay = slopes(lobe)
    h = half_vectors(omega_o, slope / [ax, ay], ax, ay)
    o_h = dot(omega_o, h)
    omega_i = 2 * o_h[..., None] * h - omega_o
    ci, co = omega_i[..., 2], np.maximum(omega_o[..., 2], MIN_COS_O)
    lit = (ci > 0) & (o_h > 0)
    i = np.where(lit[..., None], omega_i, [0.0, 0.0, 1.0])
    visible = 2 * i[..., 2] * ggx_visibility(i, omega_o, ax, ay) * (projected_width(omega_o, ax, ay) + co)
    return Reflected(omega_i, np.where(lit, visible, 0.0), schlick_fresnel(o_h, 0.0))


def linear_map(omega_o: Array, lobe: Any, slope: Array, columns: Array) -> Array:
    """Derivative of the direction at the middle of the plane for changes of the slope along two columns.

    There H = A (tau T2 + z0 O), tau = 1 - c, z0^2 = 1 - tau^2, A = diag(ax, ay, 1), moves by A T1 and
    c A (T2 - tau/z0 O); h = H/|H|, and the direction by 2 (h (o.dh) + (o.h) dh).
    """
    ax, ay = slopes(lobe)
    stretched, t1, t2, c = _disc_frame(omega_o, ax, ay)
    tau = (1 - c)[..., None]
    z0 = np.sqrt(1 - tau**2)
    squash = np.array([ax, ay, 1.0])
    big = squash * (tau * t2 + z0 * stretched)
    moves = np.stack([squash * t1, c[..., None] * squash * (t2 - tau / z0 * stretched)], axis=-1)
    length = np.linalg.norm(big, axis=-1, keepdims=True)
    h = big / length
    dh = moves / length[..., None]
    dh = dh - h[..., None] * np.einsum("...i,...ij->...j", h, dh)[..., None, :]
    o_h = dot(omega_o, h)
    moved = 2 * (
        h[..., None] * np.einsum("...i,...ij->...j", omega_o, dh)[..., None, :] + o_h[..., None, None] * dh
    )
    omega_i = 2 * o_h[..., None] * h - omega_o
    # Any two directions across the mirrored one.
    axis = np.where(np.abs(omega_i[..., :1]) < 0.7, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    first = normalize(np.cross(omega_i, axis))
    tangents = np.stack([first, np.cross(omega_i, first)], axis=-2)
    result: Array = tangents @ moved @ _turn(t1) @ (columns / np.array([ax, ay])[:, None])
    return result


def stretch(omega_o: Array, lobe: Any, one: Array, other: Array) -> Array:
    """Solid angle of directions over the area of slopes in the middle between two, (...).

    What is drawn by the plane's density K has the density `ggx_pdf_omega_i`: their quotient, over ax ay.
    """
    ax, ay = slopes(lobe)
    place = 0.5 * (one + other) / [ax, ay]
    h = half_vectors(omega_o, place, ax, ay)
    density = (1 + dot(place, place)) ** -2 / np.pi
    pdf = ggx_pdf_omega_i(h, omega_o, ax, ay)
    result: Array = np.where(pdf > 0, density / np.where(pdf > 0, pdf, 1.0), 0.0) / (ax * ay)
    return result


def values(omega_i: Array, omega_o: Array, lobe: Any) -> Values:
    """F cos_i at directions (3, k) above the horizon for one view (3,), without Fresnel."""
    i, o = omega_i.T, np.broadcast_to(omega_o, omega_i.T.shape)
    h = normalize(i + o)
    value = ggx_d(h, *slopes(lobe)) * ggx_visibility(i, o, *slopes(lobe)) * i[:, 2]
    return Values(np.arange(len(i)), value, dot(o, h))


def widened_d(slope: Array, lobe: Any, covariance: Array) -> Array:
    """D cos_h^4 of a lobe whose slopes have a covariance S (..., 2, 2) on top of their own.

    (1 + x)^-2/(pi ax ay) is the mean of normal densities of covariance A/(2u), A = diag(alpha^2), under e^-u
    du. Those narrower than S, u > u0 = .4/s with s = tr(A^-1 S)/2, become one of covariance S and their mean,
    about A ln(1 + 1/u0)/2. The others are D times 1 - (1 + y) e^-y, y = u0 (1 + x), of A + 3 S/(1 + 3 s + .3
    x) for A: the peak of a lobe smoothed by little, and the tail as it was. Of a round lobe and S within 10 %
    at the peak, 16 % anywhere; 8 % in the mean over its light.
    """
    own = np.diag(np.square(slopes(lobe)))
    share = 0.5 * np.trace(np.linalg.solve(own, covariance), axis1=-2, axis2=-1)
    u0 = 0.4 / np.maximum(share, 1e-6)
    x, _ = quadratic_form(own + 0 * covariance, slope)
    wider = own + 3 * covariance / (1 + 3 * share + 0.3 * x)[..., None, None]
    form, determinant = quadratic_form(wider, slope)
    y = u0 * (1 + x)
    tail = (1 - (1 + y) * np.exp(-y)) / (np.sqrt(determinant) * (1 + form) ** 2)
    merged = own * np.log1p(1 / u0)[..., None, None] + 2 * covariance
    form, determinant = quadratic_form(merged, slope)
    result: Array = (tail + np.exp(-u0 - form) / np.sqrt(determinant)) / np.pi
    return result


def rest(omega_i: Array, omega_o: Array, o_h: Array, lobe: Any) -> Array:
    """F cos_i/D without Fresnel, (...)."""
    return ggx_visibility(omega_i, omega_o, *slopes(lobe)) * omega_i[..., 2]


def lit_exponent(lobe: Any) -> float:
    """Power of cos_i in the base where light grazes."""
    return 1.0


@lru_cache(maxsize=1)
def _albedo_places() -> tuple[Array, Array]:
    """Places and weights of a mean under the plane's density: 1/(1 + r^2) is uniform in 0..1."""
    x, w = np.polynomial.legendre.leggauss(_RADIUS_NODES)
    # Nodes crowd toward the tail, where the horizon cuts narrow lobes.
    share = (0.5 * (x + 1)) ** 2
    radius = np.sqrt(1 / share - 1)
    azimuth = 2 * np.pi * (np.arange(_AZIMUTH_NODES) + 0.5) / _AZIMUTH_NODES
    place = radius[:, None, None] * np.stack([np.cos(azimuth), np.sin(azimuth)], axis=-1)
    weight = np.repeat(0.5 * w * (x + 1) / _AZIMUTH_NODES, _AZIMUTH_NODES)
    return place.reshape(-1, 2), weight


def albedo(omega_o: Array, lobe: Any) -> Array:
    """E_1 and E_s, (..., 2): int f cos_i for F = 1 and for F = (1 - o.h)^5, within 3e-4."""
    return _sum_albedo(omega_o, slopes(lobe))


@remembered
def _sum_albedo(omega_o: Array, alpha: Array) -> Array:
    lobe = GgxLobe(tuple(alpha))
    place, weight = _albedo_places()
    flat = as_array(omega_o).reshape(-1, 1, 3)
    parts = []
    for begin in range(0, len(flat), _CHUNK):
        light = reflect(flat[begin : begin + _CHUNK], lobe, place * slopes(lobe))
        parts.append(np.stack([light.base @ weight, (light.base * light.schlick) @ weight], axis=-1))
    return np.concatenate(parts or [np.zeros((0, 2))]).reshape(*omega_o.shape[:-1], 2)
