"""Levels that are round on the sphere: what `matched` reads best."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array
from .cube_map import PaddedCube, pad_cube, sample_cube, texel_directions
from .footprint import planar_level
from .frame import orthonormal_basis
from .matched_table import Mixture, load_table, mixture_at

#: Variance of a level per axis, in (2/n)^2 steradian: n texels along an edge, 2/n a texel in a face's middle.
SPHERICAL_LEVEL_VARIANCE = 0.75
#: Lookups that make a texel.
PREFILTER_SAMPLES = 24
# Levels to add to a lookup's: what measures best for a mixture as fine as this.
_SHIFT = -0.05
# Texels filtered at once: bounds memory.
_CHUNK = 4096


def build_spherical_pyramid(levels: Sequence[npt.ArrayLike], mixture: Mixture | None = None) -> list[Array]:
    """Filter every level but the first by a Gaussian that is the same everywhere on the sphere.

    Kernels of planar pyramids are round in a face's (u, v): on the sphere they are ellipses whose size and
    shape depend on the place, and they bend at edges. Here a texel of a level with n texels along an edge is
    the mean under a Gaussian of variance V = .75 (2/n)^2 per axis of angle. A mixture of `matched` stands for
    the Gaussian: sample k is a lookup of the planar levels at the angle |y_k| sqrt(2 V) from the texel, of
    the standard deviation s_k sqrt(2 V).

    Parameters
    ----------
    levels : list of (6, n, n, c)
        From `build_pyramid` with "gauss6".
    mixture : Mixture, optional
        Of an aspect of 1; by default the table's of PREFILTER_SAMPLES samples.

    Returns
    -------
    levels : list of (6, n, n, c)
        The first as it is.
    """
    if mixture is None:
        mixture = mixture_at(load_table()[PREFILTER_SAMPLES], PREFILTER_SAMPLES, 1.0)
    cube = pad_cube(levels)
    first = as_array(levels[0])
    result = [first]
    size = first.shape[1] // 2
    while size >= 1:
        directions = texel_directions(size).reshape(-1, 3)
        parts = [
            _filtered(cube, directions[k : k + _CHUNK], SPHERICAL_LEVEL_VARIANCE * (2 / size) ** 2, mixture)
            for k in range(0, len(directions), _CHUNK)
        ]
        result.append(np.concatenate(parts).reshape(6, size, size, -1))
        size //= 2
    return result


def _filtered(cube: PaddedCube, directions: Array, variance: float, mixture: Mixture) -> Array:
    scale = np.sqrt(2 * variance)
    angle = scale * np.hypot(mixture.y1, mixture.y2)
    sine = scale * np.sinc(angle / np.pi)
    tangent, bitangent = orthonormal_basis(directions)
    around = np.cos(angle)[:, None] * directions[:, None]
    around += (sine * mixture.y1)[:, None] * tangent[:, None] + (sine * mixture.y2)[:, None] * bitangent[
        :, None
    ]
    level = planar_level((scale * mixture.s) ** 2, around, cube.face_texels, "gauss6") + _SHIFT
    result: Array = np.einsum("k,ikc->ic", mixture.w, sample_cube(cube, around, level))
    return result
