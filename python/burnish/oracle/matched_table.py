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
ASPECT_COUNT = 40
LARGEST_ASPECT = 34.0
#: Where `fit_matched` writes it.
TABLE_PATH = Path(__file__).parent.parent / "tables" / "matched.txt"
#: Of the committed file; the one place that knows it.
TABLE_SHA256 = "8823304dcaef3bbe5bc459cb6a6c540b9f0f8370067cbce5bc5681847d7a95cf"


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


#: Rows that the engine reads, the nearest one: of aspects, evenly in their log; of views, at
#: cos_o = (j/1023)^2.
TABLE_ROWS = 1024
#: Views of brushed lobes, at cos_o = (j/127)^2, and azimuths over half a turn, evenly around a diamond.
BRUSHED_VIEWS = 128
AZIMUTHS = 257
#: Larger aspects are placed at the view itself.
MOST_VIEW_ASPECT = 8.0


def nearest_aspect(rho: npt.ArrayLike) -> Array:
    """Aspect of the row that serves an aspect >= 1."""
    steps = (TABLE_ROWS - 1) / math.log(LARGEST_ASPECT)
    row = np.floor(np.log(np.maximum(as_array(rho), 1.0)) * steps + 0.5)
    aspect: Array = np.exp(np.minimum(row, TABLE_ROWS - 1) / steps)
    return aspect


def nearest_view(omega_o: npt.ArrayLike, *, is_round: bool) -> Array:
    """Local view of the nearest row of a table by view, its cosine at least 1e-4; (..., 3).

    Round lobes have rows for cosines alone: the azimuth stays.
    """
    omega_o = as_array(omega_o)
    last = (TABLE_ROWS if is_round else BRUSHED_VIEWS) - 1
    row = np.floor(np.sqrt(np.clip(omega_o[..., 2], 0, 1)) * last + 0.5)
    cosine = np.clip((row / last) ** 2, 1e-4, 1 - 1e-12)  # a trace of a sine keeps the azimuth
    sine = np.hypot(omega_o[..., 0], omega_o[..., 1])
    # A view along the normal has no azimuth: the first axis serves.
    x = np.where(sine > 0, omega_o[..., 0], 1.0)
    y = np.where(sine > 0, omega_o[..., 1], 0.0)
    if not is_round:
        side = np.where(y < 0, -1.0, 1.0)
        way = (1 - side * x / (np.abs(x) + np.abs(y))) / 2
        corner = 1 - 2 * np.floor(way * (AZIMUTHS - 1) + 0.5) / (AZIMUTHS - 1)
        x, y = side * corner, side * (1 - np.abs(corner))
    scale = np.sqrt(1 - cosine**2) / np.hypot(x, y)
    return np.stack([x * scale, y * scale, cosine], axis=-1)
