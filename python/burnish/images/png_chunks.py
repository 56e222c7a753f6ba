"""What the chunks of a PNG file say (PNG, third edition)."""

import struct
import zlib
from dataclasses import dataclass, field

from burnish.images.files import file_error, require_pixels
from burnish.images.source import Source

MAGIC = b"\x89PNG\r\n\x1a\n"

_CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
# Deflate packs at most so many bytes into one.
_DEFLATE_RATIO = 1032
_LARGEST_PROFILE = 1 << 24
_BYTES_AT_ONCE = 1 << 22
# First column and row of each pass of an interlaced picture, and its steps.
_PASSES = ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2))


@dataclass
class PngHeader:
    """The chunk IHDR, and those about colour where they are there."""

    width: int
    height: int
    bits: int
    color_type: int
    is_interlaced: bool
    chunks: dict[str, bytes] = field(default_factory=dict)
    """The first chunk of each other name, samples and what is larger than profiles are left out."""

    def row_bytes(self, columns: int) -> int:
        """Bytes of a row of so many pixels, with the filter's."""
        return 1 + -(-columns * self.bits * _CHANNELS.get(self.color_type, 1) // 8)

    def sample_bytes(self) -> int:
        """Bytes of all rows, as they are before they are deflated."""
        if not self.is_interlaced:
            return self.height * self.row_bytes(self.width)
        return sum(
            len(range(y, self.height, dy)) * self.row_bytes(len(range(x, self.width, dx)))
            for x, y, dx, dy in _PASSES
            if x < self.width
        )

    def require_data(self, source: Source) -> None:
        """Refuse a file too short for its size: Pillow would make a black picture of it, however large."""
        if source.size * _DEFLATE_RATIO < self.sample_bytes():
            raise file_error(
                source.name,
                f"PNG: expected data for {self.width} x {self.height} pixels, got {source.size} bytes",
            )


def read_png_chunks(source: Source, data: bytes) -> PngHeader:
    """Read every chunk but the samples, check all checksums, and that the samples are whole.

    Raises
    ------
    FileError
        If the file is cut, a checksum is wrong, or the samples are damaged or too few.
    """
    view = memoryview(data)
    at = len(MAGIC)
    header: PngHeader | None = None
    packed: list[memoryview] = []
    while at < len(view):
        if at + 12 > len(view):
            raise file_error(source.name, f"PNG: expected a chunk at byte {at}, got the end of the file")
        length, name = struct.unpack_from(">I4s", view, at)
        shown = name.decode("latin-1")
        if at + 12 + length > len(view):
            raise file_error(
                source.name, f"PNG: chunk {shown!a}: expected {length} bytes, got the end of the file"
            )
        content = view[at + 8 : at + 8 + length]
        (checksum,) = struct.unpack_from(">I", view, at + 8 + length)
        if zlib.crc32(content, zlib.crc32(name)) != checksum:
            raise file_error(
                source.name, f"PNG: chunk {shown!a}: expected the checksum {checksum:#x}, got another"
            )
        if header is None:
            if name != b"IHDR" or length != 13:
                raise file_error(source.name, f"PNG: expected the chunk IHDR first, got {shown!a}")
            width, height, bits, color_type, _, _, interlace = struct.unpack(">II5B", content)
            require_pixels(source.name, "PNG", height, width)
            header = PngHeader(width, height, bits, color_type, interlace == 1)
            header.require_data(source)
        elif name == b"IDAT":
            packed.append(content)
        elif length <= _LARGEST_PROFILE:
            header.chunks.setdefault(shown, bytes(content))
        at += 12 + length
        if name == b"IEND":
            break
    if header is None:
        raise file_error(source.name, "PNG: expected the chunk IHDR, got the end of the file")
    _require_samples(source, header, packed)
    return header


def _require_samples(source: Source, header: PngHeader, packed: list[memoryview]) -> None:
    """Refuse samples that end too early, of which Pillow would make black rows, or that are damaged."""
    unpacker, count = zlib.decompressobj(), 0
    needed = header.sample_bytes()
    try:
        for content in packed:
            left = bytes(content)
            while count < needed and not unpacker.eof:
                unpacked = len(unpacker.decompress(left, _BYTES_AT_ONCE))
                left = unpacker.unconsumed_tail
                count += unpacked
                if not left and unpacked < _BYTES_AT_ONCE:
                    break
    except zlib.error as error:
        raise file_error(source.name, f"PNG cannot be decoded, it is damaged ({error})") from error
    if count < needed:
        raise file_error(source.name, f"PNG: expected {needed} bytes of samples, got {count}")


def unpack_profile(chunk: bytes) -> bytes:
    """Give the ICC profile of a chunk iCCP.

    Raises
    ------
    ValueError
        If it cannot be unpacked.
    """
    _, _, packed = chunk.partition(b"\0")
    unpacker = zlib.decompressobj()
    try:
        return unpacker.decompress(packed[1:], _LARGEST_PROFILE)
    except zlib.error as error:
        raise ValueError(f"ICC profile: expected deflated bytes, got others ({error})") from error
