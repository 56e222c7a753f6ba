"""Mip pyramids by direct filtering, taps crossing face edges and corners."""

import math
from typing import Literal

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array
from .cube_map import add_border

Filter = Literal["box", "gauss4", "gauss6"]

#: Separable taps; tap k of texel i reads 2 i + k - (taps/2 - 1) of the finer level.
TAPS = {
    "box": np.array([1.0, 1.0]) / 2,
    "gauss4": np.array([1.0, 3.0, 3.0, 1.0]) / 8,
    "gauss6": np.array([1.0, 5.0, 10.0, 10.0, 5.0, 1.0]) / 32,
}

#: Variance per axis of a bilinear lookup at level l, in 4^l level-0 texels squared (maths.md, section 5).
LOOKUP_VARIANCE = {"box": 0.25, "gauss4": 5 / 12, "gauss6": 7 / 12}


def reduce_level(level: npt.ArrayLike, filter: Filter) -> Array:
    """Return the next coarser level, (6, n/2, n/2, c) of (6, n, n, c)."""
    level = as_array(level)
    if filter not in TAPS:
        raise ValueError(f"filter: expected one of {', '.join(TAPS)}, got {filter!r}")
    taps = TAPS[filter]
    size = level.shape[1]
    faces = add_border(level, len(taps) // 2 - 1)
    rows = sum(tap * faces[:, k : k + size : 2] for k, tap in enumerate(taps))
    result: Array = sum(tap * rows[:, :, k : k + size : 2] for k, tap in enumerate(taps))
    return result


def round_to_half(values: npt.ArrayLike) -> Array:
    """Round to the nearest half-precision number, ties to even, as float64."""
    return as_array(as_array(values).astype(np.float16))


def half_exponent(values: npt.ArrayLike) -> int:
    """Exponent of the power of two over which the engine's halves hold a map's texels.

    Of the exponents at which the largest value is at most 65504 and the least that is not black is a normal
    half, 2**-14 or more, the one nearest to 0. Where values are too far apart for that, the smallest at which
    the largest fits. Below 2**-44 of the largest all is black.

    Parameters
    ----------
    values : array
        Finite, 0 or more.
    """
    positive = as_array(values)
    positive = positive[positive > 0]
    if not positive.size:
        return 0
    largest = float(positive.max())
    least = float(positive[positive >= 2.0**-44 * largest].min())
    fit = math.frexp(largest)[1] - 16
    fit += largest > math.ldexp(65504.0, fit)
    most = math.frexp(least)[1] - 1 + 14
    return min(max(0, fit), max(fit, most))


def hold_in_halves(values: npt.ArrayLike) -> Array:
    """Round to what the engine's halves hold of a map, as float64."""
    unit = 2.0 ** half_exponent(values)
    return round_to_half(as_array(values) / unit) * unit


def build_pyramid(faces: npt.ArrayLike, filter: Filter = "gauss6", half: bool = False) -> list[Array]:
    """All levels of a cube map down to one texel a face.

    Parameters
    ----------
    faces : (6, N, N, c)
        N a power of two.
    filter : "box", "gauss4" or "gauss6"
    half : bool
        Round every level to half precision before the next is made of it, as a map stored in RGBA16F does,
        over the power of two of `half_exponent`.
    """
    level = as_array(faces)
    size = level.shape[1] if level.ndim == 4 else 0
    if level.ndim != 4 or level.shape[0] != 6 or level.shape[2] != size or size < 1 or size & (size - 1):
        raise ValueError(f"faces: expected shape (6, N, N, c), N a power of two, got {level.shape}")
    unit = 2.0 ** half_exponent(level) if half else 1.0
    levels = [round_to_half(level / unit) if half else level]
    while levels[-1].shape[1] > 1:
        coarser = reduce_level(levels[-1], filter)
        levels.append(round_to_half(coarser) if half else coarser)
    return [unit * one for one in levels]
