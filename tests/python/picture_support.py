"""Picture files made by code, with any field that a header can have."""

import io
import struct
import zlib

import numpy as np
import OpenEXR

ADAM7 = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]
"""First column and row of each pass of an interlaced PNG, and its steps."""


def png_chunk(name: bytes, content: bytes) -> bytes:
    """Give a chunk of a PNG file with its length and checksum."""
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def png(samples, *chunks: tuple[bytes, bytes], is_interlaced: bool = False, rows: int | None = None) -> bytes:
    """Give a PNG of uint8 or uint16 samples, (h, w) or (h, w, 2 to 4), with further chunks before them.

    With `rows` it holds only so many of the rows that it declares.
    """
    samples = np.asarray(samples)
    height, width = samples.shape[:2]
    color_type = {1: 0, 2: 4, 3: 2, 4: 6}[1 if samples.ndim == 2 else samples.shape[2]]
    bits = 8 * samples.dtype.itemsize
    steps = ADAM7 if is_interlaced else [(0, 0, 1, 1)]
    passes = [samples[y::dy, x::dx] for x, y, dx, dy in steps]
    packed = b"".join(
        b"\0" + row.astype(f">u{bits // 8}").tobytes() for part in passes if part.size for row in part[:rows]
    )
    return (
        b"\x89PNG\r\n\x1a\n"
        + png_chunk(b"IHDR", struct.pack(">2I5B", width, height, bits, color_type, 0, 0, is_interlaced))
        + b"".join(png_chunk(name, content) for name, content in chunks)
        + png_chunk(b"IDAT", zlib.compress(packed))
        + png_chunk(b"IEND", b"")
    )


def exr(channels, header=None) -> bytes:
    """Give an OpenEXR file of one part; channels by name."""
    stream = io.BytesIO()
    with OpenEXR.File(
        {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **(header or {})},
        {name: np.ascontiguousarray(samples) for name, samples in channels.items()},
    ) as file:
        file.write(stream)
    return stream.getvalue()


def exr_parts(*parts) -> bytes:
    """Give an OpenEXR file of several parts, each a pair (header with a name, channels)."""
    stream = io.BytesIO()
    made = [
        OpenEXR.Part(
            {"type": OpenEXR.scanlineimage, **header},
            {name: np.ascontiguousarray(samples) for name, samples in channels.items()},
        )
        for header, channels in parts
    ]
    with OpenEXR.File(made) as file:
        file.write(stream)
    return stream.getvalue()


def deep_part(height: int, width: int) -> tuple[dict, dict]:
    """Give header and channels of a part with two samples a pixel."""
    samples = np.empty((height, width), object)
    for place in np.ndindex(height, width):
        samples[place] = np.ones(2, np.float32)
    header = {"name": "deep", "type": OpenEXR.deepscanline, "compression": OpenEXR.ZIPS_COMPRESSION}
    return header, {name: samples.copy() for name in "RGB"}


def attribute(name: str, kind: str, value: bytes) -> bytes:
    """Give an attribute of an OpenEXR header as it stands in a file."""
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def with_attribute(file: bytes, name: str, kind: str, value: bytes) -> bytes:
    """Give an OpenEXR file of one part with an attribute more, as no package checks it.

    The attribute replaces the file's own of that name. Offsets of the chunks move with the header.
    """
    at, chunks = 8, []
    while file[at]:
        end = at
        for _ in range(2):
            end = file.index(b"\0", end) + 1
        size = struct.unpack_from("<i", file, end)[0]
        if file[at : file.index(b"\0", at)].decode() != name:
            chunks.append(file[at : end + 4 + size])
        at = end + 4 + size
    table = at + 1
    first = struct.unpack_from("<Q", file, table)[0]
    head = file[:8] + b"".join(chunks) + attribute(name, kind, value) + b"\0"
    moved = len(head) - table
    offsets = np.frombuffer(file, "<u8", (first - table) // 8, table) + np.uint64(moved % 2**64)
    return head + offsets.astype("<u8").tobytes() + file[first:]


def exr_with_sampling(file: bytes, sampling: int) -> bytes:
    """Give an OpenEXR file whose first channel declares another sampling in x; the samples stay."""
    at = file.index(b"chlist\0") + 7 + 4
    at = file.index(b"\0", at) + 1
    return file[: at + 8] + struct.pack("<i", sampling) + file[at + 12 :]


def hdr(radiance, *lines: str, resolution: str | None = None) -> bytes:
    """Give a flat Radiance file with further header lines; numbers that eight bits hold come out exact."""
    radiance = np.asarray(radiance, np.float64)
    height, width = radiance.shape[:2]
    _, exponents = np.frexp(radiance.max(axis=2))
    mantissas = radiance * 2.0 ** (8 - exponents[..., None])
    pixels = np.concatenate([mantissas, exponents[..., None] + 128], axis=2).astype(np.uint8)
    head = "".join(
        line + "\n" for line in ("#?RADIANCE", *lines, "", resolution or f"-Y {height} +X {width}")
    )
    return head.encode() + pixels.tobytes()


def icc_profile(columns, curve, name: str = "made by code", space: bytes = b"RGB ") -> bytes:
    """Give an ICC profile of a matrix, given as the XYZ of red, green and blue, and one curve or exponent."""

    def fixed(values):
        return b"".join(struct.pack(">i", round(65536 * float(value))) for value in values)

    if not isinstance(curve, bytes):
        curve = b"para\0\0\0\0\0\0\0\0" + fixed([curve])
    tags = {b"desc": b"desc\0\0\0\0" + struct.pack(">I", len(name) + 1) + name.encode() + b"\0"}
    for i, letter in enumerate(b"rgb"):
        tags[bytes([letter]) + b"XYZ"] = b"XYZ \0\0\0\0" + fixed(columns[i])
        tags[bytes([letter]) + b"TRC"] = curve
    table, content = struct.pack(">I", len(tags)), b""
    for tag, value in tags.items():
        table += struct.pack(">4sII", tag, 132 + 12 * len(tags) + len(content), len(value))
        content += value + b"\0" * (-len(value) % 4)
    head = bytes(12) + b"mntr" + space + b"XYZ " + bytes(12) + b"acsp" + bytes(88)
    return head + table + content
