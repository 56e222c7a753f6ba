"""Orthonormal frames about a normal, and directions packed into a square."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot, normalize

#: Pixels see their shading normals at least at this cosine.
LEAST_FACING = 1e-3
#: A tangent whose part across the normal is shorter than this share of its length counts as parallel to it:
#: in float32 most of what is left below is rounding.
PARALLEL_LIMIT = 1e-5


def sign_not_zero(v: npt.ArrayLike) -> Array:
    """Return 1 for zero of either sign and above, -1 below."""
    return np.where(as_array(v) >= 0, 1.0, -1.0)


def orthonormal_basis(n: npt.ArrayLike) -> tuple[Array, Array]:
    """Tangent and bitangent of a unit normal, without a singular direction (Duff et al. 2017).

    Parameters
    ----------
    n : (..., 3)
        Unit normals.

    Returns
    -------
    tangent, bitangent : (..., 3)
        Right-handed: cross(tangent, bitangent) = n.
    """
    x, y, z = np.moveaxis(as_array(n), -1, 0)
    sign = sign_not_zero(z)
    a = -1.0 / (sign + z)
    b = x * y * a
    tangent = np.stack([1 + sign * x * x * a, sign * b, -sign * x], axis=-1)
    bitangent = np.stack([b, sign + y * y * a, -y], axis=-1)
    return tangent, bitangent


def frame_from_tangent(n: npt.ArrayLike, t: npt.ArrayLike) -> tuple[Array, Array]:
    """Tangent made orthogonal to the unit normal, and bitangent cross(n, t).

    Gram-Schmidt runs twice, since after one step a tangent almost parallel to the normal keeps a share of it.
    A tangent that is zero, not finite or parallel to the normal is replaced by that of `orthonormal_basis`.
    """
    n, t = np.broadcast_arrays(as_array(n), as_array(t))
    finite = np.all(np.isfinite(t), axis=-1, keepdims=True)
    t = normalize(np.where(finite, t, 0.0))
    across = t - dot(t, n)[..., None] * n
    usable = np.linalg.norm(across, axis=-1, keepdims=True) > PARALLEL_LIMIT
    across = normalize(across)
    across = normalize(across - dot(across, n)[..., None] * n)
    tangent = np.where(usable, across, orthonormal_basis(n)[0])
    return tangent, np.cross(n, tangent)


def facing_normal(n: npt.ArrayLike, omega_o: npt.ArrayLike) -> Array:
    """Bend a unit normal that interpolation turned away from the eye until it just faces it.

    Parameters
    ----------
    n, omega_o : (..., 3)
        Unit vectors.
    """
    n, omega_o = as_array(n), as_array(omega_o)
    cos_o = dot(n, omega_o)[..., None]
    return np.where(cos_o < LEAST_FACING, normalize(n + (LEAST_FACING - cos_o) * omega_o), n)


def longitude_frame(n: npt.ArrayLike) -> tuple[Array, Array]:
    """Tangent along growing longitude about y, cross(y, n) over its length, and bitangent cross(n, t).

    Within 1e-5 of a pole the tangent is that of `orthonormal_basis`.
    """
    n = as_array(n)
    along = np.cross(np.array([0.0, 1.0, 0.0]), n)
    usable = np.linalg.norm(along, axis=-1, keepdims=True) > PARALLEL_LIMIT
    tangent = np.where(usable, normalize(along), orthonormal_basis(n)[0])
    return tangent, np.cross(n, tangent)


def rotate_frame(tangent: npt.ArrayLike, bitangent: npt.ArrayLike, angle: float) -> tuple[Array, Array]:
    """Turn a frame counter-clockwise about its normal by `angle` radians."""
    tangent, bitangent = as_array(tangent), as_array(bitangent)
    cosine, sine = np.cos(angle), np.sin(angle)
    return cosine * tangent + sine * bitangent, cosine * bitangent - sine * tangent


def octahedral_encode(n: npt.ArrayLike) -> Array:
    """Unfold directions onto [-1, 1]^2: z >= 0 fills the inner diamond, z < 0 the corners around it."""
    n = as_array(n)
    p = n[..., :2] / np.sum(np.abs(n), axis=-1, keepdims=True)
    folded = (1 - np.abs(p[..., ::-1])) * sign_not_zero(p)
    result: Array = np.where(n[..., 2:] < 0, folded, p)
    return result


def octahedral_decode(p: npt.ArrayLike) -> Array:
    """Unit directions of points made by `octahedral_encode`."""
    p = as_array(p)
    z = 1 - np.sum(np.abs(p), axis=-1, keepdims=True)
    unfolded = (1 - np.abs(p[..., ::-1])) * sign_not_zero(p)
    return normalize(np.concatenate([np.where(z < 0, unfolded, p), z], axis=-1))
