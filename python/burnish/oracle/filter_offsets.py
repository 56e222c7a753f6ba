"""Where the rays of accumulated pictures pass a pixel: a lattice, warped to the pixel filter.

The filter is a Blackman-Harris window over 3 pixels. Pictures weigh the same, so the share of them that
looks at a part of it is the window's share there.
"""

import numpy as np

from .arrays import Array, IntArray

RADIUS_PX = 1.5
_WINDOW = (0.35875, 0.48829, 0.14128, 0.01168)


def window_cumulative(x: Array) -> Array:
    """Share of the filter left of x pixels, the window's integral in closed form."""
    a0, a1, a2, a3 = _WINDOW
    t = np.clip((np.asarray(x, np.float64) / RADIUS_PX + 1) / 2, 0, 1)
    turn = 2 * np.pi * t
    sines = a1 * np.sin(turn) - a2 / 2 * np.sin(2 * turn) + a3 / 3 * np.sin(3 * turn)
    share: Array = t - sines / (2 * np.pi * a0)
    return share


def shortest_squares(modulus: int) -> IntArray:
    """Square of the shortest vector of the lattice of all (k, a k + j modulus), for a = 1..modulus/2.

    0 where a has a common divisor with the modulus. No shortest vector is longer than that of the hexagonal
    lattice, sqrt(2/sqrt 3 modulus), which bounds the k that are looked at.
    """
    a = np.arange(1, max(modulus // 2, 1) + 1)
    least = np.full(len(a), modulus**2)
    for k in range(1, int(np.sqrt(2 / np.sqrt(3) * modulus)) + 2):
        rest = a * k % modulus
        least = np.minimum(least, k**2 + np.minimum(rest, modulus - rest) ** 2)
    return np.asarray(np.where(np.gcd(a, modulus) == 1, least, 0), np.int64)


def lattice(count: int) -> Array:
    """Points in (-.5, .5)², one in the middle of each of `count` equal shares of either axis.

    The points are point-symmetric about 0. Of the lattices with a point in every column and row, and of those
    of one column and row more whose point at the corner is left out, the one whose shortest vector is longest
    against its modulus, with the smallest multiplier.
    """
    whole, opened = shortest_squares(count), shortest_squares(count + 1)
    points: Array
    row: Array
    if opened.max() * count >= whole.max() * (count + 1):
        column = np.arange(1, count + 1)
        row = np.asarray(column * (np.argmax(opened) + 1) % (count + 1), np.float64)
        points = np.stack([column, row], axis=-1) / count - (count + 1) / (2 * count)
    else:
        middle = np.arange(count) - (count - 1) / 2
        # Rows half-way between integers, as the columns are.
        row = middle * (np.argmax(whole) + 1) / count
        points = np.stack([middle / count, row - np.floor(row + 0.5)], axis=-1)
    return points


def filter_offsets(count: int) -> Array:
    """Offsets of `count` pictures from the pixel's centre, (count, 2) pixels; the first is the nearest."""
    points = lattice(count)
    low, high = np.full(points.shape, -RADIUS_PX), np.full(points.shape, RADIUS_PX)
    for _ in range(60):
        middle = (low + high) / 2
        is_left = window_cumulative(middle) < points + 0.5
        low, high = np.where(is_left, middle, low), np.where(is_left, high, middle)
    offsets: Array = (low + high) / 2
    nearest = int(np.argmin(np.round(np.sum(offsets**2, axis=-1), 9)))
    offsets[[0, nearest]] = offsets[[nearest, 0]]
    return offsets
