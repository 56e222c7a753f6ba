"""What an OpenEXR file declares, read with bounds before any library decodes it.

A file of a few hundred bytes can declare gigabytes. So the header is parsed here first: sizes are held
against the limits of `files` and against the bytes that the file really has.
"""

import struct
from collections.abc import Callable
from typing import Any

from burnish.images.exr_parts import (
    BYTES_OF_TYPE,
    CUBE,
    DEEP,
    LATLONG,
    LONG_NAMES,
    MULTI_PART,
    TILED,
    ExrChannel,
    ExrHeader,
    ExrPart,
)
from burnish.images.files import MAX_DECODED_BYTES, file_error, require_pixels
from burnish.images.source import PictureFile, Source, open_source

__all__ = ["CUBE", "LATLONG", "MAGIC", "read_exr_header"]

MAGIC = b"\x76\x2f\x31\x01"


class _Cursor:
    """Reads from bytes; every step past the end is a FileError."""

    def __init__(self, path: str, data: bytes) -> None:
        self.path = path
        self.data = data
        self.position = 0

    def fail(self, reason: str) -> Exception:
        return file_error(self.path, f"OpenEXR header: {reason}")

    def take(self, count: int, what: str) -> bytes:
        left = len(self.data) - self.position
        if not 0 <= count <= left:
            raise self.fail(f"{what}: expected {count} bytes, got {left} to the end of the file")
        self.position += count
        return self.data[self.position - count : self.position]

    def text(self, what: str) -> str:
        """Read a name that ends in a zero byte and has at most 255 others."""
        end = self.data.find(b"\0", self.position, self.position + 256)
        if end < 0:
            raise self.fail(f"{what}: expected a name of at most 255 bytes ending in 0, got none")
        raw = self.take(end + 1 - self.position, what)[:-1]
        return raw.decode("utf-8", "replace")


def _window(cursor: _Cursor, name: str, value: bytes) -> tuple[int, int, int, int]:
    window = struct.unpack("<4i", value)
    x_min, y_min, x_max, y_max = window
    if x_max < x_min or y_max < y_min or max(map(abs, window)) > 1 << 30:
        raise cursor.fail(
            f"{name}: expected a window with min <= max and coordinates below 2^30, got {window}"
        )
    require_pixels(cursor.path, f"OpenEXR header: {name}", y_max - y_min + 1, x_max - x_min + 1)
    return x_min, y_min, x_max, y_max


def _channels(cursor: _Cursor, value: bytes) -> list[ExrChannel]:
    entries = _Cursor(cursor.path, value)
    channels = []
    while name := entries.text("channels"):
        pixel_type, _, x_sampling, y_sampling = struct.unpack("<4i", entries.take(16, f"channel {name!a}"))
        if pixel_type not in BYTES_OF_TYPE or x_sampling < 1 or y_sampling < 1:
            raise cursor.fail(
                f"channel {name!a}: expected pixel type 0..2 and sampling >= 1, "
                f"got type {pixel_type} and sampling {x_sampling}, {y_sampling}"
            )
        channels.append(ExrChannel(name, (x_sampling, y_sampling), pixel_type))
    return channels


def _text(cursor: _Cursor, name: str, value: bytes) -> str:
    return value.decode("utf-8", "replace")


def _texts(cursor: _Cursor, name: str, value: bytes) -> list[str]:
    entries = _Cursor(cursor.path, value)
    texts = []
    while entries.position < len(value):
        (size,) = struct.unpack("<i", entries.take(4, name))
        texts.append(entries.take(size, name).decode("utf-8", "replace"))
    return texts


def _tiles(cursor: _Cursor, name: str, value: bytes) -> tuple[int, int]:
    x_size, y_size = struct.unpack("<2I", value[:8])
    require_pixels(cursor.path, "OpenEXR header: tiles", y_size, x_size)
    return x_size, y_size


def _number(code: str) -> Callable[[_Cursor, str, bytes], Any]:
    return lambda cursor, name, value: struct.unpack("<" + code, value)[0]


def _numbers(code: str) -> Callable[[_Cursor, str, bytes], Any]:
    return lambda cursor, name, value: struct.unpack("<" + code, value)


_READERS: dict[str, tuple[str, int | None, Callable[[_Cursor, str, bytes], Any]]] = {
    "dataWindow": ("data_window", 16, _window),
    "displayWindow": ("display_window", 16, _window),
    "channels": ("channels", None, lambda cursor, name, value: _channels(cursor, value)),
    "compression": ("compression", 1, _number("B")),
    "tiles": ("tile_size", 9, _tiles),
    "type": ("kind", None, _text),
    "envmap": ("envmap", 1, _number("B")),
    "name": ("name", None, _text),
    "view": ("view", None, _text),
    "multiView": ("views", None, _texts),
    "chunkCount": ("chunk_table_size", 4, _number("i")),
    "pixelAspectRatio": ("pixel_aspect_ratio", 4, _number("f")),
    "chromaticities": ("chromaticities", 32, _numbers("8f")),
    "whiteLuminance": ("white_luminance", 4, _number("f")),
    "adoptedNeutral": ("adopted_neutral", 8, _numbers("2f")),
    "acesImageContainerFlag": ("aces_container", 4, _number("i")),
    "colorInteropID": ("color_interop_id", None, _text),
}
"""Attribute: the field of `ExrPart`, the bytes it has, its reader. All others are passed over."""


def _read_part(cursor: _Cursor) -> ExrPart | None:
    """Read attributes up to the empty name; None where there is none at all, which ends a multi-part
    header.
    """
    part = ExrPart()
    seen = set()
    start = cursor.position
    while name := cursor.text("attribute"):
        cursor.text(f"type of {name!a}")
        (size,) = struct.unpack("<i", cursor.take(4, f"size of {name!a}"))
        value = cursor.take(size, f"attribute {name!a}")
        seen.add(name)
        if name in _READERS:
            target, expected_size, read = _READERS[name]
            if expected_size not in (None, size):
                raise cursor.fail(f"{name}: expected {expected_size} bytes, got {size}")
            setattr(part, target, read(cursor, name, value))
    if not seen:
        return None
    part.header_bytes = cursor.data[start : cursor.position]
    missing = {"dataWindow", "displayWindow", "channels", "compression"} - seen
    if missing:
        raise cursor.fail(
            f"expected the attributes every OpenEXR file has, got none named {', '.join(sorted(missing))}"
        )
    return part


def read_exr_header(path: PictureFile | Source) -> ExrHeader:
    """Read and check what a file declares.

    Parameters
    ----------
    path : path, bytes, or binary file object
        An OpenEXR file, whatever its name.

    Returns
    -------
    header : ExrHeader
        With at least one part.

    Raises
    ------
    FileError
        If the header is broken, or the declared size beyond the limits or the bytes there are.
    """
    source = open_source(path)
    # Headers are some hundred bytes; previews and manifests make some megabytes.
    cursor = _Cursor(source.name, source.head(1 << 25))
    if cursor.take(4, "magic number") != MAGIC:
        raise cursor.fail("magic number: expected 76 2f 31 01, got others")
    (version,) = struct.unpack("<I", cursor.take(4, "version"))
    if version & 0xFF != 2 or version & ~(0xFF | TILED | LONG_NAMES | DEEP | MULTI_PART):
        raise cursor.fail(
            f"version: expected 2 with known flags, got {version & 0xFF} with flags {version >> 8:#x}"
        )
    parts = []
    while (part := _read_part(cursor)) is not None:
        parts.append(part)
        if not version & MULTI_PART:
            break
    if not parts:
        raise cursor.fail("expected at least one part, got none")
    if version & DEEP and not version & MULTI_PART:
        parts[0].kind = parts[0].kind or "deepscanline"
    if not version & MULTI_PART and not parts[0].is_deep:
        parts[0].kind = "tiledimage" if version & TILED else "scanlineimage"
    if any(part.is_tiled and part.tile_size is None for part in parts):
        raise cursor.fail("expected the attribute tiles in a tiled file, got none")
    header = ExrHeader(version, parts, cursor.position)
    _check_against_size(source, header)
    return header


def _check_against_size(source: Source, header: ExrHeader) -> None:
    decoded = max(part.decoded_bytes() for part in header.parts)
    if decoded > MAX_DECODED_BYTES:
        raise file_error(
            source.name,
            f"OpenEXR header: expected at most {MAX_DECODED_BYTES} bytes of samples, got {decoded} declared",
        )
    needed = header.size_bytes + sum(part.least_bytes() for part in header.parts)
    if source.size < needed:
        raise file_error(
            source.name, f"expected at least {needed} bytes for the declared samples, got {source.size}"
        )
