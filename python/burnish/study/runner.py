"""Runs cells one after another, keeps what is finished, and makes a study of it."""

import os
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from tqdm import tqdm

from burnish._progress import DELAY_S, REFRESH_S
from burnish.study.journal import Journal
from burnish.study.measure import Cell, Step, measure_cell
from burnish.study.rows import CELL_KEYS, Row
from burnish.study.store import CellPictures, PictureStore
from burnish.study.study import Study

WITHOUT_PICTURES = "Some rows come from a journal that kept no pictures of them."


class StudyInterrupted(KeyboardInterrupt):
    """Ctrl-C came; ``study`` holds the rows that were finished before.

    Parameters
    ----------
    study : Study
        Rows so far.
    """

    def __init__(self, study: Study) -> None:
        super().__init__("interrupted")
        self.study = study


@contextmanager
def step_bar(steps: int, is_shown: bool) -> Iterator[Step]:
    """Show a bar of pictures drawn on stderr, only on a terminal."""
    bar = tqdm(
        total=steps,
        desc="study",
        unit="picture",
        delay=DELAY_S,
        disable=None if is_shown else True,
        leave=False,
        file=sys.stderr,
    )

    shown = time.monotonic() + DELAY_S - REFRESH_S

    def advance(count: int, what: str) -> None:
        nonlocal shown
        bar.set_postfix_str(what, refresh=False)
        bar.update(count)
        if time.monotonic() - shown >= REFRESH_S:  # the bar alone waits for as many pictures as there were
            bar.refresh()
            shown = time.monotonic()

    with bar:
        yield advance


def missing_samplers(cell: Cell, journal: Journal) -> list[str]:
    """Samplers of a cell that the journal has no row for, or one of fewer runs."""
    return [text for text in cell.samplers if journal.find(cell.row_key(text), cell.repeats) is None]


def collect(
    cells: Sequence[Cell],
    journal: Journal,
    store: PictureStore | None,
    command: str = "",
    notes: Sequence[str] = (),
) -> Study:
    """Make a study of all rows that the journal has for these cells, in the cells' order.

    Parameters
    ----------
    cells : sequence of Cell
        In the order of the rows.
    journal : Journal
        Has the rows.
    store : PictureStore or None
        Has the pictures. None: the study gets none.
    command : str
        Command line that made it.
    notes : sequence of str
        What a reader of the study must know.
    """
    rows: list[Row] = []
    pictures: list[CellPictures] = []
    has_all = True
    for cell in cells:
        found = {text: journal.find(cell.row_key(text)) for text in cell.samplers}
        cell_rows = {text: row for text, row in found.items() if row is not None}
        rows += cell_rows.values()
        reference = store.get(cell.reference_key()) if store is not None else None
        if store is None or not cell_rows:
            continue
        if reference is None:
            has_all = False
            continue
        if reference.color.ndim != 3:
            continue  # points make no picture
        drawn = {text: store.get(cell.picture_key(text)) for text in cell_rows}
        description: dict[str, Any] = {key: next(iter(cell_rows.values()))[key] for key in CELL_KEYS}
        colors = {text: picture.color for text, picture in drawn.items() if picture is not None}
        pictures.append(CellPictures(description, reference, colors))
        has_all = has_all and len(colors) == len(cell_rows)
    return Study(rows, pictures, command, [*notes, *([] if has_all else [WITHOUT_PICTURES])])


def run_cells(
    cells: Sequence[Cell],
    journal: Journal,
    store: PictureStore,
    keeps_pictures: bool,
    shows_progress: bool,
    command: str = "",
) -> Study:
    """Measure in this process what the journal does not have yet.

    Parameters
    ----------
    cells : sequence of Cell
        One after another.
    journal : Journal
        Gets every row as soon as its cell is finished.
    store : PictureStore
        References and pictures.
    keeps_pictures : bool
        False: a picture is dropped as soon as it is judged, and a reference when the next cell has another.
    shows_progress : bool
        Whether a bar is shown on a terminal.
    command : str
        Command line that made the study.

    Returns
    -------
    study : Study

    Raises
    ------
    StudyInterrupted
        At Ctrl-C, with the rows so far.
    """
    missing = [missing_samplers(cell, journal) for cell in cells]
    steps = sum(cell.steps(len(samplers)) for cell, samplers in zip(cells, missing, strict=True))
    pictures = store if keeps_pictures else None
    try:
        with step_bar(steps, shows_progress) as advance:
            for index, (cell, samplers) in enumerate(zip(cells, missing, strict=True)):
                if not samplers:
                    continue
                measured = measure_cell(cell, samplers, store, advance, keeps_pictures)
                for row in measured.rows:
                    journal.append(row)
                if not measured.is_complete:
                    raise KeyboardInterrupt
                if not keeps_pictures:
                    forget_reference(store, cell, cells[index + 1 : index + 2])
    except KeyboardInterrupt as interruption:
        raise StudyInterrupted(collect(cells, journal, pictures, command)) from interruption
    return collect(cells, journal, pictures, command)


def forget_reference(store: PictureStore, cell: Cell, following: Sequence[Cell]) -> None:
    """Drop a cell's reference from memory, unless one of the following has the same."""
    if not any(cell.reference_key() == other.reference_key() for other in following):
        store.forget(cell.reference_key())


def open_journal(path: str | os.PathLike[str] | None) -> tuple[Journal, PictureStore]:
    """Open a journal and the pictures beside it."""
    journal = Journal(path)
    return journal, PictureStore(journal.picture_folder)
