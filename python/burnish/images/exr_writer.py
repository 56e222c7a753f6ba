"""OpenEXR pictures written through the OpenEXR package."""

import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
import OpenEXR
from numpy.typing import NDArray

from burnish.images.files import file_error, replacing

_HALF_MAX = 65504.0


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
