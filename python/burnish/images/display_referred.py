"""PNG and JPEG pictures as linear Rec. 709."""

import io
import struct
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from PIL import Image, JpegImagePlugin, PngImagePlugin

from burnish._core import decode_png16
from burnish.images.encoding import jpeg_encoding, png_encoding
from burnish.images.files import file_error, require_pixels
from burnish.images.pixels import Picture
from burnish.images.png_chunks import PngHeader, read_png_chunks
from burnish.images.source import Source

_ORIENTATION = 0x0112
_JPEG_PIXELS_OF_A_BIT = 64 * 64
# What turns the stored picture as Exif's orientation asks.
_TURNS: dict[int, Callable[[NDArray[np.float32]], NDArray[np.float32]]] = {
    2: lambda a: a[:, ::-1],
    3: lambda a: a[::-1, ::-1],
    4: lambda a: a[::-1],
    5: lambda a: a.swapaxes(0, 1),
    6: lambda a: a.swapaxes(0, 1)[:, ::-1],
    7: lambda a: a.swapaxes(0, 1)[::-1, ::-1],
    8: lambda a: a.swapaxes(0, 1)[::-1],
}


def _turn(picture: Picture, exif: bytes) -> None:
    """Turn the picture as its Exif says; broken Exif says nothing."""
    fields = Image.Exif()
    try:
        fields.load(exif)
        orientation = fields.get(_ORIENTATION, 1)
    except Exception:  # of whatever kind the parser raises: it is no part of the picture
        picture.ignored.append(f"{picture.format}: Exif is damaged; an orientation would be in it.")
        return
    if orientation in _TURNS:
        picture.pixels = np.ascontiguousarray(_TURNS[orientation](picture.pixels))
        picture.notes.append(f"{picture.format}: turned as Exif's orientation {orientation} asks.")


def _samples(picture: Image.Image) -> NDArray[np.uint8]:
    """Decode a picture of 8 bits or fewer a channel as grey, RGB or RGBA."""
    has_alpha = "A" in picture.getbands() or "transparency" in picture.info
    if picture.mode != "L" or has_alpha:
        picture = picture.convert("RGBA" if has_alpha else "RGB")
    samples = np.asarray(picture)
    return samples if samples.ndim == 3 else samples[..., None]


def _require_jpeg_data(source: Source, picture: Image.Image) -> None:
    """Refuse a JPEG that is too short for its size: even a coder of arithmetic spends a bit on 64 blocks."""
    if source.size * 8 * _JPEG_PIXELS_OF_A_BIT < picture.height * picture.width:
        raise file_error(
            source.name,
            f"JPEG: expected data for {picture.width} x {picture.height} pixels, got {source.size} bytes",
        )


def _decode(
    source: Source, name: str, open_picture: Callable[[], Image.Image]
) -> tuple[NDArray[np.uint8], Image.Image]:
    """Decode by Pillow.

    Its plugins are opened themselves: ``Image.open`` would warn of sizes that are checked here, and keeping a
    warning quiet changes all threads.
    """
    try:
        picture = open_picture()
        require_pixels(source.name, name, picture.height, picture.width)
        if name == "JPEG":
            _require_jpeg_data(source, picture)
        return _samples(picture), picture
    except Exception as error:  # every Pillow plugin raises its own kinds
        if str(error).startswith(source.name):
            raise
        raise file_error(
            source.name, f"{name} cannot be decoded, it is damaged or too large ({error})"
        ) from error


def _note_png(picture: Picture, header: PngHeader) -> None:
    chunks = header.chunks
    if len(chunks.get("pHYs", b"")) == 9:
        x, y = struct.unpack(">II", chunks["pHYs"][:8])
        if x != y:
            picture.ignored.append(f"PNG: pHYs {x} x {y} is not applied: pixels are square.")
    if "acTL" in chunks:
        picture.notes.append("PNG: an animation, of which the first picture is read.")


def read_png(source: Source) -> Picture:
    """Read a PNG of any colour type and depth; `read_picture` says what it raises."""
    data = source.read()
    header = read_png_chunks(source, data)
    encoding = png_encoding(source, header.chunks)
    if header.bits == 16:
        try:
            samples: NDArray[np.uint8] | NDArray[np.uint16] = decode_png16(data, source.name)
        except MemoryError as error:
            size = f"{header.width} x {header.height}"
            raise file_error(source.name, f"expected memory for {size} pixels, got none") from error
    else:
        samples, _ = _decode(source, "PNG", lambda: PngImagePlugin.PngImageFile(io.BytesIO(data)))
    picture = Picture(encoding.decode(samples), "PNG", None, encoding.notes, encoding.ignored)
    _note_png(picture, header)
    if "eXIf" in header.chunks:
        _turn(picture, header.chunks["eXIf"])
    return picture


def read_jpeg(source: Source) -> Picture:
    """Read a JPEG; `read_picture` says what it raises."""
    stream = io.BytesIO(source.read())
    samples, file = _decode(source, "JPEG", lambda: JpegImagePlugin.JpegImageFile(stream))
    is_cmyk = file.mode == "CMYK"
    encoding = jpeg_encoding(None if is_cmyk else file.info.get("icc_profile"))
    picture = Picture(encoding.decode(samples), "JPEG", None, encoding.notes, encoding.ignored)
    if is_cmyk:
        picture.ignored.append(
            "JPEG: CMYK is turned into RGB by the plain formula, without inks or a profile."
        )
    if "exif" in file.info:
        _turn(picture, file.info["exif"])
    return picture
