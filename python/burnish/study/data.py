"""What a study measured."""

from dataclasses import dataclass, field
from typing import Any, Literal

from burnish.study.rows import Row, cell_of
from burnish.study.store import CellPictures

Kind = Literal["error-time", "error-samples", "time-samples", "difference"]
ErrorName = Literal["relative_rmse", "display_rms", "flip", "max_error", "trimmed_rmse"]
TimeName = Literal["frame_ms", "shade_ms", "wall_ms"]


@dataclass(eq=False)
class StudyData:
    """What a study measured; `Study` says what its fields are."""

    rows: list[Row]
    pictures: list[CellPictures] = field(default_factory=list)
    command: str = ""
    notes: list[str] = field(default_factory=list)

    def cells(self) -> list[list[Row]]:
        """Rows by cell, in order."""
        cells: dict[tuple[Any, ...], list[Row]] = {}
        for row in self.rows:
            cells.setdefault(cell_of(row), []).append(row)
        return list(cells.values())
