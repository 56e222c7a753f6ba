"""Maps of 16384 x 8192 pass every limit, and files that cannot hold what they declare do not."""

import io
import struct
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from PIL import Image

import picture_support as made
from burnish import Environment, FileError, images

HEIGHT, WIDTH = 8192, 16384
NEEDED_BYTES = 10 << 30  # measured: 8


def large_hdr() -> bytes:
    """Run-length rows of 2, 1, .5: 64 a pixel in the file would be a gigabyte, here it is 9 MB."""

    def plane(value):
        runs, rest = divmod(WIDTH, 127)
        return bytes([128 + 127, value]) * runs + (bytes([128 + rest, value]) if rest else b"")

    row = b"\2\2" + struct.pack(">H", WIDTH) + plane(128) + plane(64) + plane(32) + plane(130)
    return f"#?RADIANCE\n\n-Y {HEIGHT} +X {WIDTH}\n".encode() + row * HEIGHT


def large_exr() -> bytes:
    row = np.ones((1, WIDTH), np.float16)
    return made.exr(
        {name: np.repeat(row * k, HEIGHT, axis=0) for name, k in (("R", 2), ("G", 1), ("B", 0.5))}
    )


def available_bytes() -> int:
    """Memory that the system would give, what it only caches included."""
    lines = Path("/proc/meminfo").read_text().splitlines()
    return next(1024 * int(line.split()[1]) for line in lines if line.startswith("MemAvailable"))


@pytest.mark.slow
@pytest.mark.parametrize("make", [large_hdr, large_exr])
def test_a_map_of_16k_loads(make):
    if available_bytes() < NEEDED_BYTES:
        pytest.skip("needs 10 GiB of free memory")
    environment = Environment.from_file(make(), face_size=16)
    np.testing.assert_allclose(environment.faces, np.broadcast_to([2, 1, 0.5], (6, 16, 16, 3)), rtol=1e-5)
    assert environment.notes == ["lat-long map of 16384 x 8192 resampled by area to faces of 16."]


def declared(width, height, compression):
    """An OpenEXR file of a few hundred bytes that declares a large window."""
    data = made.exr({name: np.ones((1, 1), np.float32) for name in "RGB"}, {"compression": compression})
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    for name in ("dataWindow", "displayWindow"):
        at = data.index(name.encode()) + len(name) + 1 + 6 + 4
        data = data[:at] + window + data[at + 16 :]
    return data


@pytest.mark.parametrize("compression", ["NO", "RLE", "ZIP", "PIZ", "DWAB"])
def test_an_exr_too_short_for_its_size_is_refused(compression):
    data = declared(WIDTH, HEIGHT, getattr(OpenEXR, f"{compression}_COMPRESSION"))
    with pytest.raises(FileError, match=r"expected at least \d+ bytes for the declared samples, got \d+"):
        images.read_image(data)
    # Even with its whole table of chunks it is too short, where the compression has a bound.
    if compression in ("NO", "RLE", "ZIP"):
        with pytest.raises(FileError, match=r"expected at least \d+ bytes for the declared samples"):
            images.read_image(data + bytes(16 * HEIGHT))


def test_more_than_256_megapixels_are_refused():
    with pytest.raises(FileError, match=r"dataWindow: expected 1..268435456 pixels, got 32768 x 8193"):
        images.read_image(declared(32768, 8193, OpenEXR.ZIP_COMPRESSION))
    with pytest.raises(FileError, match="expected at most 268435456 pixels, got 8193 scanlines of 32768"):
        images.read_image(b"#?RADIANCE\n\n-Y 8193 +X 32768\n" + bytes(1 << 20))
    large = made.png(np.zeros((1, 1), np.uint16))
    header = struct.pack(">2I5B", 32768, 8193, 16, 0, 0, 0, 0)
    data = large[:8] + made.png_chunk(b"IHDR", header) + large[8 + 25 :]
    with pytest.raises(FileError, match=r"PNG: expected 1..268435456 pixels, got 32768 x 8193"):
        images.read_image(data)
    header = struct.pack(">2I5B", 32768, 8192, 16, 0, 0, 0, 0)
    data = large[:8] + made.png_chunk(b"IHDR", header) + large[8 + 25 :]
    with pytest.raises(FileError, match=r"PNG: expected data for 32768 x 8192 pixels, got \d+ bytes"):
        images.read_image(data)


def test_a_jpeg_too_short_for_its_size_is_refused():
    stream = io.BytesIO()
    Image.new("L", (8, 8)).save(stream, "JPEG")
    data = bytearray(stream.getvalue())
    frame = data.index(b"\xff\xc0") + 5
    data[frame : frame + 4] = struct.pack(">2H", 16000, 16000)
    with pytest.raises(FileError, match=r"JPEG: expected data for 16000 x 16000 pixels, got \d+ bytes"):
        images.read_image(bytes(data))
