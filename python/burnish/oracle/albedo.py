"""Directional albedo of a Kurt lobe by quadrature over half-vectors."""

from functools import lru_cache

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, remembered
from .lobe.base import MIN_COS_O

# q = exp(-36) = 2e-16: nothing of the lobe lies beyond this slope, in units of roughness.
_LAST_RADIUS = 6.0
# Nodes along the radius and along each quarter of the azimuth.
_RADIUS_NODES = 32
_AZIMUTH_NODES = 32
# Views handled at once: bounds memory to some hundred megabytes.
_CHUNK = 512


@lru_cache(maxsize=8)
def _unit_nodes(count: int) -> tuple[Array, Array]:
    x, w = np.polynomial.legendre.leggauss(count)
    return 0.5 * (x + 1), 0.5 * w


def directional_albedo(omega_o: npt.ArrayLike, roughness: npt.ArrayLike, alpha: float) -> Array:
    """Return the two parts of the albedo that Fresnel blends: E = r0 E_1 + (1 - r0) E_s.

    E_1 has F = 1 and E_s has F = (1 - o.h)^5; a lobe's albedo is its weight times `blend_albedo`.

    With p = (mx s cos phi, my s sin phi, 1) along h, D cos_h dh = exp(-s^2)/pi s ds dphi. Light is above the
    horizon for oz A s^2 - 2 B s < oz, A = |p_xy|^2/s^2, B = o.p_xy/s: s runs to the one positive root. There
    cos_i^(1 - alpha) has a branch point, so nodes crowd toward it; and where B changes sign a grazing view's
    root jumps from small to large, so nodes of the azimuth crowd toward these two angles.

    Parameters
    ----------
    omega_o : (..., 3)
        Views in the lobe's frame; the cosine is clamped to 1e-4.

    Returns
    -------
    parts : (..., 2)
        E_1 and E_s; relative error below 1e-5.
    """
    return _sum_albedo(omega_o, roughness, alpha)


@remembered
def _sum_albedo(omega_o: Array, roughness: Array, exponent: Array) -> Array:
    alpha = float(exponent)
    mx, my = np.broadcast_to(roughness, 2)
    flat = omega_o.reshape(-1, 3)
    parts = [_albedo_chunk(flat[i : i + _CHUNK], mx, my, alpha) for i in range(0, len(flat), _CHUNK)]
    return np.concatenate(parts or [np.zeros((0, 2))]).reshape(*omega_o.shape[:-1], 2)


def _albedo_chunk(omega_o: Array, mx: float, my: float, alpha: float) -> Array:
    oz = np.maximum(omega_o[:, 2], MIN_COS_O)[:, None]
    bx, by = omega_o[:, 0:1] * mx, omega_o[:, 1:2] * my  # B = bx cos phi + by sin phi
    t, wt = _unit_nodes(_AZIMUTH_NODES)
    graded, graded_weight = t**3, 3 * t**2 * wt
    quarter = 0.5 * np.pi
    # Four quarters, two on each side of the two zeros of B at +- 90 degrees from its largest value.
    near = quarter * graded
    offsets = np.concatenate([near, -near, np.pi - near, np.pi + near])
    phi = np.arctan2(by, bx) - quarter + offsets[None, :]
    phi_weight = np.tile(quarter * graded_weight, 4)
    px, py = mx * np.cos(phi), my * np.sin(phi)
    a = px * px + py * py
    b = omega_o[:, 0:1] * px + omega_o[:, 1:2] * py
    root = np.sqrt(b * b + oz * oz * a)
    # The positive root, written without cancellation on both sides of b = 0.
    last = np.where(b > 0, (b + root) / (oz * a), oz / (root - np.minimum(b, 0)))
    last = np.minimum(last, _LAST_RADIUS)

    x, wx = _unit_nodes(_RADIUS_NODES)
    to_end, jacobian = (1 - x) ** 3, 3 * (1 - x) ** 2 * wx
    s = last[..., None] * (1 - to_end)
    weight = np.exp(-s * s) * s * (jacobian * last[..., None]) * (phi_weight / np.pi)[:, None]
    length2 = 1 + a[..., None] * s * s
    o_p = oz[..., None] + b[..., None] * s
    cos_i = np.maximum(2 * o_p / length2 - oz[..., None], 0)
    length = np.sqrt(length2)
    # 1/cos_h is |p|: the estimator's weight F cos_i^(1-alpha) cos_o^-alpha / cos_h.
    value = weight * length * (cos_i if alpha == 0 else np.where(cos_i > 0, cos_i, 0.0) ** (1 - alpha))
    schlick = (1 - np.clip(o_p / length, 0, 1)) ** 5
    both = np.stack([np.sum(value, axis=(1, 2)), np.sum(value * schlick, axis=(1, 2))], axis=-1)
    return both * oz**-alpha


def blend_albedo(parts: npt.ArrayLike, r0: npt.ArrayLike, f90: npt.ArrayLike = 1.0) -> Array:
    """Albedo per channel, (..., 3), of reflectances r0 and f90 (a number or three) from the two parts."""
    parts = as_array(parts)[..., None, :]
    r0 = np.broadcast_to(as_array(r0), 3)
    result: Array = r0 * parts[..., 0] + (as_array(f90) - r0) * parts[..., 1]
    return result
