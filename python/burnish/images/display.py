"""Linear radiance to what a screen shows, and back."""

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from burnish.images.files import replacing


def srgb_encode(linear: NDArray[Any]) -> NDArray[np.float32]:
    """Encode values in [0, 1] by the curve of IEC 61966-2-1."""
    linear = np.asarray(linear, np.float32)
    bright = 1.055 * np.power(np.maximum(linear, 0.0031308), np.float32(1 / 2.4)) - 0.055
    return np.where(linear <= 0.0031308, 12.92 * linear, bright).astype(np.float32)


def srgb_decode(encoded: NDArray[Any]) -> NDArray[np.float32]:
    """Decode values in [0, 1]: the inverse of `srgb_encode`."""
    encoded = np.asarray(encoded, np.float32)
    bright = np.power((encoded + 0.055) / 1.055, np.float32(2.4))
    return np.where(encoded <= 0.04045, encoded / 12.92, bright).astype(np.float32)


def display_image(linear: NDArray[Any], exposure: float = 0.0) -> NDArray[np.uint8]:
    """Turn linear radiance into 8-bit sRGB: exposure, clip, encode, round.

    Parameters
    ----------
    linear : (h, w), (h, w, 3) or (h, w, 4) array
        Linear Rec. 709 radiance. A fourth channel is coverage and is only clipped. NaN shows black, +inf
        white.
    exposure : float
        Stops: colours are multiplied by 2**exposure first.

    Returns
    -------
    pixels : uint8 array of the same shape
    """
    linear = np.asarray(linear, np.float32)
    if linear.ndim not in (2, 3) or (linear.ndim == 3 and linear.shape[2] not in (3, 4)):
        raise ValueError(f"linear: expected shape (h, w), (h, w, 3) or (h, w, 4), got {linear.shape}")
    has_alpha = linear.ndim == 3 and linear.shape[2] == 4
    color = linear[..., :3] if has_alpha else linear
    with np.errstate(over="ignore", invalid="ignore", under="ignore"):
        scaled = np.nan_to_num(color * np.float32(2.0**exposure), nan=0.0, posinf=1.0, neginf=0.0)
        encoded = srgb_encode(np.clip(scaled, 0.0, 1.0))
        if has_alpha:
            alpha = np.clip(np.nan_to_num(linear[..., 3:], nan=0.0), 0.0, 1.0)
            encoded = np.concatenate([encoded, alpha], axis=2)
        pixels: NDArray[np.uint8] = np.rint(encoded * 255.0).astype(np.uint8)
        return pixels


def write_png(path: str | os.PathLike[str], image: NDArray[Any], exposure: float = 0.0) -> None:
    """Write linear radiance as an 8-bit sRGB PNG.

    Parameters
    ----------
    path : path
        Replaced in one step when all is written.
    image : (h, w), (h, w, 3) or (h, w, 4) array
        As `display_image` takes it; uint8 arrays are written as they are.
    exposure : float
        Stops.

    Raises
    ------
    FileError
        If it cannot be written; a file of that name is then as it was.
    """
    pixels = image if image.dtype == np.uint8 else display_image(image, exposure)
    picture = Image.fromarray(np.ascontiguousarray(pixels))
    with replacing(path) as temporary:
        picture.save(temporary, format="PNG")
