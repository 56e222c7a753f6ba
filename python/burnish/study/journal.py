"""Rows on disk as they are finished: one line of JSON each, so that a study can take up where it stopped."""

import json
import os
from pathlib import Path

from burnish.images.files import file_error, told_as_file_error
from burnish.study.rows import Row


class Journal:
    """Finished rows by key.

    Parameters
    ----------
    path : path or None
        File of JSON lines, made when the first row comes. What it holds is read; a last line that was cut
        short is dropped. None: rows are kept in memory only.

    Raises
    ------
    FileError
        If the file holds something else.
    """

    def __init__(self, path: str | os.PathLike[str] | None = None) -> None:
        self._path = None if path is None else Path(path)
        self._rows: dict[str, Row] = {}
        if self._path is not None and not self._path.parent.is_dir():
            raise file_error(self._path, f"expected an existing folder, got {self._path.parent}")
        if self._path is not None and self._path.exists():
            self._read(self._path)

    @property
    def picture_folder(self) -> Path | None:
        """Where the pictures of the study lie."""
        return None if self._path is None else self._path.with_name(self._path.name + ".pictures")

    def find(self, key: str, least_runs: int = 1) -> Row | None:
        """Give a row that was timed at least so often, or None."""
        row = self._rows.get(key)
        return row if row is not None and row["runs"] >= least_runs else None

    def append(self, row: Row) -> None:
        """Keep a row; when this returns it is on disk.

        Raises
        ------
        FileError
            If it cannot be written; then the file ends with the row before.
        """
        if self._path is not None:
            with told_as_file_error(self._path):
                _append_line(self._path, json.dumps(row).encode() + b"\n")
        self._rows[row["key"]] = row

    def _read(self, path: Path) -> None:
        text = path.read_bytes()
        complete = text[: text.rfind(b"\n") + 1]
        for number, line in enumerate(complete.splitlines(), start=1):
            try:
                row = json.loads(line)
                self._rows[row["key"]] = row
                int(row["runs"])
            except (ValueError, KeyError, TypeError) as error:
                raise file_error(
                    path, f"line {number}: expected a row of a study, got {line[:60]!r}"
                ) from error
        if len(complete) < len(text):
            # The process died while it wrote: the next row must not be glued to the rest.
            with open(path, "r+b") as stream:
                stream.truncate(len(complete))


def _append_line(path: Path, line: bytes) -> None:
    """Append all of a line, or nothing: the next row must not be glued to a part of this one."""
    with open(path, "ab", buffering=0) as stream:
        end = stream.tell()
        try:
            written = 0
            while written < len(line):  # a disk that is nearly full takes a part
                written += stream.write(line[written:])
            os.fsync(stream.fileno())
        except BaseException:
            stream.truncate(end)
            raise
