"""Coefficients of the error model from measured errors: least squares in the logarithm."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish.advice.error_model import BANDS, Features, evaluate

Float64 = NDArray[np.float64]

RIDGE = 0.03
"""Pulls coefficients that the data leave free toward their start."""

SCALARS = ("aspect", "aspect_over_count", "width", "fresnel", "alpha", "suns")
LEAST_MEASURED = 3e-4
"""Below, the truth's own error is in the measured one."""


@dataclass(frozen=True)
class Measured:
    """Relative RMSE of one sampler on points of one angle.

    Parameters
    ----------
    features : Features
        Lobe, angle and environment.
    count : int
        Lookups.
    error : float
        Relative RMSE.
    """

    features: Features
    count: int
    error: float


def _unpack(parameters: Float64, is_single: bool) -> dict[str, Any]:
    bands = len(BANDS)
    power = np.zeros(bands) if is_single else parameters[bands : 2 * bands]
    scalars = dict(zip(SCALARS, parameters[2 * bands :].tolist(), strict=True))
    if is_single:
        scalars["aspect_over_count"] = 0.0
    return {"amplitude": parameters[:bands].tolist(), "power": power.tolist(), **scalars}


def _stack(rows: Sequence[Measured]) -> Features:
    names = [field.name for field in fields(Features)]
    return Features(*(np.stack([getattr(row.features, name) for row in rows]) for name in names))


def fit_family(rows: Sequence[Measured]) -> tuple[dict[str, Any], float]:
    """Fit the coefficients of a family.

    Parameters
    ----------
    rows : sequence of Measured
        Of one family. Where all have the same count, nothing is said of its power.

    Returns
    -------
    coefficients : dict
        As `burnish.advice.error_model.evaluate` takes them.
    spread : float
        Root mean square of the logarithm of predicted over measured errors.
    """
    from scipy.optimize import least_squares

    used = [row for row in rows if row.error > LEAST_MEASURED]
    is_single = len({row.count for row in used}) == 1
    bands = len(BANDS)
    start = np.concatenate([np.full(bands, -1.0), np.full(bands, 0.5), [0.2, 0.2, 0.0, 0.0, 0.0, -5.0]])
    low = np.concatenate([np.full(bands, -8.0), np.zeros(bands), [-1.0, 0.0, -2.0, -2.0, -2.0, -9.0]])
    high = np.concatenate([np.full(bands, 4.0), np.full(bands, 2.0), [2.0, 20.0, 2.0, 2.0, 4.0, 0.0]])

    features, counts = _stack(used), np.array([float(row.count) for row in used])
    measured = np.log([row.error for row in used])

    def residuals(parameters: Float64) -> Float64:
        square, left = evaluate(_unpack(parameters, is_single), features, counts)
        values = 0.5 * np.log(np.maximum(square, 1e-20) / left) - measured
        return np.concatenate([values, RIDGE * math.sqrt(len(used)) * (parameters - start)])

    fit = least_squares(residuals, start, bounds=(low, high), loss="soft_l1", f_scale=0.3, max_nfev=60)
    spread = float(np.sqrt(np.mean(residuals(fit.x)[: len(used)] ** 2)))
    return _unpack(np.round(fit.x, 4), is_single), spread
