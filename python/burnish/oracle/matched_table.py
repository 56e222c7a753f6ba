"""The tables of `matched`: small Gaussian mixtures fitted to elliptic lobes, one table a density."""

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
#: Rows of the lobes with tails, every third of those aspects.
STUDENT_STEP = 3
#: Windows R of the density (1 + r^2)^-2 exp(-r^2/(2 R^2)) that the mixtures of such lobes are fitted to: of
#: wide lobes the tail lies below the horizon, and samples there would be lost.
STUDENT_WINDOWS = (math.inf, 2.7, 1.4)
#: Of Student's density, what they leave.
STUDENT_SHARES = (1.0, 0.8406213, 0.6614072)
#: Widths up to which lobes take the first windows, as float32 has them.
STUDENT_WIDTHS = (0.25, float(np.float32(0.4)))
#: Where `fit_matched` writes them.
TABLE_PATH = Path(__file__).parent.parent / "tables" / "matched.txt"
STUDENT_PATH = TABLE_PATH.with_name("student.txt")
#: Of the committed files; the one place that knows them.
TABLE_SHA256 = {
    TABLE_PATH: "b2106b8a93dc66a7a132c70776ded058690b7c49afa3779b7551469fd5cb1ec7",
    STUDENT_PATH: "b79e22d285ed92ea1507cd9d563c17cf017ec51c039711bf102487cd0e15ff8e",
}


@dataclass(frozen=True)
class Mixture:
    """All samples of a mixture, (..., n) each: centre, width in units of the minor axis, weight."""

    y1: Array  # along the major axis, in its unit
    y2: Array
    s: Array
    w: Array


def _read_tables(path: Path, aspects: int, tables: int) -> list[dict[int, Array]]:
    text = path.read_text(encoding="ascii").splitlines()
    numbers = np.array([line.rstrip(",").split(",") for line in text if not line.startswith("//")], float)
    result: list[dict[int, Array]] = []
    start = 0
    for _ in range(tables):
        result.append({})
        for count in COUNTS:
            half = (count + 1) // 2
            result[-1][count] = numbers[start : start + aspects * half].reshape(aspects, half, 4)
            start += aspects * half
    if start != len(numbers):
        raise ValueError(f"{path}: expected {start} rows, got {len(numbers)}")
    return result


@lru_cache(maxsize=1)
def load_table() -> dict[int, Array]:
    """Rows y1, y2, s, w of the half-samples of Gaussian lobes, (ASPECT_COUNT, half, 4) for each count."""
    return _read_tables(TABLE_PATH, ASPECT_COUNT, 1)[0]


@lru_cache(maxsize=1)
def load_student_tables() -> list[dict[int, Array]]:
    """The same of lobes of Student's density, one table a window, every STUDENT_STEP-th aspect."""
    aspects = (ASPECT_COUNT - 1) // STUDENT_STEP + 1
    return _read_tables(STUDENT_PATH, aspects, len(STUDENT_WINDOWS))


def student_window(width: float) -> int:
    """Which of STUDENT_WINDOWS serves lobes of this greater width."""
    return sum(width > most for most in STUDENT_WIDTHS)


def window_ratio(width: float, r2: Array) -> Array:
    """Student's density over what the mixtures of such lobes stand for: Z exp(min(r^2/(2 R^2), 2.5)).

    Z = 1 - a e^a E1(a), a = 1/(2 R^2), is the part of Student's density that the window leaves.
    """
    index = student_window(width)
    a = 0.5 / STUDENT_WINDOWS[index] ** 2
    return STUDENT_SHARES[index] * np.exp(np.minimum(a * r2, 2.5))


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
    rows : (aspects, half, 4)
    rho : (...)
        At least 1; beyond the last row that row serves.
    """
    rho = as_array(rho)
    last = len(rows) - 1
    at = np.clip(np.log(np.maximum(rho, 1.0)) * (last / math.log(LARGEST_ASPECT)), 0, last)
    low = np.minimum(at.astype(np.int64), last - 1)
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
