"""Small vector helpers shared by the oracle."""

from collections import OrderedDict
from collections.abc import Callable
from functools import wraps
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]

# Results that `remembered` keeps of each function, and numbers that one may depend on.
_MOST_REMEMBERED, _MOST_NUMBERS = 64, 10_000


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


def remembered(function: Callable[..., Array]) -> Callable[..., Array]:
    """Keep the last small results of a function of arrays, read-only: quadratures are asked for again."""
    known: OrderedDict[Any, Array] = OrderedDict()

    @wraps(function)
    def ask(*arguments: Any) -> Array:
        arrays = [as_array(argument) for argument in arguments]
        if sum(array.size for array in arrays) > _MOST_NUMBERS:
            return function(*arrays)
        key = tuple((array.shape, array.tobytes()) for array in arrays)
        if key not in known:
            known[key] = function(*arrays)
            known[key].setflags(write=False)
            if len(known) > _MOST_REMEMBERED:
                known.popitem(last=False)
        known.move_to_end(key)
        return known[key]

    return ask
