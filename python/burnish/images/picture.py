"""One door for every picture file: the first bytes decide, never the name."""

import os
import stat
import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from burnish._core import read_hdr
from burnish.images import exr_header
from burnish.images.display import srgb_decode
from burnish.images.exr import read_exr
from burnish.images.files import file_error, require_pixels


@dataclass
class Picture:
    """A picture and what its file says about it."""

    pixels: NDArray[np.float32]
    """(h, w, 3) or (h, w, 4), linear Rec. 709."""
    format: str
    """"OpenEXR", "Radiance", "PNG" or "JPEG"."""
    envmap: int | None = None
    """OpenEXR's attribute of that name: `exr_header.LATLONG`, `exr_header.CUBE` or None."""

    @property
    def is_high_dynamic_range(self) -> bool:
        """Whether the format can hold radiance above 1."""
        return self.format in ("OpenEXR", "Radiance")


# Deflate packs at most so many bytes into one.
_DEFLATE_RATIO = 1032


def _require_data(path: str | os.PathLike[str], file: Image.Image) -> None:
    """Refuse a PNG that is too short for its size: Pillow would make a black picture of it, however large."""
    least_bytes = file.height * (1 + file.width / 8)  # a bit a pixel, a filter a row
    size = os.path.getsize(path)
    if size * _DEFLATE_RATIO < least_bytes:
        raise file_error(
            path, f"PNG: expected data for {file.width} x {file.height} pixels, got {size} bytes"
        )


def _read_display_referred(path: str | os.PathLike[str], name: str) -> NDArray[np.float32]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Pillow warns of sizes that are checked here, and of broken Exif
            with Image.open(path, formats=[name]) as file:
                require_pixels(path, name, file.height, file.width)
                if name == "PNG":
                    _require_data(path, file)
                picture: Image.Image = file
                largest = 65535 if picture.mode.startswith("I") else 255
                if largest == 255:
                    has_alpha = "A" in picture.getbands() or "transparency" in picture.info
                    picture = picture.convert("RGBA" if has_alpha else "RGB")
                encoded = np.asarray(picture)
    except Exception as error:  # every Pillow plugin raises its own kinds
        if isinstance(error, FileNotFoundError | PermissionError) or str(error).startswith(os.fspath(path)):
            raise
        raise file_error(path, f"{name} cannot be decoded, it is damaged or too large ({error})") from error
    if encoded.ndim == 2:
        encoded = np.repeat(encoded[..., None], 3, axis=2)
    shares = np.arange(largest + 1, dtype=np.float32) / np.float32(largest)
    pixels: NDArray[np.float32] = shares[encoded]
    pixels[..., :3] = srgb_decode(shares)[encoded[..., :3]]
    return pixels


def read_picture(path: str | os.PathLike[str]) -> Picture:
    """Read a picture together with what its file says about it.

    Parameters
    ----------
    path : path
        OpenEXR, Radiance, PNG or JPEG, by its first bytes.

    Returns
    -------
    picture : Picture

    Raises
    ------
    FileError
        If there is no such file, or it is none of these, damaged, or declares more than it can hold.
    """
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise file_error(path, "expected a file, got something else")
        with open(path, "rb") as stream:
            start = stream.read(8)
    except FileNotFoundError as error:
        raise file_error(path, "expected a file, found none") from error
    except PermissionError as error:
        raise file_error(path, "expected a readable file, permission denied") from error
    if start.startswith(exr_header.MAGIC):
        pixels, envmap = read_exr(path)
        return Picture(pixels, "OpenEXR", envmap)
    if start.startswith(b"#?"):
        return Picture(read_hdr(os.fspath(path)), "Radiance")
    if start.startswith(b"\x89PNG\r\n\x1a\n"):
        return Picture(_read_display_referred(path, "PNG"), "PNG")
    if start.startswith(b"\xff\xd8\xff"):
        return Picture(_read_display_referred(path, "JPEG"), "JPEG")
    shown = start.hex(" ") if start else "an empty file"
    raise file_error(path, f"expected an OpenEXR, Radiance, PNG or JPEG picture, got {shown}")


def read_image(path: str | os.PathLike[str]) -> NDArray[np.float32]:
    """Read a picture as linear radiance.

    Parameters
    ----------
    path : path
        OpenEXR, Radiance, PNG or JPEG, by its first bytes; sRGB is decoded.

    Returns
    -------
    pixels : (h, w, 3) or (h, w, 4) float32
        Linear Rec. 709, top row first; four channels where the file has alpha. NaN and infinities are kept.

    Raises
    ------
    FileError
        If there is no such file, or it is none of these, damaged, or declares more than it can hold.
    """
    return read_picture(path).pixels
