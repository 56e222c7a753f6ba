"""Points on the unit square, and the half-vectors of a lobe made from them."""

from typing import Literal

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array
from .lobe.base import MIN_X1
from .lobe.kurt import kurt_sample

Points = Literal["hammersley", "fibonacci"]

_GOLDEN_RATIO = (1 + 5**0.5) / 2


def radical_inverse(index: npt.ArrayLike) -> Array:
    """Van der Corput's sequence in base 2: the 32 bits of the index mirrored about the binary point."""
    bits = np.asarray(index, dtype=np.uint64)
    value = np.zeros(bits.shape)
    for place in range(32):
        value += ((bits >> np.uint64(place)) & np.uint64(1)).astype(np.float64) * 2.0 ** -(place + 1)
    return value


def hammersley(count: int) -> Array:
    """Points (k/count, radical inverse of k), k = 0..count-1, the first at least 2^-24; (count, 2)."""
    k = np.arange(count)
    return np.stack([np.maximum(k / count, MIN_X1), radical_inverse(k)], axis=-1)


def fibonacci(count: int) -> Array:
    """Points ((k + 1/2)/count, frac(k/golden ratio)), the spiral of Fibonacci on the square; (count, 2)."""
    k = np.arange(count)
    return np.stack([(k + 0.5) / count, np.mod(k / _GOLDEN_RATIO, 1.0)], axis=-1)


def point_set(points: Points, count: int) -> Array:
    """Points of a named set, (count, 2)."""
    if count < 1:
        raise ValueError(f"samples: expected an integer >= 1, got {count}")
    if points == "hammersley":
        return hammersley(count)
    if points == "fibonacci":
        return fibonacci(count)
    raise ValueError(f'points: expected "hammersley" or "fibonacci", got {points!r}')


def importance_half_vectors(roughness: npt.ArrayLike, points: Points, count: int) -> Array:
    """Half-vectors of density D cos_h, (count, 3)."""
    mx, my = np.broadcast_to(as_array(roughness), 2)
    x = point_set(points, count)
    return kurt_sample(x[:, 0], x[:, 1], mx, my)
