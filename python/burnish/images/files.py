"""Limits on what is read, errors in one form, and files that appear whole or not at all."""

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from burnish._core import FileError

MAX_PIXELS = 1 << 28
"""256 megapixels, as the reader of Radiance files has it: lat-long maps up to 23168 x 11584, twice what shops
call 16K.
"""

MAX_DECODED_BYTES = 1 << 33
"""All channels of a part of a file together, decoded."""


def file_error(path: str | os.PathLike[str], reason: str) -> FileError:
    """Make the error for a file that cannot be used, worded as the C++ side words it."""
    return FileError(f"{os.fspath(path)}: {reason}")


def require_pixels(path: str | os.PathLike[str], what: str, height: int, width: int) -> None:
    """Raise FileError unless the size is positive and within `MAX_PIXELS`."""
    if height < 1 or width < 1 or height * width > MAX_PIXELS:
        raise file_error(path, f"{what}: expected 1..{MAX_PIXELS} pixels, got {width} x {height}")


@contextmanager
def told_as_file_error(path: str | os.PathLike[str]) -> Iterator[None]:
    """Turn what the system says while the block writes, such as that the disk is full, into a FileError."""
    try:
        yield
    except FileError:
        raise
    except OSError as error:
        raise file_error(path, f"cannot be written: {error.strerror or error}") from error


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[str]:
    """Give the name of a temporary file beside `path` that becomes `path` when the block succeeds.

    Whatever happens in between, `path` is the old file or the whole new one. A process that is killed leaves
    the temporary file, ``.NAME-*.part`` and the ending of the name, and nothing else. What is no plain file,
    such as a pipe, is written to as it is.

    Parameters
    ----------
    path : path
        Its folder must exist. A link stays one: the file that it leads to is replaced.

    Raises
    ------
    FileError
        If the system cannot write, in the block or after it.
    """
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        with told_as_file_error(path):
            yield os.fspath(path)
        return
    descriptor, temporary = _create_beside(target, path)
    os.close(descriptor)
    try:
        with told_as_file_error(path):
            yield temporary
            _flush_to_disk(temporary)
            os.replace(temporary, target)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def _create_beside(target: Path, path: str | os.PathLike[str]) -> tuple[int, str]:
    """Create a file of a name that nobody has, with the permissions that any new file gets.

    ``tempfile.mkstemp`` makes it private, and what others are due can only be asked by changing it for all
    threads (``os.umask``).
    """
    while True:
        temporary = target.with_name(f".{target.name}-{secrets.token_hex(4)}.part{target.suffix}")
        try:
            return os.open(temporary, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666), os.fspath(temporary)
        except FileExistsError:
            continue
        except OSError as error:
            raise file_error(path, f"cannot write into {target.parent}: {error.strerror}") from error


def _flush_to_disk(path: str) -> None:
    """Wait until the file is on disk: some file systems say only then that they are full."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a UTF-8 file, whole or not at all.

    Parameters
    ----------
    path : path
        As `replacing` takes it.
    text : str
        All of it.
    """
    with replacing(path) as temporary:
        Path(temporary).write_text(text, encoding="utf-8")
