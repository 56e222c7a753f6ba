"""Small vector helpers shared by the oracle."""

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]


def as_array(values: npt.ArrayLike) -> Array:
    """Return `values` as float64, without a copy where it already is."""
    return np.asarray(values, dtype=np.float64)


def dot(a: npt.ArrayLike, b: npt.ArrayLike) -> Array:
    """Return the scalar product along the last axis."""
    result: Array = np.sum(as_array(a) * as_array(b), axis=-1)
    return result


def normalize(v: npt.ArrayLike) -> Array:
    """Return `v` over its length; a zero vector stays zero."""
    v = as_array(v)
    length: Any = np.linalg.norm(v, axis=-1, keepdims=True)
    result: Array = v / np.where(length > 0, length, 1.0)
    return result


def reflect(omega_o: npt.ArrayLike, h: npt.ArrayLike) -> Array:
    """Mirror `omega_o` about `h`: i = 2 (o.h) h - o."""
    omega_o, h = as_array(omega_o), as_array(h)
    result: Array = 2 * dot(omega_o, h)[..., None] * h - omega_o
    return result
