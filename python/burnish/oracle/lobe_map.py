"""The linear map from a lobe's half-vectors to directions, and the metric of lookups in a cube map."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot, normalize
from .cube_map import FACE_AXES, cube_face_uv

# Sines below this have no azimuth.
_SMALL = 1e-9


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


def cube_metric(mirror: npt.ArrayLike, t1: npt.ArrayLike, t2: npt.ArrayLike, power: float) -> Array:
    """Metric in which a lookup near `mirror` is round, (..., 2, 2) of determinant 1 in the basis (t1, t2).

    A lookup is round in its face's (u, v): on the sphere it is shorter along the radius of the face than
    across, by (1 + u^2 + v^2)^(1/2). Here u' = u (1 - v^4), v' = v (1 - u^4), which bends the radii so that
    they meet across edges; A = q e_r e_r^T + tau tau^T/q, q = (1 + u'^2 + v'^2)^(power/4), tau across the
    radius.
    """
    mirror = as_array(mirror)
    face, u, v = cube_face_uv(mirror)
    axes = FACE_AXES[face]
    bent_u, bent_v = (u * (1 - v**4))[..., None], (v * (1 - u**4))[..., None]
    across = bent_u * axes[..., 2, :] - bent_v * axes[..., 1, :]
    tau = normalize(across - dot(across, mirror)[..., None] * mirror)
    # In the middle of a face any axis does, as q is 1 there.
    tau = np.where(np.linalg.norm(tau, axis=-1, keepdims=True) > 0.5, tau, t1)
    radial = np.cross(mirror, tau)
    q = (1 + bent_u[..., 0] ** 2 + bent_v[..., 0] ** 2) ** (power / 4)
    r1, r2, a1, a2 = dot(radial, t1), dot(radial, t2), dot(tau, t1), dot(tau, t2)
    off = q * r1 * r2 + a1 * a2 / q
    rows = [[q * r1 * r1 + a1 * a1 / q, off], [off, q * r2 * r2 + a2 * a2 / q]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def principal_axes(matrix: npt.ArrayLike) -> tuple[Array, Array, Array, Array]:
    """Singular values a >= b of 2 x 2 matrices, and the first right singular vector (v1, v2).

    The second one is (-v2, v1), so that mixtures keep their handedness.
    """
    matrix = as_array(matrix)
    m00, m01, m10, m11 = (matrix[..., i, j] for i in (0, 1) for j in (0, 1))
    p, t, r = m00**2 + m10**2, m01**2 + m11**2, m00 * m01 + m10 * m11
    half = np.hypot(0.5 * (p - t), r)
    a = np.sqrt(0.5 * (p + t) + half)
    b = np.abs(m00 * m11 - m01 * m10) / a
    angle = 0.5 * np.arctan2(2 * r, p - t)
    return a, b, np.cos(angle), np.sin(angle)
