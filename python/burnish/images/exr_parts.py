"""What OpenEXR's parts and channels declare, and what that needs in bytes."""

from dataclasses import dataclass, field

LATLONG, CUBE = 0, 1
"""Values of the attribute envmap."""

TILED, LONG_NAMES, DEEP, MULTI_PART = 0x200, 0x400, 0x800, 0x1000
"""Flags of the version."""

UINT, HALF, FLOAT = 0, 1, 2
"""Types of samples."""

BYTES_OF_TYPE = {UINT: 4, HALF: 2, FLOAT: 4}
# Rows in one chunk, by the number of the compression; those not listed hold at most 256.
_ROWS_OF_CHUNK = {0: 1, 1: 1, 2: 1, 3: 16, 4: 32, 5: 16, 6: 32, 7: 32, 8: 32, 9: 256}
# How many bytes one byte can become at most: none, RLE (128 from 2), ZIPS and ZIP (deflate), PXR24 (deflate
# after 4 bytes became 3), B44 (32 from 14), B44A (32 from 3). Others have no bound that is known here.
_MOST_EXPANSION = {0: 1.0, 1: 64.0, 2: 1032.0, 3: 1032.0, 5: 1376.0, 6: 2.3, 7: 10.7}


@dataclass
class ExrChannel:
    """One channel as declared."""

    name: str
    sampling: tuple[int, int]
    sample_type: int

    @property
    def bytes_per_sample(self) -> int:
        """Bytes of one decoded sample."""
        return BYTES_OF_TYPE[self.sample_type]


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
    name: str = ""
    view: str = ""
    views: list[str] = field(default_factory=list)
    chunk_table_size: int | None = None
    pixel_aspect_ratio: float = 1.0
    chromaticities: tuple[float, ...] | None = None
    white_luminance: float | None = None
    adopted_neutral: tuple[float, ...] | None = None
    aces_container: int = 0
    color_interop_id: str = ""
    header_bytes: bytes = b""
    """Its attributes as they stand in the file, with the empty name that ends them."""

    @property
    def is_deep(self) -> bool:
        """Whether a pixel may have many samples."""
        return self.kind.startswith("deep")

    @property
    def is_tiled(self) -> bool:
        """Whether its chunks are tiles; without a type, as old files are, the attribute tiles says so."""
        return self.kind in ("tiledimage", "deeptile") or (not self.kind and self.tile_size is not None)

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
        if self.tile_size is not None and self.is_tiled:
            return -(-width // self.tile_size[0]) * -(-height // self.tile_size[1])
        return -(-height // self.rows_of_chunk())

    def rows_of_chunk(self) -> int:
        """Rows that are decoded together, at most."""
        if self.tile_size is not None and self.is_tiled:
            return self.tile_size[1]
        return _ROWS_OF_CHUNK.get(self.compression, 256)

    def least_bytes(self) -> int:
        """Bytes in the file that level 0 needs at least."""
        height, width = self.size
        samples = sum(
            (height // c.sampling[1]) * (width // c.sampling[0]) * c.bytes_per_sample for c in self.channels
        )
        expansion = _MOST_EXPANSION.get(self.compression)
        # A chunk needs at least its entry in the table of offsets, its coordinate and its length.
        return 16 * self.chunk_count() + (
            0 if expansion is None or self.is_deep else int(samples / expansion)
        )


@dataclass
class ExrHeader:
    """All parts of a file, and where their tables of offsets begin."""

    version: int
    """With its flags."""
    parts: list[ExrPart]
    size_bytes: int

    @property
    def is_multi_part(self) -> bool:
        """Whether chunks say which part they belong to."""
        return bool(self.version & MULTI_PART)
