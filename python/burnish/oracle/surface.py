"""A surface point in 8 bytes: normal, tangent, handedness and material as the G-buffer stores them."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, BoolArray, IntArray, as_array, dot, normalize
from .frame import octahedral_decode, octahedral_encode, orthonormal_basis

#: Normals are two 16-bit fractions of this.
NORMAL_STEPS = 32767
#: The whole way around the diamond, in steps of a stored tangent.
ANGLE_STEPS = 32768


def diamond_encode(v: npt.ArrayLike) -> Array:
    """Angle of plane vectors as the way around the diamond |x| + |y| = 1 from (1, 0), -1..1.

    On the diamond's right half that way is y/2; on its left half it is what y lacks to the half-turn.
    """
    x, y = np.moveaxis(as_array(v), -1, 0)
    size = np.abs(x) + np.abs(y)
    height = y / np.where(size > 0, size, 1.0)
    left = np.where(y >= 0, 1 - height / 2, -1 - height / 2)
    result: Array = np.where(x >= 0, height / 2, left)
    return result


def diamond_decode(d: npt.ArrayLike) -> Array:
    """Unit vectors, (..., 2), of ways around the diamond in [-1, 1]."""
    way = 4 * np.abs(as_array(d))  # 0 at (1, 0), 2 at (0, 1), 4 at (-1, 0): an edge of the diamond is 2 long
    x = 1 - way / 2
    y = np.copysign(1 - np.abs(x), as_array(d))
    return normalize(np.stack([x, y], axis=-1))


def surface_counts(
    normal: npt.ArrayLike, tangent: npt.ArrayLike, packed_normal: npt.ArrayLike
) -> tuple[Array, Array]:
    """Integers that a packed surface holds, before they are rounded.

    Returns
    -------
    normal_counts : (..., 2)
        Octahedral coordinates in -32767..32767.
    angle_counts : (...)
        Diamond angle of the tangent in the basis of `packed_normal`, what the stored normal decodes to;
        0..32768, both ends meaning the half-turn.
    """
    along, across = orthonormal_basis(packed_normal)
    plane = np.stack([dot(tangent, along), dot(tangent, across)], axis=-1)
    return octahedral_encode(normal) * NORMAL_STEPS, (diamond_encode(plane) / 2 + 0.5) * ANGLE_STEPS


def has_surface(surface: npt.ArrayLike) -> BoolArray:
    """Whether packed words, (..., 2), hold a surface: their material is not 0."""
    result: BoolArray = np.asarray(surface, np.int64)[..., 1] % 2**16 != 0
    return result


def unpack_material(surface: npt.ArrayLike) -> IntArray:
    """Material of packed surfaces; what holds none has no meaning."""
    result: IntArray = np.asarray(surface, np.int64)[..., 1] % 2**16 - 1
    return result


def unpack_normal(surface: npt.ArrayLike) -> Array:
    """Unit normals of packed surfaces."""
    word = np.asarray(surface, np.int64)[..., 0]
    counts = np.stack([word % 2**16, word // 2**16], axis=-1)
    signed = np.where(counts >= 2**15, counts - 2**16, counts)
    return octahedral_decode(np.maximum(signed / NORMAL_STEPS, -1.0))


def unpack_frame(surface: npt.ArrayLike) -> tuple[Array, Array, Array]:
    """Tangent, bitangent and normal of packed surfaces; a handedness of -1 turns the bitangent around."""
    word = np.asarray(surface, np.int64)[..., 1]
    normal = unpack_normal(surface)
    along, across = orthonormal_basis(normal)
    plane = diamond_decode(word // 2**17 / (ANGLE_STEPS / 2) - 1)
    tangent = plane[..., :1] * along + plane[..., 1:] * across
    handedness = np.where(word // 2**16 % 2 == 1, -1.0, 1.0)
    return tangent, handedness[..., None] * np.cross(normal, tangent), normal


def pack_surface(
    normal: npt.ArrayLike, tangent: npt.ArrayLike, handedness: npt.ArrayLike, material: npt.ArrayLike
) -> IntArray:
    """Packed words, (..., 2); the tangent is measured in the basis of the normal as it is stored."""
    counts = np.rint(octahedral_encode(normal) * NORMAL_STEPS).astype(np.int64) % 2**16
    first = counts[..., 0] + counts[..., 1] * 2**16
    stored = unpack_normal(np.stack([first, first], axis=-1))
    angle = np.rint(surface_counts(normal, tangent, stored)[1]).astype(np.int64) % ANGLE_STEPS
    mirrored = (as_array(handedness) < 0).astype(np.int64)
    second = angle * 2**17 + mirrored * 2**16 + np.asarray(material, np.int64) + 1
    return np.stack([first, second], axis=-1)
