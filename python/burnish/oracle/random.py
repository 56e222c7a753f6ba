"""Points of the progressive reference, in whole numbers; equal to the shader's to the last bit."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, IntArray

_WORD = 2**32


def hash_uint(x: npt.ArrayLike) -> IntArray:
    """Permutation of 0..2^32 - 1: x xor x / 2^16, times odd, x xor x / 2^15, times odd, x xor x / 2^16."""
    word = np.asarray(x, np.uint64)
    for shift, factor in ((16, 0x7FEB352D), (15, 0x846CA68B)):
        word = (word ^ word // 2**shift) * np.uint64(factor) % np.uint64(_WORD)
    return (word ^ word // 2**16).astype(np.int64)


def unit_from_uint(x: npt.ArrayLike) -> Array:
    """Upper 24 bits as a fraction, [0, 1): all that a float32 holds."""
    return np.floor(np.asarray(x, np.int64) / 2**8) / 2**24


def recurrence_steps(dimensions: int) -> IntArray:
    """Powers of 1/g in units of 2^-32, g the positive root of g^(d + 1) = g + 1."""
    g = 1.5
    for _ in range(60):
        g = (g + 1) ** (1 / (dimensions + 1))
    return np.array([round(_WORD / g**power) for power in range(1, dimensions + 1)], np.int64)


def _advance(index: npt.ArrayLike, step: int, seed: npt.ArrayLike, salt: int) -> IntArray:
    index, seed = np.asarray(index, np.int64), np.asarray(seed, np.int64)
    # index * step would leave int64: its upper half is multiplied on its own.
    moved = index % 2**16 * step + index // 2**16 * step % 2**16 * 2**16
    shifted: IntArray = (moved + hash_uint(seed ^ salt)) % _WORD
    return shifted


def recurrence_2d(index: npt.ArrayLike, seed: npt.ArrayLike) -> Array:
    """Point `index` of the recurrence of the plastic number, shifted by two hashes of `seed`; (..., 2)."""
    x, y = map(int, recurrence_steps(2))
    points = [_advance(index, x, seed, 0), _advance(index, y, seed, 0x9E3779B9)]
    return unit_from_uint(np.stack(points, axis=-1))


def dither(pixel: npt.ArrayLike, picture: npt.ArrayLike) -> Array:
    """Threshold in [0, 1) of a pixel (..., 2), column and row, in one of several pictures.

    Columns and rows step by the recurrence of the plastic number, pictures by 1/g, g the golden ratio.
    """
    pixel = np.asarray(pixel, np.int64)
    x, y = map(int, recurrence_steps(2))
    golden = int(recurrence_steps(1)[0])
    steps = [(pixel[..., 0], x), (pixel[..., 1], y), (np.asarray(picture, np.int64), golden)]
    return unit_from_uint(sum(index * step % _WORD for index, step in steps) % _WORD)


def recurrence_3d_x(index: npt.ArrayLike, seed: npt.ArrayLike) -> IntArray:
    """First coordinate of `recurrence_3d` in units of 2^-32, with all its bits."""
    return _advance(index, int(recurrence_steps(3)[0]), seed, 0x68BC21EB)


def recurrence_3d(index: npt.ArrayLike, seed: npt.ArrayLike) -> Array:
    """Three-dimensional sister of `recurrence_2d`; (..., 3)."""
    _, y, z = map(int, recurrence_steps(3))
    points = [
        recurrence_3d_x(index, seed),
        _advance(index, y, seed, 0x02E5BE93),
        _advance(index, z, seed, 0x967A889B),
    ]
    return unit_from_uint(np.stack(points, axis=-1))
