"""Calibrate the error model: ``python -m burnish.advice.calibration.calibrate`` measures, fits, and writes.

Every sampler shades points that see all of a map under one angle; the truth is the sum over every texel of
the reduced map. Takes some minutes on two cores, most of them compiling; needs scipy (``pip install
burnish[fit]``).
"""

import argparse
import json
import math
import sys
from collections import defaultdict
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import numpy as np

from burnish import _core
from burnish._device import default_device
from burnish._version import __version__
from burnish.advice.calibration.fit_errors import Measured, fit_family
from burnish.advice.contrast import measure_spectrum
from burnish.advice.error_estimate import companion
from burnish.advice.error_model import lobe_features, traits_of_lobe
from burnish.advice.families import FAMILIES, sampler_text
from burnish.advice.reduced_maps import reduce_environment, reduced_face_size
from burnish.advice.truth import extrapolate
from burnish.frame import FloatArray
from burnish.images.files import write_text
from burnish.rendering import shade
from burnish.samplers import sampler_from_text
from burnish.study.calibration_points import WeightedPoints, points_at_angle
from burnish.study.calibration_set import TRAINING_LOBES, training_environments

OUTPUT = Path(__file__).parents[1] / "error_model.json"
COSINES = (0.95, 0.7, 0.4)
POINTS = 150
SEED = 20140620
FINEST_FACE = 128
"""Keeps the sum over every texel affordable; the narrowest lobe of the set needs no more."""

Rows = dict[str, list[Measured]]
Shares = dict[str, list[tuple[int, float]]]


def measure_pair(environment: _core.Environment, lobe: _core.KurtLobe, rows: Rows, shares: Shares) -> None:
    """Measure every candidate on one lobe in one environment.

    Parameters
    ----------
    environment : Environment
        The light.
    lobe : KurtLobe
        The only one of the material.
    rows : dict
        Gets errors by family.
    shares : dict
        Gets (count, log of the error over the difference from the companion) by family.
    """
    material = _core.Material(lobes=[lobe])
    spectrum = measure_spectrum(environment)
    face_size = min(reduced_face_size([material]), FINEST_FACE)
    fine, coarse = (reduce_environment(environment, size) for size in (face_size, face_size // 2))
    width = math.sqrt(2.0 * lobe.roughness[0] * lobe.roughness[1])
    rng = np.random.default_rng(SEED)
    groups = [points_at_angle(environment, width, cosine, POINTS, rng) for cosine in COSINES]

    normals, tangents, views = (
        np.concatenate([getattr(group, name) for group in groups])
        for name in ("normals", "tangents", "views")
    )

    def draw(light: _core.Environment, sampler: Any) -> list[FloatArray]:
        return np.split(shade(light, material, sampler, normals, tangents, views), len(groups))

    quadrature = _core.Reference(method="quadrature")
    truth = [
        extrapolate(a, b, a, np.zeros(len(a), bool))
        for a, b in zip(draw(fine, quadrature), draw(coarse, quadrature), strict=True)
    ]
    for family, settings in FAMILIES.items():
        features = [
            lobe_features(traits_of_lobe(lobe), cosine, spectrum, settings.splits_suns) for cosine in COSINES
        ]
        for count in settings.counts:
            sampler = sampler_from_text(sampler_text(family, count))
            drawn = draw(environment, sampler)
            fewer = draw(environment, companion(sampler))
            for group, feature, color, exact in zip(groups, features, drawn, truth, strict=True):
                rows[family].append(Measured(feature, count, group.relative_rmse(color, exact)))
            own, difference = _total(groups, drawn, truth), _total(groups, drawn, fewer)
            if own > 0 and difference > 0:
                shares[family].append((count, 0.5 * math.log(own / difference)))


def _total(groups: list[WeightedPoints], one: list[FloatArray], other: list[FloatArray]) -> float:
    """Weighted sum of squared differences over all groups."""
    return float(
        sum(
            np.sum((a.astype(np.float64) - b) ** 2, axis=1) @ group.weights
            for group, a, b in zip(groups, one, other, strict=True)
        )
    )


def fit_share(pairs: list[tuple[int, float]]) -> dict[str, float]:
    """Fit the own share of an error as a line over log n, robustly: the median at each count.

    Parameters
    ----------
    pairs : list of (count, log share)
        Of one family.

    Returns
    -------
    line : dict
        ``at_1`` and ``per_log_count`` of the share's logarithm, and ``spread``, its standard deviation.
    """
    counts = sorted({count for count, _ in pairs})
    medians = [float(np.median([value for n, value in pairs if n == count])) for count in counts]
    slope, start = np.polyfit(np.log(counts), medians, 1) if len(counts) > 1 else (0.0, medians[0])
    off = [value - start - slope * math.log(count) for count, value in pairs]
    line = {"at_1": start, "per_log_count": slope, "spread": np.std(off)}
    return {name: round(float(value), 4) for name, value in line.items()}


def main() -> int:
    """Measure, fit, write."""
    parser = argparse.ArgumentParser(
        prog="python -m burnish.advice.calibration.calibrate", description=__doc__
    )
    parser.add_argument(
        "-o", "--output", type=Path, default=OUTPUT, help="where to write (default: in place)"
    )
    options = parser.parse_args()
    rows: Rows = defaultdict(list)
    shares: Shares = defaultdict(list)
    names = []
    for name, make in training_environments().items():
        environment = make()
        names.append(name)
        for lobe_name, lobe in TRAINING_LOBES.items():
            measure_pair(environment, lobe, rows, shares)
            print(f"{name}: {lobe_name}", flush=True)
    device = default_device()
    data: dict[str, Any] = {
        "command": "python -m burnish.advice.calibration.calibrate",
        "date": datetime.now(timezone.utc).date().isoformat(),
        "device": f"{device.name}, {device.driver}",
        "version": __version__,
        "environments": names,
        "lobes": list(TRAINING_LOBES),
        "families": {},
        "spread": {},
        "own_share": {family: fit_share(pairs) for family, pairs in shares.items()},
    }
    for family, measured in rows.items():
        data["families"][family], spread = fit_family(measured)
        data["spread"][family] = round(spread, 3)
        print(f"{family}: predicted over measured, rms of the logarithm: {spread:.3f}")
    write_text(options.output, json.dumps(data, indent=1) + "\n")
    print(f"wrote {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
