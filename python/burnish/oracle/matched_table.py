"""The table of `matched`: small Gaussian mixtures fitted to elliptic Gaussian lobes."""

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array

#: Numbers of samples that have a mixture.
COUNTS = (*range(2, 11), 12, 14, 16, 17, 20, 24, 30, 32, 48, 64)
#: Rows along the aspect rho, at rho_j = LARGEST_ASPECT^(j/(ASPECT_COUNT - 1)).
ASPECT_COUNT = 52
LARGEST_ASPECT = 100.0
#: Where `fit_matched` writes it.
TABLE_PATH = Path(__file__).parent.parent / "tables" / "matched.txt"
#: Of the committed file; the one place that knows it.
TABLE_SHA256 = "b2106b8a93dc66a7a132c70776ded058690b7c49afa3779b7551469fd5cb1ec7"


@dataclass(frozen=True)
class Mixture:
    """All samples of a mixture, (..., n) each: centre, width in units of the minor axis, weight."""

    y1: Array  # along the major axis, in its unit
    y2: Array
    s: Array
    w: Array


@lru_cache(maxsize=1)
def load_table() -> dict[int, Array]:
    """Rows y1, y2, s, w of the half-samples, (ASPECT_COUNT, half, 4) for each count."""
    text = TABLE_PATH.read_text(encoding="ascii").splitlines()
    numbers = np.array([line.rstrip(",").split(",") for line in text if not line.startswith("//")], float)
    table, start = {}, 0
    for count in COUNTS:
        half = (count + 1) // 2
        table[count] = numbers[start : start + ASPECT_COUNT * half].reshape(ASPECT_COUNT, half, 4)
        start += ASPECT_COUNT * half
    if start != len(numbers):
        raise ValueError(f"{TABLE_PATH}: expected {start} rows, got {len(numbers)}")
    return table


def closest_count(samples: int) -> int:
    """Count that has a mixture and is closest to `samples`; of equally close ones the larger."""
    if samples < 1:
        raise ValueError(f"samples: expected an integer >= 1, got {samples}")
    ranked: list[int] = sorted(COUNTS, key=lambda count: (abs(count - samples), -count))
    return ranked[0]


def mixture_at(rows: Array, samples: int, rho: npt.ArrayLike) -> Mixture:
    """Interpolate the rows of one count linearly in ln rho and unfold the pairs (y, -y); weights sum to 1.

    Parameters
    ----------
    rows : (ASPECT_COUNT, half, 4)
    rho : (...)
        At least 1; beyond the last row that row serves.
    """
    rho = as_array(rho)
    at = np.clip(
        np.log(np.maximum(rho, 1.0)) * ((ASPECT_COUNT - 1) / math.log(LARGEST_ASPECT)), 0, ASPECT_COUNT - 1
    )
    low = np.minimum(at.astype(np.int64), ASPECT_COUNT - 2)
    share = (at - low)[..., None, None]
    half = (1 - share) * rows[low] + share * rows[low + 1]
    pairs = half[..., samples % 2 :, :]
    both = np.concatenate([half, pairs * [-1.0, -1.0, 1.0, 1.0]], axis=-2)
    w = both[..., 3] / np.sum(both[..., 3], axis=-1, keepdims=True)
    return Mixture(both[..., 0], both[..., 1], both[..., 2], w)


#: Rows that the engine reads, the nearest one: of aspects, evenly in their log; of views, evenly in their
#: radius.
TABLE_ROWS = 1024
#: Views of brushed lobes from the normal to the horizon; they are a grid over a square.
VIEW_NODES = 128
#: Larger aspects are placed at the view itself.
MOST_VIEW_ASPECT = 16.0


def nearest_aspect(rho: npt.ArrayLike) -> Array:
    """Aspect of the row that serves an aspect >= 1."""
    steps = (TABLE_ROWS - 1) / math.log(LARGEST_ASPECT)
    row = np.floor(np.log(np.maximum(as_array(rho), 1.0)) * steps + 0.5)
    aspect: Array = np.exp(np.minimum(row, TABLE_ROWS - 1) / steps)
    return aspect


def view_radius(cosine: npt.ArrayLike) -> Array:
    """Give r, r^2 = 1 - (cos_o + sqrt(cos_o))/2, 0 along the normal and 1 at the horizon: even rows."""
    cosine = np.clip(as_array(cosine), 0, 1)
    radius: Array = np.sqrt(1 - (cosine + np.sqrt(cosine)) / 2)
    return radius


def radius_cosine(radius: npt.ArrayLike) -> Array:
    """Invert `view_radius`; at least 1e-4, and below 1: a trace of a sine keeps the azimuth."""
    root = (np.sqrt(9 - 8 * as_array(radius) ** 2) - 1) / 2
    cosine: Array = np.clip(root**2, 1e-4, 1 - 1e-12)
    return cosine


def half_square(omega_o: npt.ArrayLike) -> tuple[Array, Array]:
    """Place of local views on half of a square, and the side from which they were turned there.

    Returns
    -------
    square : (..., 2)
        (o_x, o_y) r/max(|o_x|, |o_y|), of views with o_y < 0 half a turn away: x is -1..1, y is 0..1.
    side : (..., 1)
        -1 where the view was turned, else 1.
    """
    omega_o = as_array(omega_o)
    plane = omega_o[..., :2]
    side = np.where(plane[..., 1:] < 0, -1.0, 1.0)
    largest = np.max(np.abs(plane), axis=-1, keepdims=True)
    radius = view_radius(omega_o[..., 2])[..., None]
    return side * plane * radius / np.where(largest > 0, largest, 1.0), side


def plane_of_view(view: Array) -> Array:
    """Unit vector (..., 2) along the first two of a view's numbers.

    A view along the normal has no azimuth: the first axis serves.
    """
    plane = view[..., :2]
    length = np.linalg.norm(plane, axis=-1, keepdims=True)
    unit: Array = np.where(length > 0, plane, [1.0, 0.0]) / np.where(length > 0, length, 1.0)
    return unit


def view_at(square: Array) -> Array:
    """Local view (..., 3) at a place (..., 2) of the square, its cosine at least 1e-4."""
    view = _view(np.max(np.abs(square), axis=-1), plane_of_view(square))
    return np.where(np.any(square != 0, axis=-1, keepdims=True), view, [0.0, 0.0, 1.0])


def _view(radius: Array, plane: Array) -> Array:
    cosine = radius_cosine(radius)[..., None]
    return np.concatenate([plane * np.sqrt(1 - cosine**2), cosine], axis=-1)


def nearest_view(omega_o: npt.ArrayLike, *, is_round: bool) -> Array:
    """Local view of the nearest row of a table by view, its cosine at least 1e-4; (..., 3).

    Round lobes have rows for radii alone: the azimuth stays. Brushed ones have rows for a grid over half of a
    square.
    """
    omega_o = as_array(omega_o)
    square, side = half_square(omega_o)
    if not is_round:
        return view_at(side * (np.floor(square * (VIEW_NODES - 1) + 0.5) / (VIEW_NODES - 1)))
    radius = np.floor(view_radius(omega_o[..., 2]) * (TABLE_ROWS - 1) + 0.5) / (TABLE_ROWS - 1)
    return _view(radius, plane_of_view(omega_o))
