"""Where a picture's bytes come from: a path, bytes in memory, or an open binary file."""

import os
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import BinaryIO, TypeAlias

from burnish.images.files import file_error

FilePath: TypeAlias = str | os.PathLike[str]
PictureFile: TypeAlias = FilePath | bytes | bytearray | memoryview | BinaryIO
"""What readers of pictures take; an open file is read from where it stands to its end, and stays open."""

_IN_MEMORY = "picture in memory"


class Source:
    """A picture file that is opened or in memory, and its name for messages.

    Parameters
    ----------
    name : str
        The path as it was given, or what stands for it.
    path : str or None
        Where the bytes are on disk; None: in `data`.
    data : bytes or memoryview
        All bytes, where there is no path.
    """

    def __init__(self, name: str, path: str | None, data: bytes | memoryview = b"") -> None:
        self.name = name
        self._path = path
        self._data = data

    @property
    def size(self) -> int:
        """Bytes in all."""
        return len(self._data) if self._path is None else os.path.getsize(self._path)

    @property
    def label(self) -> str:
        """The name without its folder."""
        return os.path.basename(self.name)

    def head(self, count: int) -> bytes:
        """Give the first bytes, at most `count`."""
        if self._path is None:
            return bytes(self._data[:count])
        with open(self._path, "rb") as stream:
            return stream.read(count)

    def read(self) -> bytes:
        """Give all bytes."""
        return bytes(self._data) if self._path is None else self.head(-1)

    @contextmanager
    def on_disk(self) -> Iterator[str]:
        """Give a path of these bytes, for libraries that read no others; it may be a temporary file."""
        if self._path is not None:
            yield self._path
            return
        with tempfile.NamedTemporaryFile(prefix="burnish-") as file:
            file.write(self._data)
            file.flush()
            yield file.name


def _of_path(path: FilePath) -> Source:
    name = os.fspath(path)
    if not isinstance(name, str):
        name = os.fsdecode(name)
    try:
        if not stat.S_ISREG(os.stat(name).st_mode):
            raise file_error(name, "expected a file, got something else")
        with open(name, "rb"):
            pass
    except FileNotFoundError as error:
        raise file_error(name, "expected a file, found none") from error
    except PermissionError as error:
        raise file_error(name, "expected a readable file, permission denied") from error
    return Source(name, name)


def open_source(path: "PictureFile | Source") -> Source:
    """Find out what was given, and that it can be read.

    Parameters
    ----------
    path : path, bytes, or binary file object
        As `PictureFile` says. An open file is named by its own ``name`` where that is text.

    Raises
    ------
    FileError
        If a path leads to no readable file.
    ValueError
        If it is none of these, or a file opened as text.
    """
    if isinstance(path, Source):
        return path
    if isinstance(path, bytes | bytearray | memoryview):
        return Source(_IN_MEMORY, None, bytes(path))
    if isinstance(path, str | os.PathLike):
        return _of_path(path)
    read = getattr(path, "read", None)
    data = read() if callable(read) else None
    if not isinstance(data, bytes | bytearray | memoryview):
        got = type(path).__name__ + (" that reads text" if isinstance(data, str) else "")
        raise ValueError(f"path: expected a path, bytes, or a file opened in binary mode, got {got}")
    name = getattr(path, "name", None)
    return Source(name if isinstance(name, str) and name else _IN_MEMORY, None, bytes(data))
