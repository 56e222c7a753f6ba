"""What a screen shows of linear radiance."""

import numpy as np
import numpy.typing as npt

from .arrays import Array, IntArray, as_array


def srgb_encode(linear: npt.ArrayLike) -> Array:
    """Encode values in [0, 1] by the curve of IEC 61966-2-1."""
    linear = as_array(linear)
    bright = 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    result: Array = np.where(linear <= 0.0031308, 12.92 * linear, bright)
    return result


def display_pixel(color: npt.ArrayLike, scale: float) -> IntArray:
    """Four codes, 0..255: red, green and blue scaled, clipped and encoded, and coverage.

    Parameters
    ----------
    color : (..., 4)
        Linear radiance, and coverage in [0, 1].
    """
    color = as_array(color)
    encoded = srgb_encode(np.clip(color[..., :3] * scale, 0, 1))
    codes: IntArray = np.rint(255 * np.concatenate([encoded, color[..., 3:]], axis=-1)).astype(np.int64)
    return codes
