"""OpenEXR pictures through the OpenEXR package."""

import contextlib
import io
import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
import OpenEXR
from numpy.typing import NDArray

from burnish.images.exr_header import ExrPart, read_exr_header
from burnish.images.files import file_error, replacing

_HALF_MAX = 65504.0


def _color_names(path: str | os.PathLike[str], part: ExrPart) -> list[str]:
    """Names of the channels that make red, green, blue and perhaps alpha; a missing colour is an empty
    name.
    """
    names = [channel.name for channel in part.channels]
    prefix = ""
    if not {"R", "G", "B", "Y"} & set(names):
        layers = sorted({n[: n.rindex(".") + 1] for n in names if n.endswith((".R", ".G", ".B"))})
        if len(layers) != 1:
            raise file_error(
                path, f"expected channels R, G, B or Y, or one layer of them, got {', '.join(names)}"
            )
        prefix = layers[0]
    if {"RY", "BY"} & set(names):
        raise file_error(
            path, "expected RGB or Y, got luminance-chroma channels (Y, RY, BY); convert the file to RGB"
        )
    if "Y" in names and not {"R", "G", "B"} & set(names):
        color = ["Y", "Y", "Y"]
    else:
        color = [prefix + c if prefix + c in names else "" for c in "RGB"]
    if prefix + "A" in names:
        color.append(prefix + "A")
    for channel in part.channels:
        if channel.name in color and channel.sampling != (1, 1):
            raise file_error(path, f"channel {channel.name}: expected sampling 1, 1, got {channel.sampling}")
    return color


def _decode(path: str | os.PathLike[str]) -> dict[str, NDArray[Any]]:
    """Level 0 of every channel of the first part."""
    printed = io.StringIO()  # where samples are damaged the package prints a warning and returns no part
    try:
        with (
            contextlib.redirect_stdout(printed),
            OpenEXR.File(os.fspath(path), separate_channels=True) as file,
        ):
            if file.parts:
                return {name: channel.pixels for name, channel in file.parts[0].channels.items()}
    except Exception as error:  # the package raises what its C++ side throws, UnicodeDecodeError included
        raise file_error(path, f"expected a sound OpenEXR file, the library says: {error}") from error
    said = " ".join(printed.getvalue().split()) or "no samples"
    raise file_error(path, f"expected all its samples, some are damaged or missing ({said})")


def _to_display_window(part: ExrPart, pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Crop to the display window, and fill with zeros what it has beyond the data window."""
    if part.display_window == part.data_window:
        return pixels
    x0, y0, x1, y1 = part.display_window
    left, top, right, bottom = part.data_window
    shown = np.zeros((y1 - y0 + 1, x1 - x0 + 1, pixels.shape[2]), np.float32)
    low_x, low_y, high_x, high_y = max(x0, left), max(y0, top), min(x1, right) + 1, min(y1, bottom) + 1
    if low_x < high_x and low_y < high_y:
        shown[low_y - y0 : high_y - y0, low_x - x0 : high_x - x0] = pixels[
            low_y - top : high_y - top, low_x - left : high_x - left
        ]
    return shown


def read_exr(path: str | os.PathLike[str]) -> tuple[NDArray[np.float32], int | None]:
    """Read the first part of an OpenEXR file.

    Half, float and uint samples, scan lines and tiles (level 0), any compression the OpenEXR package knows. A
    missing colour is 0; luminance alone gives grey. The picture is what the display window shows, 0 where
    there is no data; environment maps, marked by the attribute envmap, are their data window.

    Parameters
    ----------
    path : path
        Any name; the magic number decides.

    Returns
    -------
    pixels : (h, w, 3) or (h, w, 4) float32
        Linear, as stored: NaN and infinities are kept.
    envmap : int or None
        The attribute: `exr_header.LATLONG`, `exr_header.CUBE`, or None where there is none.

    Raises
    ------
    FileError
        If the file is damaged, deep, luminance-chroma, or declares more than it can hold.
    """
    part = read_exr_header(path)[0]
    names = _color_names(path, part)
    channels = _decode(path)
    height, width = part.size
    pixels = np.zeros((height, width, len(names)), np.float32)
    for i, name in enumerate(names):
        if name:
            if name not in channels or channels[name].shape != (height, width):
                raise file_error(
                    path, f"channel {name}: expected {height} x {width} samples, got none or another shape"
                )
            pixels[..., i] = channels[name]
    return (pixels if part.envmap is not None else _to_display_window(part, pixels)), part.envmap


def _split_channels(image: NDArray[Any] | Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """One two-dimensional array per channel name."""
    layers = image if isinstance(image, Mapping) else {"": image}
    channels: dict[str, NDArray[Any]] = {}
    for key, value in layers.items():
        array = np.asarray(value)
        if array.ndim == 2:
            channels[key or "Y"] = array
        elif array.ndim == 3 and array.shape[2] in (3, 4):
            prefix = "" if key in ("", "RGB", "RGBA") else key + "."
            for i, suffix in enumerate("RGBA"[: array.shape[2]]):
                channels[prefix + suffix] = array[..., i]
        else:
            raise ValueError(
                f"image: expected shape (h, w), (h, w, 3) or (h, w, 4) for {key!r}, got {array.shape}"
            )
    shapes = {array.shape for array in channels.values()}
    if len(shapes) != 1:
        raise ValueError(f"image: expected channels of one size, got {sorted(shapes)}")
    return channels


def _to_half(array: NDArray[Any]) -> NDArray[np.float16]:
    """Round to half; what is finite stays finite."""
    clipped = np.where(np.isfinite(array), np.clip(array, -_HALF_MAX, _HALF_MAX), array)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        return clipped.astype(np.float16)


def write_exr(
    path: str | os.PathLike[str],
    image: NDArray[Any] | Mapping[str, NDArray[Any]],
    metadata: Mapping[str, Any] | None = None,
    half: bool = False,
) -> None:
    """Write an OpenEXR file: scan lines, ZIP.

    Parameters
    ----------
    path : path
        Replaced in one step when all is written.
    image : array or mapping of names to arrays
        (h, w), (h, w, 3) or (h, w, 4). An array alone, or under "RGB" or "RGBA", gives channels R, G, B, A; a
        colour array under another name gives name.R, name.G, ...; a plain (h, w) array gives the channel of
        that name.
    metadata : mapping or None
        Header attributes: text as it is, everything else as JSON text.
    half : bool
        Round to half floats, finite values clamped to their range. Otherwise float32; uint32 arrays stay.

    Raises
    ------
    FileError
        If it cannot be written; a file of that name is then as it was.
    """
    header: dict[str, Any] = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    reserved = {
        *header,
        "channels",
        "dataWindow",
        "displayWindow",
        "lineOrder",
        "pixelAspectRatio",
        "tiles",
        "name",
    }
    for name, value in (metadata or {}).items():
        if not name or name in reserved or name.startswith("screenWindow"):
            raise ValueError(f"metadata: expected names that OpenEXR does not use itself, got {name!r}")
        header[name] = value if isinstance(value, str) else json.dumps(value)
    channels = {}
    for name, array in _split_channels(image).items():
        if half:
            typed: NDArray[Any] = _to_half(array)
        else:
            typed = array if array.dtype == np.uint32 else array.astype(np.float32)
        channels[name] = np.ascontiguousarray(typed)
    with replacing(path) as temporary, OpenEXR.File(header, channels) as file:
        try:
            file.write(temporary)
        except RuntimeError as error:  # the package wraps what the system said
            raise file_error(path, f"cannot be written: {error}") from error
