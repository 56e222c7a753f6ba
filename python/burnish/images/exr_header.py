"""What an OpenEXR file declares, read with bounds before any library decodes it.

A file of a few hundred bytes can declare gigabytes. So the header is parsed here first: sizes are held
against the limits of `files` and against the bytes that the file really has.
"""

import os
import struct
from dataclasses import dataclass, field

from burnish.images.files import MAX_DECODED_BYTES, file_error, require_pixels

MAGIC = b"\x76\x2f\x31\x01"
LATLONG, CUBE = 0, 1
"""Values of the attribute envmap."""

_TILED, _LONG_NAMES, _DEEP, _MULTI_PART = 0x200, 0x400, 0x800, 0x1000
_BYTES_OF_TYPE = {0: 4, 1: 2, 2: 4}  # uint, half, float
# Rows in one chunk, by the number of the compression; those not listed hold at most 256.
_ROWS_OF_CHUNK = {0: 1, 1: 1, 2: 1, 3: 16, 4: 32, 5: 16, 6: 32, 7: 32, 8: 32, 9: 256}


@dataclass
class ExrChannel:
    """One channel as declared."""

    name: str
    sampling: tuple[int, int]
    bytes_per_sample: int


@dataclass
class ExrPart:
    """One part as declared; windows are (x_min, y_min, x_max, y_max), both ends inside."""

    data_window: tuple[int, int, int, int] = (0, 0, -1, -1)
    display_window: tuple[int, int, int, int] = (0, 0, -1, -1)
    channels: list[ExrChannel] = field(default_factory=list)
    compression: int = 0
    tile_size: tuple[int, int] | None = None
    kind: str = ""
    envmap: int | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Height and width of the data window."""
        x_min, y_min, x_max, y_max = self.data_window
        return y_max - y_min + 1, x_max - x_min + 1

    def decoded_bytes(self) -> int:
        """Bytes of all samples of level 0."""
        height, width = self.size
        return sum(
            -(-height // c.sampling[1]) * -(-width // c.sampling[0]) * c.bytes_per_sample
            for c in self.channels
        )

    def chunk_count(self) -> int:
        """Chunks of level 0 at least."""
        height, width = self.size
        if self.tile_size is not None:
            return -(-width // self.tile_size[0]) * -(-height // self.tile_size[1])
        return -(-height // _ROWS_OF_CHUNK.get(self.compression, 256))


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
        if pixel_type not in _BYTES_OF_TYPE or x_sampling < 1 or y_sampling < 1:
            raise cursor.fail(
                f"channel {name!a}: expected pixel type 0..2 and sampling >= 1, "
                f"got type {pixel_type} and sampling {x_sampling}, {y_sampling}"
            )
        channels.append(ExrChannel(name, (x_sampling, y_sampling), _BYTES_OF_TYPE[pixel_type]))
    return channels


_EXPECTED_SIZE = {"dataWindow": 16, "displayWindow": 16, "compression": 1, "tiles": 9, "envmap": 1}


def _read_part(cursor: _Cursor) -> ExrPart | None:
    """Read attributes up to the empty name; None where there is none at all, which ends a multi-part
    header.
    """
    part = ExrPart()
    seen = set()
    while name := cursor.text("attribute"):
        cursor.text(f"type of {name!a}")
        (size,) = struct.unpack("<i", cursor.take(4, f"size of {name!a}"))
        value = cursor.take(size, f"attribute {name!a}")
        if size != _EXPECTED_SIZE.get(name, size):
            raise cursor.fail(f"{name}: expected {_EXPECTED_SIZE[name]} bytes, got {size}")
        seen.add(name)
        if name == "dataWindow":
            part.data_window = _window(cursor, name, value)
        elif name == "displayWindow":
            part.display_window = _window(cursor, name, value)
        elif name == "channels":
            part.channels = _channels(cursor, value)
        elif name == "compression":
            part.compression = value[0]
        elif name == "tiles":
            x_size, y_size = struct.unpack("<2I", value[:8])
            require_pixels(cursor.path, "OpenEXR header: tiles", y_size, x_size)
            part.tile_size = (x_size, y_size)
        elif name == "type":
            part.kind = value.decode("latin-1")
        elif name == "envmap":
            part.envmap = value[0]
    if not seen:
        return None
    missing = {"dataWindow", "displayWindow", "channels", "compression"} - seen
    if missing:
        raise cursor.fail(
            f"expected the attributes every OpenEXR file has, got none named {', '.join(sorted(missing))}"
        )
    return part


def read_exr_header(path: str | os.PathLike[str]) -> list[ExrPart]:
    """Read and check what a file declares.

    Parameters
    ----------
    path : path
        An OpenEXR file, whatever its name.

    Returns
    -------
    parts : list of ExrPart
        At least one.

    Raises
    ------
    FileError
        If the header is broken, the data deep, or the declared size beyond the limits or the bytes there are.
    """
    name = os.fspath(path)
    with open(path, "rb") as stream:
        file_size = os.fstat(stream.fileno()).st_size
        # Headers are some hundred bytes; previews and manifests make some megabytes.
        cursor = _Cursor(name, stream.read(1 << 25))
    if cursor.take(4, "magic number") != MAGIC:
        raise cursor.fail("magic number: expected 76 2f 31 01, got others")
    (version,) = struct.unpack("<I", cursor.take(4, "version"))
    if version & 0xFF != 2 or version & ~(0xFF | _TILED | _LONG_NAMES | _DEEP | _MULTI_PART):
        raise cursor.fail(
            f"version: expected 2 with known flags, got {version & 0xFF} with flags {version >> 8:#x}"
        )
    parts = []
    while (part := _read_part(cursor)) is not None:
        parts.append(part)
        if not version & _MULTI_PART:
            break
    if not parts:
        raise cursor.fail("expected at least one part, got none")
    if version & _DEEP or any(part.kind.startswith("deep") for part in parts):
        raise file_error(path, "expected a flat picture, got deep data (many samples per pixel)")
    if version & _TILED and parts[0].tile_size is None:
        raise cursor.fail("expected the attribute tiles in a tiled file, got none")
    _check_against_size(cursor, parts, file_size)
    return parts


def _check_against_size(cursor: _Cursor, parts: list[ExrPart], file_size: int) -> None:
    decoded = sum(part.decoded_bytes() for part in parts)
    if decoded > MAX_DECODED_BYTES:
        raise cursor.fail(f"expected at most {MAX_DECODED_BYTES} bytes of samples, got {decoded} declared")
    # A chunk needs at least its entry in the table of offsets, its coordinate and its length.
    needed = cursor.position + 16 * sum(part.chunk_count() for part in parts)
    if file_size < needed:
        raise file_error(
            cursor.path, f"expected at least {needed} bytes for the declared chunks, got {file_size}"
        )
