"""Colours of other primaries and white points, turned into linear Rec. 709."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Float64 = NDArray[np.float64]

REC_709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
"""Chromaticities x, y of red, green, blue and white (ITU-R BT.709)."""
AP0 = (0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.077, 0.32168, 0.33767)
"""ACES2065-1 (SMPTE ST 2065-1)."""
AP1 = (0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767)
"""ACEScg (S-2014-004)."""
REC_2020 = (0.708, 0.292, 0.17, 0.797, 0.131, 0.046, 0.3127, 0.3290)
P3_D65 = (0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.3127, 0.3290)
ADOBE_RGB = (0.64, 0.33, 0.21, 0.71, 0.15, 0.06, 0.3127, 0.3290)

D50 = (0.9642, 1.0, 0.8249)
"""White of ICC's connection space, XYZ."""

# Files round chromaticities to three digits or more; within that they are the same.
_SAME = 1e-3
_BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
_NAMES = {
    "Rec. 709": REC_709,
    "ACES2065-1 (AP0)": AP0,
    "ACEScg (AP1)": AP1,
    "Rec. 2020": REC_2020,
    "P3 with white D65": P3_D65,
    "Adobe RGB": ADOBE_RGB,
}
_ROWS_AT_ONCE = 256


def are_same(one: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two sets of chromaticities agree as far as files are exact."""
    return bool(np.allclose(one, other, rtol=0.0, atol=_SAME))


def describe(chromaticities: Sequence[float]) -> str:
    """Give the name of known primaries, or their numbers."""
    for name, known in _NAMES.items():
        if are_same(chromaticities, known):
            return name
    x = [f"{value:.4g}" for value in chromaticities]
    return f"red {x[0]}, {x[1]}, green {x[2]}, {x[3]}, blue {x[4]}, {x[5]}, white {x[6]}, {x[7]}"


def _white(chromaticities: Sequence[float]) -> Float64:
    x, y = chromaticities[6:8]
    return np.array([x / y, 1.0, (1.0 - x - y) / y])


def xyz_from_rgb(chromaticities: Sequence[float]) -> Float64:
    """Give the matrix from linear RGB of these primaries to CIE XYZ, white having Y = 1.

    The columns are the primaries, scaled so that they add up to the white point (SMPTE RP 177). A primary of
    y = 0 is allowed, as CIE XYZ itself has it.

    Raises
    ------
    ValueError
        If the primaries are not finite, lie on a line, or do not have the white point between them.
    """
    values = np.asarray(chromaticities, np.float64)
    if values.shape != (8,) or not np.isfinite(values).all() or np.abs(values).max() > 4.0:
        raise ValueError(f"chromaticities: expected eight numbers in -4..4, got {list(chromaticities)}")
    x, y = values[0:6:2], values[1:6:2]
    primaries = np.array([x, y, 1.0 - x - y])
    if values[7] < 1e-3 or abs(np.linalg.det(primaries)) < 1e-4:
        raise ValueError(f"chromaticities: expected a triangle and a white point, got {list(chromaticities)}")
    scales = np.linalg.solve(primaries, _white(values.tolist()))
    if not (scales > 0.0).all():
        raise ValueError(f"chromaticities: expected white inside the triangle, got {list(chromaticities)}")
    return np.asarray(primaries * scales)


def adaptation(from_white: Sequence[float] | Float64, to_white: Sequence[float] | Float64) -> Float64:
    """Give the Bradford matrix that turns XYZ under one white (XYZ) into those under another."""
    cones = _BRADFORD @ np.asarray(to_white) / (_BRADFORD @ np.asarray(from_white))
    return np.asarray(np.linalg.solve(_BRADFORD, cones[:, None] * _BRADFORD))


def rec709_from_xyz(white: Sequence[float] | None = None) -> Float64:
    """Give the matrix from CIE XYZ to linear Rec. 709, whose white is D65.

    Parameters
    ----------
    white : three floats or None
        XYZ of the white that the values are relative to: adapted to D65 after Bradford. None: nothing is
        adapted.
    """
    adapted = np.eye(3) if white is None else adaptation(white, _white(REC_709))
    return np.asarray(np.linalg.solve(xyz_from_rgb(REC_709), adapted))


def rec709_from_rgb(chromaticities: Sequence[float]) -> Float64 | None:
    """Give the matrix from linear RGB of these primaries to linear Rec. 709; None where they are the same.

    White stays white: the white points are adapted after Bradford.

    Raises
    ------
    ValueError
        As `xyz_from_rgb`.
    """
    matrix = xyz_from_rgb(chromaticities)
    if are_same(chromaticities, REC_709):
        return None
    return np.asarray(rec709_from_xyz(_white(chromaticities).tolist()) @ matrix)


def convert(pixels: NDArray[np.float32], matrix: Float64) -> None:
    """Multiply the first three channels of every pixel by a matrix, in place."""
    for row in range(0, pixels.shape[0], _ROWS_AT_ONCE):
        block = pixels[row : row + _ROWS_AT_ONCE, :, :3]
        with np.errstate(invalid="ignore", over="ignore"):
            block[...] = block.astype(np.float64) @ matrix.T


def convert_to_rec709(pixels: NDArray[np.float32], chromaticities: Sequence[float]) -> str:
    """Turn linear RGB of these primaries into linear Rec. 709, in place.

    Returns
    -------
    text : str
        What was done, for a note; empty where the primaries are those of Rec. 709.

    Raises
    ------
    ValueError
        As `xyz_from_rgb`.
    """
    matrix = rec709_from_rgb(chromaticities)
    if matrix is None:
        return ""
    convert(pixels, matrix)
    return f"{describe(chromaticities)} turned into linear Rec. 709 (Bradford)."
