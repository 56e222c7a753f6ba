"""Samples of one part of an OpenEXR file, decoded by the OpenEXR package."""

import struct
from collections.abc import Iterator
from contextlib import contextmanager

import Imath
import numpy as np
import OpenEXR
from numpy.typing import NDArray

from burnish.images.exr_parts import LONG_NAMES, TILED, ExrHeader, ExrPart
from burnish.images.files import file_error
from burnish.images.source import Source

_FLOAT = Imath.PixelType(Imath.PixelType.FLOAT)
# Rows that are decoded at once, at least: beside the picture itself only so many are held.
_ROWS_AT_ONCE = 256


def _chunk_offsets(source: Source, header: ExrHeader, index: int, data: bytes) -> list[int]:
    """Where the chunks of a part are, after checks; `data` begins as the file does."""
    sizes = []
    for part in header.parts[: index + 1]:
        size = part.chunk_table_size if header.is_multi_part else part.chunk_count()
        if size is None or size < (0 if part.is_deep else part.chunk_count()):
            raise file_error(
                source.name,
                f"OpenEXR header: chunkCount: expected at least {part.chunk_count()} for part "
                f"'{part.name}', got {size}",
            )
        sizes.append(size)
    start, count = header.size_bytes + 8 * sum(sizes[:-1]), sizes[-1]
    if len(data) < start + 8 * count:
        raise file_error(source.name, f"expected a table of {count} chunks, got the end of the file")
    offsets = struct.unpack_from(f"<{count}Q", data, start)
    for number, offset in enumerate(offsets):
        if not start + 8 * count <= offset < source.size:
            raise file_error(
                source.name,
                f"expected all its samples, some are damaged or missing (chunk {number} of {count} lies "
                f"at byte {offset} of {source.size})",
            )
    return list(offsets)


def _single_part(source: Source, header: ExrHeader, index: int) -> Source:
    """Give a file that holds one part only, its samples as they are stored."""
    part, data = header.parts[index], source.read()
    offsets = _chunk_offsets(source, header, index, data)
    is_tiled = part.is_tiled
    place = 20 if is_tiled else 8  # of the samples' length: after part number and coordinates
    chunks = []
    for number, offset in enumerate(offsets):
        fields = data[offset : offset + place + 4]
        length = struct.unpack_from("<i", fields, place)[0] if len(fields) == place + 4 else -1
        chunk = data[offset + 4 : offset + place + 4 + max(length, 0)]
        if length < 0 or len(chunk) != place + length or struct.unpack_from("<i", fields)[0] != index:
            raise file_error(
                source.name,
                f"expected all its samples, some are damaged or missing (chunk {number} of {len(offsets)})",
            )
        chunks.append(chunk)
    version = 2 | (header.version & LONG_NAMES) | (TILED if is_tiled else 0)
    head = data[:4] + struct.pack("<I", version) + part.header_bytes
    at = len(head) + 8 * len(chunks) + np.cumsum([0, *map(len, chunks[:-1])], dtype=np.uint64)
    return Source(source.name, None, b"".join([head, at.astype("<u8").tobytes(), *chunks]))


@contextmanager
def _opened(source: Source) -> Iterator[OpenEXR.InputFile]:
    """Open a file of one part by the package's reader that raises what it finds.

    It is the older of two classes, and to be gone some day: pyproject.toml holds the package below 4. The
    newer one, ``OpenEXR.File``, prints to ``sys.stdout`` what is wrong with samples and returns without them;
    keeping that quiet takes replacing ``sys.stdout`` for all threads. It also decodes every channel of every
    part.
    """
    with source.on_disk() as path:
        file = OpenEXR.InputFile(path)
        try:
            yield file
        finally:
            file.close()


def read_samples(source: Source, header: ExrHeader, index: int, names: list[str]) -> NDArray[np.float32]:
    """Decode level 0 of some channels.

    Parameters
    ----------
    source : Source
        The file.
    header : ExrHeader
        Its own.
    index : int
        Which part.
    names : list of str
        Channels in the order in which they are wanted, sampled at every pixel; where a name is empty, zeros.

    Returns
    -------
    pixels : (h, w, n) float32
        The data window.

    Raises
    ------
    FileError
        If samples are damaged or missing, or memory does not suffice.
    """
    part = header.parts[index]
    if header.is_multi_part:
        source = _single_part(source, header, index)
    else:
        first_bytes = source.head(header.size_bytes + 8 * part.chunk_count())
        _chunk_offsets(source, header, index, first_bytes)
    try:
        return _decode(source, part, names)
    except MemoryError as error:
        height, width = part.size
        raise file_error(
            source.name, f"expected memory for {width} x {height} pixels of {len(names)} channels, got none"
        ) from error
    except Exception as error:  # the package raises what its C++ side throws, UnicodeDecodeError included
        said = " ".join(str(error).split()) or type(error).__name__
        raise file_error(
            source.name, f"expected all its samples, some are damaged or missing (OpenEXR says: {said})"
        ) from error


def _decode(source: Source, part: ExrPart, names: list[str]) -> NDArray[np.float32]:
    height, width = part.size
    pixels = np.zeros((height, width, len(names)), np.float32)
    wanted = sorted({name for name in names if name})
    rows_of_chunk = part.rows_of_chunk()
    # Whole chunks, so that none is decoded twice.
    step = rows_of_chunk * max(1, _ROWS_AT_ONCE // rows_of_chunk)
    top = part.data_window[1]
    with _opened(source) as file:
        for row in range(0, height, step):
            count = min(step, height - row)
            decoded = dict(
                zip(wanted, file.channels(wanted, _FLOAT, top + row, top + row + count - 1), strict=True)
            )
            for i, name in enumerate(names):
                if name:
                    block = np.frombuffer(decoded[name], np.float32)
                    pixels[row : row + count, :, i] = block.reshape(count, width)
    return pixels
