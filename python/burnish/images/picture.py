"""One door for every picture file: the first bytes decide, never the name."""

import warnings

import numpy as np
from numpy.typing import NDArray

from burnish.images import exr_header, png_chunks
from burnish.images.display_referred import read_jpeg, read_png
from burnish.images.exr import read_exr_picture
from burnish.images.files import file_error
from burnish.images.pixels import Picture
from burnish.images.radiance import read_radiance
from burnish.images.source import PictureFile, Source, open_source

__all__ = ["Picture", "read_image", "read_picture"]


def _require_one_picture(format: str, part: str | int | None, layer: str | None) -> None:
    for name, value in (("part", part), ("layer", layer)):
        if value is not None:
            raise ValueError(
                f"{name}: expected None for a {format} file, which has one picture, got {value!r}"
            )


def read_picture(
    path: PictureFile | Source, part: str | int | None = None, layer: str | None = None
) -> Picture:
    """Read a picture together with what its file says about it.

    ``help(burnish.images)`` has a table of the fields of each format, and what becomes of them.

    Parameters
    ----------
    path : path, bytes, or binary file object
        OpenEXR, Radiance, PNG or JPEG, by its first bytes. An open file is read from where it stands to its
        end.
    part : str, int or None
        Name, view or index of a part of an OpenEXR file. None: the first that is a picture.
    layer : str or None
        What stands before the last dot of an OpenEXR file's channels, empty for those without one. None: the
        channels without a layer, or the only layer of colour.

    Returns
    -------
    picture : Picture

    Raises
    ------
    FileError
        If there is no such file, or it is none of these, damaged, or declares more than it can hold.
    ValueError
        If `path` is none of these, or there is no such part or layer.
    """
    source = open_source(path)
    start = source.head(8)
    if start.startswith(exr_header.MAGIC):
        return read_exr_picture(source, part, layer)
    for magic, format, read in (
        (b"#?", "Radiance", read_radiance),
        (png_chunks.MAGIC, "PNG", read_png),
        (b"\xff\xd8\xff", "JPEG", read_jpeg),
    ):
        if start.startswith(magic):
            _require_one_picture(format, part, layer)
            return read(source)
    shown = start.hex(" ") if start else "an empty file"
    raise file_error(source.name, f"expected an OpenEXR, Radiance, PNG or JPEG picture, got {shown}")


def read_image(
    path: PictureFile, part: str | int | None = None, layer: str | None = None
) -> NDArray[np.float32]:
    """Read a picture as linear radiance.

    Parameters
    ----------
    path : path, bytes, or binary file object
        OpenEXR, Radiance, PNG or JPEG, by its first bytes. An open file is read from where it stands to its
        end.
    part : str, int or None
        Name, view or index of a part of an OpenEXR file. None: the first that is a picture.
    layer : str or None
        Layer of an OpenEXR file, as `read_picture` takes it.

    Returns
    -------
    pixels : (h, w, 3) or (h, w, 4) float32
        Linear Rec. 709, top row first; four channels where the file has alpha. NaN and infinities are kept.

    Raises
    ------
    FileError
        If there is no such file, or it is none of these, damaged, or declares more than it can hold.
    ValueError
        If `path` is none of these, or there is no such part or layer.

    Warns
    -----
    UserWarning
        For what the file says that would change the picture and is not used; `read_picture` lists it.
    """
    source = open_source(path)
    picture = read_picture(source, part, layer)
    for sentence in picture.ignored:
        warnings.warn(f"{source.name}: {sentence}", UserWarning, stacklevel=2)
    return picture.pixels
