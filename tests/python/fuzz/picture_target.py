"""Coverage-guided fuzz target of the picture readers in Python: any bytes give a picture or FileError.

Run by scripts/fuzz as ``picture_target.py exr|pillow [options of libFuzzer] corpus...``; needs atheris. Only
Python code is instrumented: the libraries below it are watched for crashes, hangs and memory alone.
"""

import random
import sys
import tempfile
import warnings
import zlib
from pathlib import Path

import atheris

with atheris.instrument_imports(
    include=["burnish.images", "burnish.environment_io", "burnish.cube_layout", "PIL"]
):
    import numpy as np
    from PIL import JpegImagePlugin, PngImagePlugin  # noqa: F401  Pillow would import them late, unseen

    from burnish import FileError
    from burnish.environment_io import environment_from_file
    from burnish.images import read_image

PNG_MAGIC = b"\x89PNG\r\n\x1a\n"
# Environments of larger pictures take the same paths, only longer.
MOST_PIXELS = 4096


def mend_checksums(data: bytes) -> bytes:
    """Give a PNG with the checksums that its chunks should have: decoders stop at the first wrong one."""
    mended, at = bytearray(data), len(PNG_MAGIC)
    while at + 12 <= len(data):
        end = at + 8 + int.from_bytes(data[at : at + 4], "big")
        if end + 4 > len(data):
            break
        mended[end : end + 4] = zlib.crc32(data[at + 4 : end]).to_bytes(4, "big")
        at = end + 4
    return bytes(mended)


def mutate(data: bytes, max_size: int, seed: int) -> bytes:
    """Change bytes as libFuzzer does; three times in four a PNG gets its checksums back."""
    changed = atheris.Mutate(data, max_size)
    is_mended = changed.startswith(PNG_MAGIC) and random.Random(seed).random() < 0.75
    return mend_checksums(changed) if is_mended else changed


def main() -> None:
    name, *arguments = sys.argv[1:]
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory(prefix="burnish-fuzz-") as folder:
        path = Path(folder) / f"picture.{name}"

        def test_one_input(data: bytes) -> None:
            path.write_bytes(data)
            try:
                pixels = read_image(path)
                if pixels.dtype != np.float32 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
                    raise AssertionError(f"got {pixels.dtype} of shape {pixels.shape}")
                if pixels.size <= MOST_PIXELS:
                    environment_from_file(path)
            except FileError as error:
                if not str(error).startswith(str(path)):
                    raise AssertionError(f"expected the path first, got {error}") from error

        atheris.Setup([sys.argv[0], *arguments], test_one_input, custom_mutator=mutate)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
