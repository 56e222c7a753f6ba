"""How far a picture is from its reference, on four scales. Only what objects cover counts."""

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish.frame import relative_rmse
from burnish.images.display import srgb_encode
from burnish.study.extras import missing_extra

FloatArray = NDArray[np.float32]
Mask = NDArray[np.bool_]

DISPLAY_PERCENTILE = 98.0
"""Share of the reference's values, in percent, that a display shows unclipped (CGI 2014, section 6)."""

WORST_PIXELS = 1e-3
"""Share of the pixels, one at least, that are the worst ones of `error_tail`."""


@dataclass(frozen=True)
class Errors:
    """Errors of one picture; None where a scale does not apply.

    Parameters
    ----------
    relative_rmse : float
        Of linear radiance, relative to the reference's root mean square.
    display_rms : float
        Of the displayed picture, 0..1; see `display_rms`.
    flip : float or None
        Mean FLIP, 0..1. None for points, which have no neighbours, and without the package flip-evaluator.
    max_error : float
        Largest difference of any value, relative to the reference's root mean square.
    worst_share : float
        Share, 0..1, of the squared error that the worst .1 % of the pixels have; see `error_tail`.
    trimmed_rmse : float
        `relative_rmse` without those pixels.
    """

    relative_rmse: float
    display_rms: float
    flip: float | None
    max_error: float
    worst_share: float
    trimmed_rmse: float

    def as_dict(self) -> dict[str, float | None]:
        """Give the fields by name."""
        return asdict(self)


def display_scale(reference: FloatArray) -> float:
    """Factor that puts the 98th percentile of the reference at 1.

    Parameters
    ----------
    reference : (..., 3) float32
        Linear radiance; the percentile is taken over the values of all channels together.

    Returns
    -------
    scale : float
        1 where the percentile is not positive: a black picture stays black.
    """
    if np.size(reference) == 0:
        return 1.0
    level = float(np.percentile(np.asarray(reference, np.float64), DISPLAY_PERCENTILE))
    return 1.0 / level if level > 0.0 else 1.0


def display_values(color: FloatArray, scale: float) -> FloatArray:
    """Scale linear radiance and clip it to 0..1, as a linear display shows it."""
    shown = np.clip(np.asarray(color, np.float64) * scale, 0.0, 1.0)
    return shown.astype(np.float32)


def display_rms(color: FloatArray, reference: FloatArray) -> float:
    """Root mean square error of the displayed picture, as the CGI 2014 paper measures it.

    Both are scaled so that the reference's 98th percentile is 1, clipped to 0..1, and compared; no gamma.

    Parameters
    ----------
    color, reference : (..., 3) float32
        Linear radiance, equal shapes.

    Returns
    -------
    error : float in 0..1
        NaN when there are no values.
    """
    if np.size(reference) == 0:
        return float("nan")
    scale = display_scale(reference)
    difference = display_values(color, scale).astype(np.float64) - display_values(reference, scale)
    return float(np.sqrt(np.mean(difference**2)))


def max_error(color: FloatArray, reference: FloatArray) -> float:
    """Largest difference of any value, relative to the reference's root mean square.

    Parameters
    ----------
    color, reference : (..., 3) float32
        Linear radiance, equal shapes.

    Returns
    -------
    error : float
        NaN when the reference is empty or black.
    """
    truth = np.asarray(reference, np.float64)
    scale = float(np.sqrt(np.mean(truth**2))) if truth.size else 0.0
    if scale == 0.0:
        return float("nan")
    return float(np.max(np.abs(np.asarray(color, np.float64) - truth))) / scale


def error_tail(color: FloatArray, reference: FloatArray) -> tuple[float, float]:
    """Tell how much of an error the worst .1 % of the pixels own, and what is left without them.

    Parameters
    ----------
    color, reference : (..., 3) float32
        Linear radiance, equal shapes.

    Returns
    -------
    worst_share : float in 0..1
        Of the sum of squared differences; .001 where the error is even, nearly 1 where a pixel owns it. 0
        without any error, NaN when there are no pixels.
    trimmed_rmse : float
        Relative RMSE of linear radiance over all other pixels. NaN when none are left or they are black.
    """
    values, truth = color.reshape(-1, 3), reference.reshape(-1, 3)
    if len(truth) == 0:
        return float("nan"), float("nan")
    squares = np.sum((values.astype(np.float64) - truth) ** 2, axis=1)
    kept = np.argsort(squares, kind="stable")[: len(squares) - max(1, round(WORST_PIXELS * len(squares)))]
    total, rest = float(squares.sum()), float(squares[kept].sum())
    return 1.0 - rest / total if total > 0.0 else 0.0, relative_rmse(values[kept], truth[kept])


def has_flip() -> bool:
    """Whether the package flip-evaluator can be imported."""
    try:
        import flip_evaluator  # noqa: F401
    except ImportError:
        return False
    return True


def flip_map(color: FloatArray, reference: FloatArray, scale: float) -> FloatArray:
    """FLIP of every pixel (Andersson et al. 2020, low dynamic range) on the displayed pictures.

    Parameters
    ----------
    color, reference : (h, w, 3) float32
        Linear radiance.
    scale : float
        As `display_scale` gives it: both are scaled, clipped to 0..1 and encoded as sRGB.

    Returns
    -------
    errors : (h, w) float32 in 0..1
        At FLIP's default distance, 67 pixels per degree.

    Raises
    ------
    ImportError
        Without flip-evaluator, with the command that installs it.
    """
    try:
        import flip_evaluator
    except ImportError as error:
        raise missing_extra("flip-evaluator", "study", "FLIP") from error
    shown = [np.ascontiguousarray(srgb_encode(display_values(image, scale))) for image in (reference, color)]
    errors, _, _ = flip_evaluator.evaluate(*shown, "LDR", True, False, True, {})
    return np.asarray(errors, np.float32).reshape(reference.shape[:2])


def measure_errors(
    color: FloatArray, reference: FloatArray, covered: Mask | None = None, with_flip: bool | None = None
) -> Errors:
    """Measure a picture, or shaded points, on every scale.

    Parameters
    ----------
    color, reference : (h, w, 3) or (n, 3) float32
        Linear radiance, equal shapes.
    covered : (h, w) bool or None
        Pixels that count; usually ``frame.alpha > 0``. None: all.
    with_flip : bool or None
        None: where there are pixels and flip-evaluator is installed.

    Returns
    -------
    errors : Errors
    """
    if color.shape != reference.shape or reference.ndim not in (2, 3) or reference.shape[-1] != 3:
        expected = f"(h, w, 3) or (n, 3) as the reference, {reference.shape}"
        raise ValueError(f"color: expected shape {expected}, got {color.shape}")
    mask = np.ones(reference.shape[:-1], bool) if covered is None else np.asarray(covered, bool)
    if mask.shape != reference.shape[:-1]:
        raise ValueError(f"covered: expected shape {reference.shape[:-1]}, got {mask.shape}")
    values, truth = color[mask], reference[mask]
    if with_flip is None:
        with_flip = has_flip()
    flip: float | None = None
    if with_flip and reference.ndim == 3 and mask.any():
        flip = float(np.mean(flip_map(color, reference, display_scale(truth))[mask], dtype=np.float64))
    return Errors(
        relative_rmse(values, truth),
        display_rms(values, truth),
        flip,
        max_error(values, truth),
        *error_tail(values, truth),
    )


def signed_difference(color: FloatArray, reference: FloatArray, covered: Mask | None = None) -> NDArray[Any]:
    """Signed difference of luminance in displayed units, for false-colour pictures.

    Parameters
    ----------
    color, reference : (h, w, 3) float32
        Linear radiance.
    covered : (h, w) bool or None
        Elsewhere the difference is NaN.

    Returns
    -------
    difference : (h, w) float64
        Positive where the picture is too bright; 1 is the display's white.
    """
    mask = np.ones(reference.shape[:2], bool) if covered is None else covered
    scale = display_scale(reference[mask])
    weights = np.array([0.2126, 0.7152, 0.0722])
    shown = display_values(color, scale).astype(np.float64) - display_values(reference, scale)
    difference: NDArray[Any] = np.where(mask, shown @ weights, np.nan)
    return difference
