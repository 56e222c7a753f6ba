"""Whole pictures side by side: how far they differ, and what they were when they differ too much."""

import re
from pathlib import Path

import numpy as np

OUTPUT = Path(__file__).resolve().parents[1] / "output"


def relative_rmse(actual, expected):
    """Root mean square of the difference over that of the expected radiance."""
    actual, expected = np.asarray(actual, np.float64), np.asarray(expected, np.float64)
    return float(np.sqrt(np.sum((actual - expected) ** 2) / np.sum(expected**2)))


def write_pictures(name, actual, expected):
    """Write both pictures and their difference as EXR, and as PNG exposed alike; the folder they lie in."""
    from burnish import images

    folder = OUTPUT / re.sub(r"[^\w.-]+", "_", name)
    folder.mkdir(parents=True, exist_ok=True)
    mean = float(np.mean(np.abs(expected))) or 1.0
    stops = float(np.log2(0.2 / mean))
    # The difference is shown 100 times as bright as the pictures: grey is 0, brighter is too much.
    shown = {
        "actual": (np.asarray(actual, np.float32), stops),
        "expected": (np.asarray(expected, np.float32), stops),
        "difference": (np.asarray(actual, np.float32) - np.asarray(expected, np.float32), None),
    }
    for part, (picture, exposure) in shown.items():
        images.write_exr(folder / f"{part}.exr", {"RGB": np.ascontiguousarray(picture)})
        if exposure is None:
            picture, exposure = 0.2 + 20 * picture / mean, 0.0
        picture = np.nan_to_num(np.ascontiguousarray(picture, np.float32))
        images.write_png(folder / f"{part}.png", picture, exposure=exposure)
    return folder


def assert_pictures_match(actual, expected, name, rmse, outlier=None, outlier_share=0.0, where=None):
    """Fail, with both pictures written, unless they agree.

    Parameters
    ----------
    actual, expected : (h, w, 3)
        Linear radiance.
    name : str
        Of the folder in tests/output that a failure fills.
    rmse : float
        Largest relative root mean square error.
    outlier : float, optional
        A pixel is an outlier if a channel is off by more than this many mean radiances.
    outlier_share : float
        Largest share of outliers among the pixels compared.
    where : (h, w) bool, optional
        The pixels that are compared.
    """
    actual, expected = np.asarray(actual), np.asarray(expected)
    assert actual.shape == expected.shape, f"{name}: expected shape {expected.shape}, got {actual.shape}"
    where = np.ones(actual.shape[:2], bool) if where is None else where
    a, e = actual[where].astype(np.float64), expected[where].astype(np.float64)
    failures = []
    if not np.isfinite(a).all():
        failures.append(f"{np.sum(~np.isfinite(a).all(axis=-1))} pixels are not finite")
    error = relative_rmse(np.nan_to_num(a), e)
    if error > rmse:
        failures.append(f"relative RMSE {error:.3g} exceeds {rmse:g}")
    if outlier is not None:
        off = np.abs(np.nan_to_num(a) - e).max(axis=-1) > outlier * np.abs(e).mean()
        if off.mean() > outlier_share:
            failures.append(
                f"{off.sum()} of {len(off)} pixels are off by more than {outlier:g} mean radiances, "
                f"allowed are {outlier_share:g} of them"
            )
    if failures:
        folder = write_pictures(name, np.where(where[..., None], actual, 0), expected)
        raise AssertionError(f"{name}: {'; '.join(failures)}; pictures are in {folder}")
    return error
