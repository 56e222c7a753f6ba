"""What the paper's formulas themselves give, in double precision and without a device.

Equations by their numbers in the paper: 9, 17 and 18 are its estimator, 11 to 13 its pattern.
"""

import math
from typing import Any

import numpy as np

from burnish.environments import Float64
from burnish.oracle.albedo import directional_albedo
from burnish.oracle.arrays import reflect
from burnish.oracle.lobe.kurt import kurt_d
from burnish.oracle.regular_pattern import choose_pattern, sample_pattern

GRAZING_DEGREES = 85.0
WIDEST_PATTERN = 1e-4
"""xi_0 of the estimator's limit: nearly all of the lobe lies inside."""

LIMIT_SAMPLES = 270
COUNTS = (
    # printed count, roughness, xi_0, spacing and circles where the paper names them
    (19, (0.1, 0.1), 0.1, ("s1", 3)),
    (30, (0.1, 0.1), 0.1, ("s2", 3)),
    (14, (0.1, 0.1), 0.2, None),
    (17, (0.2, 0.075), 0.2, None),
    (30, (0.15, 0.15), 0.1, None),
    (270, (0.15, 0.15), 0.01, None),
)
FURNACE_SLOPES = (0.1, 0.3, 0.6)
ENERGY_ALPHAS = (0.0, 0.5, 1.0)
ENERGY_SLOPES = (0.1, 0.3)


def _view(degrees: float) -> Float64:
    angle = math.radians(degrees)
    return np.array([math.sin(angle), 0.0, math.cos(angle)])


def pattern_counts() -> list[dict[str, Any]]:
    """Count the samples of the patterns whose counts the paper prints."""
    rows = []
    for printed, roughness, threshold, named in COUNTS:
        if named is None:
            pattern = choose_pattern(roughness, printed, threshold)
        else:
            spacing, circles = named
            pattern = sample_pattern(roughness, "s1" if spacing == "s1" else "s2", circles, threshold)
        spacing_text = "" if named is None else f", spacing {named[0]}, {named[1]} circles"
        row = {
            "printed": printed,
            "roughness": list(roughness),
            "threshold": threshold,
            "spacing": spacing_text,
        }
        rows.append({**row, "samples": len(pattern)})
    return rows


def estimator_in_furnace(slope: float, degrees: float) -> dict[str, float]:
    """Apply the published estimator under radiance 1 from everywhere, with and without its horizon.

    Parameters
    ----------
    slope : float
        Roughness of an isotropic lobe, r0 = 1, alpha = 0.
    degrees : float
        Between view and normal.

    Returns
    -------
    row : dict
        ``clamped`` and ``printed`` (its pseudo-code, where light from below the surface counts as negative),
        both relative to the exact albedo, which is ``truth``.
    """
    h = choose_pattern((slope, slope), LIMIT_SAMPLES, WIDEST_PATTERN)
    d = kurt_d(h, slope, slope)
    omega_o = _view(degrees)
    cos_i = reflect(omega_o, h)[:, 2]
    truth = float(directional_albedo(omega_o, (slope, slope), 0.0)[0])
    return {
        "slope": slope,
        "degrees": degrees,
        "clamped": float(np.sum(d * np.maximum(cos_i, 0)) / np.sum(d)) / truth,
        "printed": float(np.sum(d * cos_i) / np.sum(d)) / truth,
        "truth": truth,
    }


def grazing_albedos() -> list[dict[str, float]]:
    """Give the share of light that the lobe returns near the horizon, r0 = 1."""
    return [
        {
            "slope": slope,
            "alpha": alpha,
            "degrees": GRAZING_DEGREES,
            "albedo": float(directional_albedo(_view(GRAZING_DEGREES), (slope, slope), alpha)[0]),
        }
        for slope in ENERGY_SLOPES
        for alpha in ENERGY_ALPHAS
    ]


def examine_formulas() -> dict[str, Any]:
    """Collect all of the above as JSON takes it."""
    return {
        "counts": pattern_counts(),
        "furnace": [estimator_in_furnace(slope, 0.0) for slope in FURNACE_SLOPES],
        "horizon": [estimator_in_furnace(0.3, GRAZING_DEGREES)],
        "energy": grazing_albedos(),
    }
