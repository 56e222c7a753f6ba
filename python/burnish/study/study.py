"""The result of a study: rows, and what can be made of them."""

import csv
import json
import os
from collections.abc import Sequence
from pathlib import Path

from burnish.images.files import file_error, replacing, write_text
from burnish.study.data import ErrorName, Kind, StudyData, TimeName
from burnish.study.pareto import pareto_front
from burnish.study.rows import Row, cell_of, cell_title, format_value

FORMAT = 1
"""Of the JSON file; grows when a row changes its meaning."""


class Study(StudyData):
    """Errors and times of samplers, and what can be made of them.

    Parameters
    ----------
    rows : list of dict
        One for each sampler in each cell, in the order they were asked for. A cell is one scene, material,
        environment, filter and size. Keys: ``scene``, ``material``, ``environment``, ``filter``, ``height``,
        ``width``, ``spp``; ``sampler`` (text that makes it again), ``method`` (the same without the number of
        samples), ``requested_samples``, ``samples`` (really taken; the largest, where materials differ),
        ``samples_used``; ``relative_rmse``, ``display_rms``, ``flip``, ``max_error``, ``worst_share``,
        ``trimmed_rmse`` (see `Errors`),
        ``reference``, ``reference_standard_error``; ``frame_ms``, ``shade_ms``, ``wall_ms`` (see
        `frame_times`; medians) and their median absolute deviations ``frame_deviation_ms`` and so on,
        ``passes_ms`` (dict by pass), ``compile_ms``, ``runs``; ``device``, ``driver``, ``is_software``,
        ``lookup``, ``date`` (UTC), ``version``, ``warnings``, ``key``.
    pictures : list of CellPictures
        For the page; empty where none were kept, or the study comes from a file.
    command : str
        Command line that made it, for the page.
    notes : list of str
        What a reader must know, such as that workers shared a machine while they took times.
    """

    def __repr__(self) -> str:
        return f"Study({len(self.rows)} rows, {len(self.cells())} cells)"

    def pareto(self, error: ErrorName = "relative_rmse", time: TimeName = "frame_ms") -> list[Row]:
        """Rows that nothing in their cell beats: no other is both as fast and as accurate.

        Parameters
        ----------
        error : str
            Key of the error.
        time : str
            Key of the time.

        Returns
        -------
        rows : list of dict
            Cell by cell, from fast to accurate.
        """
        return [row for cell in self.cells() for row in pareto_front(cell, error, time)]

    def plot(
        self,
        path: str | os.PathLike[str],
        kind: Kind = "error-time",
        error: ErrorName = "relative_rmse",
        time: TimeName = "frame_ms",
    ) -> None:
        """Draw curves, one for each method, one panel for each cell.

        Parameters
        ----------
        path : path
            ``.png``, ``.svg`` or ``.pdf``.
        kind : "error-time", "error-samples", "time-samples" or "difference"
            Error against milliseconds with the Pareto front; error against samples; milliseconds against
            samples; or false-colour pictures of the differences from the reference, which needs pictures.
        error : str
            Key of the error.
        time : str
            Key of the time.

        Raises
        ------
        ImportError
            Without matplotlib, with the command that installs it.
        """
        from burnish.study.plots import draw

        draw(self, Path(path), kind, error, time)

    def save_html(self, path: str | os.PathLike[str]) -> None:
        """Write one page that needs nothing else: table, curves, pictures to compare by a slider.

        Parameters
        ----------
        path : path
            Its folder must exist.

        Raises
        ------
        ImportError
            Without matplotlib, with the command that installs it.
        """
        from burnish.study.page import make_page

        write_text(path, make_page(self))

    def save_json(self, path: str | os.PathLike[str]) -> None:
        """Write the rows as JSON; `load_json` reads them.

        Parameters
        ----------
        path : path
            Its folder must exist.
        """
        data = {"burnish_study": FORMAT, "command": self.command, "notes": self.notes, "rows": self.rows}
        write_text(path, json.dumps(data, indent=1, allow_nan=False) + "\n")

    @classmethod
    def load_json(cls, path: str | os.PathLike[str]) -> "Study":
        """Read what `save_json` wrote; pictures are not in it.

        Parameters
        ----------
        path : path
            A file.

        Raises
        ------
        FileError
            If it is no study.
        """
        try:
            data = json.loads(Path(path).read_text(encoding="utf-8"))
            if data["burnish_study"] != FORMAT:
                raise ValueError(f"format {FORMAT}, got {data['burnish_study']!r}")
            rows = list(data["rows"])
            for row in rows:
                cell_of(row)
            return cls(rows, command=str(data["command"]), notes=list(data["notes"]))
        except FileNotFoundError as error:
            raise file_error(path, "expected a file, found none") from error
        except (ValueError, KeyError, TypeError) as error:
            raise file_error(path, f"expected a study as save_json writes it ({error})") from error

    def save_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the rows as a table; every pass gets a column, ``pass NAME (ms)``.

        Parameters
        ----------
        path : path
            Its folder must exist.
        """
        passes = list(dict.fromkeys(name for row in self.rows for name in row["passes_ms"]))
        plain = [key for key in (self.rows[0] if self.rows else {}) if key not in ("passes_ms", "warnings")]
        with replacing(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream)
            writer.writerow([*plain, *(f"pass {name} (ms)" for name in passes), "warnings"])
            for row in self.rows:
                times = [row["passes_ms"].get(name) for name in passes]
                writer.writerow([*(row.get(key) for key in plain), *times, "; ".join(row["warnings"])])

    def format_table(self, columns: Sequence[str] = ()) -> str:
        """Lay the rows out as text, one block for each cell; a star marks the Pareto front.

        The front is that of frame time and relative RMSE.

        Parameters
        ----------
        columns : sequence of str
            Keys of the rows; empty: the sampler, its samples, errors and times.
        """
        columns = columns or TABLE_COLUMNS
        blocks = []
        for cell in self.cells():
            front = pareto_front(cell, "relative_rmse", "frame_ms")
            lines = [["", *columns]]
            for row in cell:
                mark = "*" if row in front else ""
                lines.append([mark, *(format_value(row.get(key)) for key in columns)])
            widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
            blocks.append("\n".join([cell_title(cell[0]), *(_line(line, widths) for line in lines)]))
        return "\n\n".join(blocks)


TABLE_COLUMNS = (
    "sampler",
    "samples",
    "relative_rmse",
    "worst_share",
    "trimmed_rmse",
    "display_rms",
    "flip",
    "shade_ms",
    "frame_ms",
    "frame_deviation_ms",
)


def _line(words: Sequence[str], widths: Sequence[int]) -> str:
    mark, first, *rest = words
    numbers = [f"{word:>{width}}" for word, width in zip(rest, widths[2:], strict=True)]
    return "  ".join([f" {mark:1} {first:<{widths[1]}}", *numbers]).rstrip()
