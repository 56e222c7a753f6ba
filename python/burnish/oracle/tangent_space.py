"""What textures of directions mean at a surface point: glTF's tangent space."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, normalize
from .frame import frame_from_tangent

#: Directions of a texture shorter than this count as none.
LEAST_LENGTH = 1e-2


def mapped_normal(
    normal: npt.ArrayLike, tangent: npt.ArrayLike, texel: npt.ArrayLike, scale: float = 1.0
) -> Array:
    """Unit normal that a texture of normals asks for.

    Parameters
    ----------
    normal : (..., 3)
        Unit.
    tangent : (..., 4)
        The bitangent is w cross(normal, tangent).
    texel : (..., 3)
        In 0..1, standing for -1..1: along tangent, bitangent and normal.
    scale : float
        Of the first two, normalTexture.scale.
    """
    t, b = frame_from_tangent(normal, as_array(tangent)[..., :3])
    x, y, z = np.moveaxis(2 * as_array(texel) - 1, -1, 0)[..., None]
    return normalize(scale * (x * t + y * as_array(tangent)[..., 3:] * b) + z * as_array(normal))


def brushed_tangent(normal: npt.ArrayLike, tangent: npt.ArrayLike, texel: npt.ArrayLike) -> Array:
    """Tangent (..., 4) of a brushed lobe: red and green of its texel, in 0..1, hold its direction.

    `normal` and `tangent` as in `mapped_normal`; the tangent's handedness stays. A texel without direction
    (8 bits have no exact middle) leaves the tangent.
    """
    t, b = frame_from_tangent(normal, as_array(tangent)[..., :3])
    x, y = np.moveaxis(2 * as_array(texel)[..., :2] - 1, -1, 0)[..., None]
    has_direction = x * x + y * y > LEAST_LENGTH**2
    turned = np.where(has_direction, normalize(x * t + y * as_array(tangent)[..., 3:] * b), t)
    sign = np.broadcast_to(as_array(tangent)[..., 3:], (*turned.shape[:-1], 1))
    return np.concatenate([turned, sign], axis=-1)


def seen_from_behind(normal: npt.ArrayLike, tangent: npt.ArrayLike) -> tuple[Array, Array]:
    """Normal and tangent (..., 4) of a double-sided surface from its other side.

    glTF reverses the normal. Tangent and bitangent lie in the surface and stay, so that handedness changes.
    """
    return -as_array(normal), as_array(tangent) * [1.0, 1.0, 1.0, -1.0]
