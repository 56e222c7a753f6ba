"""An error for every pixel without a reference: the picture against one of fewer lookups.

Both pictures err, and the one of fewer lookups errs more. How much of their difference is the picture's own
error, studies have measured for each sampler and count, ``python -m burnish.advice.calibration.calibrate``.
Of a single pixel the difference may vanish by chance; its mean square over the neighbourhood does not.

Both see the same light on diffuse surfaces. The error of that is known from when the light was made
(``Report.diffuse_error``), or is the difference from a picture of the better form.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.advice.error_model import committed_data
from burnish.frame import Frame
from burnish.oracle.matched_table import COUNTS
from burnish.samplers import Sampler, sampler_parameters

FloatArray = NDArray[np.float32]
Float64 = NDArray[np.float64]

RADIUS_PX = 1
"""The neighbourhood is a square of 2 RADIUS_PX + 1 pixels, as far as objects cover it."""

COMPANION_SHARE = 0.65
LEAST_COUNT = 2


def companion(sampler: object) -> _core.Regular | _core.Importance | _core.Matched:
    """Give the sampler that a picture is compared with: the same with about two thirds of the lookups.

    Parameters
    ----------
    sampler : Regular, Importance, Matched or Prefiltered
        Of the picture. A prefiltered map has one lookup: it is compared with ``Matched()``. The smallest
        counts, which have none below, are compared with the next above.

    Raises
    ------
    ValueError
        If it is a reference: that knows its standard error.
    """
    if isinstance(sampler, _core.Prefiltered):
        return _core.Matched(diffuse=sampler.diffuse)
    if isinstance(sampler, _core.Matched):
        counts = [n for n in COUNTS if n <= COMPANION_SHARE * sampler.samples]
        above = [n for n in COUNTS if n > sampler.samples]
        return _core.Matched(counts[-1] if counts else above[0], sampler.diffuse)
    if isinstance(sampler, _core.Importance):
        return _core.Importance(_fewer(sampler.samples), sampler.points, sampler.mip_bias, sampler.diffuse)
    if isinstance(sampler, _core.Regular):
        rest = (sampler.threshold, sampler.footprint, sampler.normalization, sampler.mip_bias)
        return _core.Regular(_fewer(sampler.samples), *rest, sampler.diffuse)
    raise ValueError(
        "error_estimate: expected a sampler with a number of samples, or Prefiltered, got "
        f"{type(sampler).__name__}"
    )


def with_exact_diffuse(sampler: Any) -> Any:
    """Give the sampler with diffuse light by the cube, to see by what the harmonics are off.

    Parameters
    ----------
    sampler : Regular, Importance, Matched or Prefiltered
        Of the picture.

    Returns
    -------
    sampler : of the same kind, or None
        None where it has that form already.
    """
    if getattr(sampler, "diffuse", "cube") == "cube":
        return None
    return type(sampler)(**sampler_parameters(sampler) | {"diffuse": "cube"})


def add_diffuse_errors(
    errors: FloatArray, color: FloatArray, alpha: FloatArray, diffuse_error: float, exact: FloatArray | None
) -> FloatArray:
    """Add the error of the light on diffuse surfaces, which does not depend on the other: in squares.

    Parameters
    ----------
    errors : (h, w) float32
        As `estimate_errors` gives them.
    color : (h, w, 3) float32
        The picture; its diffuse part is at most all of it.
    alpha : (h, w) float32
        Coverage.
    diffuse_error : float
        Relative, of the diffuse light: ``Report.diffuse_error``.
    exact : (h, w, 3) float32 or None
        The picture by `with_exact_diffuse`: what it differs by is the error. None: `diffuse_error` of the
        picture is.

    Returns
    -------
    errors : (h, w) float32
    """
    off = diffuse_error * color.astype(np.float64) if exact is None else color.astype(np.float64) - exact
    squares = np.mean(off**2, axis=-1) * (alpha > 0)
    return np.asarray(np.sqrt(errors.astype(np.float64) ** 2 + squares), np.float32)


def _fewer(count: int) -> int:
    fewer = max(LEAST_COUNT, int(COMPANION_SHARE * count))
    return fewer if fewer < count else count + 1


def own_share(sampler: object) -> float:
    """Share of the difference from its companion that is a sampler's own error, as calibrated.

    Parameters
    ----------
    sampler : Regular, Importance, Matched or Prefiltered
        Counts between and beyond those of the studies follow the same line in log n.
    """
    line = committed_data()["own_share"][type(sampler).__name__.lower()]
    count = getattr(sampler, "samples", 1)
    return float(math.exp(line["at_1"] + line["per_log_count"] * math.log(count)))


def estimate_errors(
    sampler: object, color: FloatArray, fewer: FloatArray, alpha: FloatArray, radius_px: int = RADIUS_PX
) -> FloatArray:
    """Estimate the error of every pixel.

    Parameters
    ----------
    sampler : Regular, Importance, Matched or Prefiltered
        That drew `color`.
    color, fewer : (h, w, 3) float32
        The picture, and that of its `companion`.
    alpha : (h, w) float32
        Coverage; nothing is estimated where it is 0.
    radius_px : int
        Half the width of the neighbourhood.

    Returns
    -------
    errors : (h, w) float32
        Absolute linear radiance, root mean square over the channels.
    """
    covered = np.asarray(alpha > 0, np.float64)
    squares = np.mean((color.astype(np.float64) - fewer) ** 2, axis=-1) * covered
    weights = _box_sum(covered, radius_px)
    means = np.divide(_box_sum(squares, radius_px), weights, out=np.zeros_like(squares), where=weights > 0)
    # The mean over neighbourhoods moves some energy over the rim of objects: the picture keeps its sum.
    smoothed = means * covered
    total = float(smoothed.sum())
    scale = float(squares.sum()) / total if total > 0.0 else 0.0
    return np.asarray(own_share(sampler) * np.sqrt(smoothed * scale), np.float32)


def estimate_frame_errors(
    frame: Frame, sampler: Sampler, draw: Callable[[Sampler], FloatArray]
) -> FloatArray:
    """Estimate the error of every pixel of a frame, that of its diffuse light included.

    Parameters
    ----------
    frame : Frame
        With linear radiance.
    sampler : Regular, Importance, Matched or Prefiltered
        That drew it.
    draw : callable
        Gives the radiance of the same view by another sampler, (h, w, 3) float32.

    Returns
    -------
    errors : (h, w) float32
        Absolute linear radiance, root mean square over the channels.
    """
    errors = estimate_errors(sampler, frame.color, draw(companion(sampler)), frame.alpha)
    diffuse_error = frame.report.diffuse_error
    if diffuse_error > 0.0:
        better = with_exact_diffuse(sampler)
        exact = None if better is None else draw(better)
        errors = add_diffuse_errors(errors, frame.color, frame.alpha, diffuse_error, exact)
    return errors


def _box_sum(values: Float64, radius: int) -> Float64:
    """Sum over the square about each pixel, cut off at the picture's edge."""
    for axis in (0, 1):
        length = values.shape[axis]
        padded = np.insert(np.cumsum(values, axis=axis), 0, 0.0, axis=axis)
        ends = np.minimum(np.arange(length) + radius + 1, length)
        starts = np.maximum(np.arange(length) - radius, 0)
        values = np.take(padded, ends, axis=axis) - np.take(padded, starts, axis=axis)
    return np.maximum(values, 0.0)
