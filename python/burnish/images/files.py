"""Limits on what is read, errors in one form, and files that appear whole or not at all."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from burnish._core import FileError

MAX_PIXELS = 1 << 26
"""64 megapixels, as the reader of Radiance files has it."""

MAX_DECODED_BYTES = 1 << 30
"""All channels and parts of a file together, decoded."""


def file_error(path: str | os.PathLike[str], reason: str) -> FileError:
    """Make the error for a file that cannot be used, worded as the C++ side words it."""
    return FileError(f"{os.fspath(path)}: {reason}")


def require_pixels(path: str | os.PathLike[str], what: str, height: int, width: int) -> None:
    """Raise FileError unless the size is positive and within `MAX_PIXELS`."""
    if height < 1 or width < 1 or height * width > MAX_PIXELS:
        raise file_error(path, f"{what}: expected 1..{MAX_PIXELS} pixels, got {width} x {height}")


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[str]:
    """Give the name of a temporary file beside `path` that becomes `path` when the block succeeds."""
    target = Path(path)
    try:
        descriptor, temporary = tempfile.mkstemp(
            prefix=f".{target.name}-", suffix=target.suffix, dir=target.parent
        )
    except OSError as error:
        raise file_error(path, f"cannot write into {target.parent}: {error.strerror}") from error
    os.close(descriptor)
    try:
        yield temporary
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)  # mkstemp makes it private; a new file would not be
        os.replace(temporary, target)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
