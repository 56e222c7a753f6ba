"""The linear map from a lobe's half-vectors to directions around the mirror direction."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, normalize

# Sines below this have no azimuth.
_SMALL = 1e-9
# Squared singular values closer than this share of their sum are equal but for rounding.
_ROUND = 1e-12


def lobe_map(omega_o: npt.ArrayLike, mx: float, my: float) -> tuple[Array, Array, Array, Array]:
    """Linear map from half-vectors to directions around the mirror direction I.

    With x = (hx/(mx hz), hy/(my hz)) and e = o_xy/|o_xy|: c^2 = max(oz, .03)^2 + (ox mx)^2 + (oy my)^2,
    L = 2 [[ex mx, ey my], [-ey mx c, ex my c]] in the basis T1 = (oz e, |o_xy|), T2 = (-ey, ex, 0) across I.

    Returns
    -------
    matrix : (..., 2, 2)
    t1, t2 : (..., 3)
        Local axes.
    stretch : (...)
        c.
    """
    omega_o = as_array(omega_o)
    x, y, z = np.moveaxis(omega_o, -1, 0)
    sin_o = np.hypot(x, y)
    safe = np.where(sin_o > _SMALL, sin_o, 1.0)
    ex = np.where(sin_o > _SMALL, x / safe, 1.0)
    ey = np.where(sin_o > _SMALL, y / safe, 0.0)
    c = np.sqrt(np.maximum(z, 0.03) ** 2 + (x * mx) ** 2 + (y * my) ** 2)
    rows = [np.stack([ex * mx, ey * my], axis=-1), np.stack([-ey * mx * c, ex * my * c], axis=-1)]
    t1 = normalize(np.stack([z * ex, z * ey, sin_o], axis=-1))
    t2 = np.stack([-ey, ex, np.zeros_like(x)], axis=-1)
    return 2 * np.stack(rows, axis=-2), t1, t2, c


def reflection_map(omega_o: npt.ArrayLike, slope: npt.ArrayLike, columns: npt.ArrayLike) -> Array:
    """Derivative of the reflection at the half-vector of a slope, for changes of it along two columns.

    With g = (slope, 1), h = g/|g|, dh = (I - h h^T) (columns; 0)/|g| the direction 2 (o.h) h - o changes by
    2 (h (o.dh) + (o.h) dh). h.dh = 0: along h it is 2 o.dh, across it 2 (o.h) dh.

    Parameters
    ----------
    omega_o : (..., 3)
    slope : (..., 2)
    columns : (..., 2, 2)

    Returns
    -------
    matrix : (..., 2, 2)
        In the basis of the direction's tangents in the plane of o and h and across it.
    """
    omega_o, slope, columns = (as_array(v) for v in (omega_o, slope, columns))
    g = np.concatenate([slope, np.ones((*slope.shape[:-1], 1))], axis=-1)
    length = np.linalg.norm(g, axis=-1, keepdims=True)
    h = g / length
    wide = np.concatenate([columns, np.zeros((*columns.shape[:-2], 1, 2))], axis=-2) / length[..., None]
    dh = wide - h[..., :, None] * np.einsum("...i,...ij->...j", h, wide)[..., None, :]
    o_h = np.sum(omega_o * h, axis=-1, keepdims=True)
    # Unit vectors across h: t in the plane of o and h, b across the plane.
    t = omega_o - o_h * h
    sine = np.linalg.norm(t, axis=-1, keepdims=True)
    t = np.where(sine > _SMALL, t, np.cross([0.0, 1.0, 0.0], h))
    t = normalize(t)
    b = np.cross(h, t)
    # Turned by the reflection, a change along t stays as long as it is, one across shrinks by o.h.
    along = 2 * np.einsum("...i,...ij->...j", t, dh)
    across = 2 * o_h * np.einsum("...i,...ij->...j", b, dh)
    return np.stack([along, across], axis=-2)


def principal_axes(matrix: npt.ArrayLike) -> tuple[Array, Array, Array, Array]:
    """Singular values a >= b of 2 x 2 matrices, and the first right singular vector (v1, v2).

    The second one is (-v2, v1), so that mixtures keep their handedness. Of equal singular values every vector
    would do: then it is the matrix's first row, for `lobe_map` the plane of view.
    """
    matrix = as_array(matrix)
    m00, m01, m10, m11 = (matrix[..., i, j] for i in (0, 1) for j in (0, 1))
    p, t, r = m00**2 + m10**2, m01**2 + m11**2, m00 * m01 + m10 * m11
    half = np.hypot(0.5 * (p - t), r)
    a = np.sqrt(0.5 * (p + t) + half)
    b = np.abs(m00 * m11 - m01 * m10) / a
    is_round = half <= _ROUND * (p + t)
    angle = np.where(is_round, np.arctan2(m01, m00), 0.5 * np.arctan2(2 * r, p - t))
    return a, b, np.cos(angle), np.sin(angle)
