"""One cell of a study: one scene under one light, drawn by several samplers that take turns."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from functools import partial
from typing import Any

from burnish._version import __version__
from burnish.samplers import sampler_from_text, sampler_parameters, sampler_to_text
from burnish.study.identity import digest
from burnish.study.metrics import Errors, measure_errors
from burnish.study.rows import Row
from burnish.study.sources import Source
from burnish.study.store import PictureStore, StoredPicture
from burnish.study.subject import Shot, Subject
from burnish.study.timing import AlternatingRuns, Timing

Step = Callable[[int, str], None]
"""Called with a number of pictures that were drawn, 0 while one is being drawn, and what they show."""


@dataclass(frozen=True, eq=False)
class Cell:
    """What is to be measured together.

    Parameters
    ----------
    source : Source
        What is drawn.
    samplers : tuple of str
        As `sampler_to_text` writes them.
    reference : str
        The sampler that draws the truth, or ``given`` where the picture store holds it already.
    repeats : int
        Timed runs of each sampler.
    """

    source: Source
    samplers: tuple[str, ...]
    reference: str
    repeats: int

    def row_key(self, sampler: str) -> str:
        """Name a row: equal for equal work, in every process and at every time."""
        return digest(self.source.key(), sampler, self.reference, __version__)

    def picture_key(self, sampler: str) -> str:
        """Name a sampler's picture in the store."""
        return digest("picture", self.source.key(), sampler, __version__)

    def reference_key(self) -> str:
        """Name the reference in the store."""
        return digest("reference", self.source.reference_key(), self.reference, __version__)

    def steps(self, sampler_count: int) -> int:
        """Number of pictures that measuring so many of the samplers draws: reference, warm-up, runs."""
        return 1 + sampler_count * (1 + self.repeats) if sampler_count else 0


@dataclass(frozen=True, eq=False)
class Measured:
    """What measuring a cell gave.

    Parameters
    ----------
    rows : list of dict
        One for each sampler.
    is_complete : bool
        False: an interruption came after some rounds, and the rows rest on these.
    """

    rows: list[Row]
    is_complete: bool


def _find_reference(cell: Cell, subject: Subject, store: PictureStore, step: Step) -> StoredPicture:
    reference = store.get(cell.reference_key())
    if reference is None:
        shot = subject.draw(
            sampler_from_text(cell.reference), lambda share, _: step(0, f"reference {share:.0%}")
        )
        reference = StoredPicture(shot.color, shot.covered, shot.standard_error)
        store.put(cell.reference_key(), reference)
    return reference


def measure_cell(
    cell: Cell, samplers: Sequence[str], store: PictureStore, step: Step, keeps_pictures: bool = True
) -> Measured:
    """Draw, judge and time.

    Parameters
    ----------
    cell : Cell
        What is drawn, and how often.
    samplers : sequence of str
        Those of the cell's that are still missing.
    store : PictureStore
        Holds the reference afterwards, and every sampler's picture if they are kept.
    step : callable
        Called after each drawing, and now and then during the reference's.
    keeps_pictures : bool
        Whether the samplers' pictures are worth keeping.

    Returns
    -------
    measured : Measured

    Raises
    ------
    KeyboardInterrupt
        If it comes before the first round of timed runs is complete.
    """
    subject = cell.source.open()
    reference = _find_reference(cell, subject, store, step)
    step(1, "reference")
    with subject.keeping_pipelines(len(samplers)):
        return _measure_in_turn(cell, subject, reference, samplers, store, step, keeps_pictures)


def _measure_in_turn(
    cell: Cell,
    subject: Subject,
    reference: StoredPicture,
    samplers: Sequence[str],
    store: PictureStore,
    step: Step,
    keeps_pictures: bool,
) -> Measured:
    made = {text: sampler_from_text(text) for text in samplers}
    shots: dict[str, Shot] = {}
    errors: dict[str, Errors] = {}
    for text, sampler in made.items():
        # The warm-up: it compiles what the sampler needs. Its values are those of every later run.
        shot = shots[text] = subject.draw(sampler)
        errors[text] = measure_errors(shot.color, reference.color, reference.covered)
        if keeps_pictures:
            store.put(cell.picture_key(text), StoredPicture(shot.color, shot.covered))
        step(1, text)

    def run(sampler: Any) -> Mapping[str, float]:
        return subject.draw(sampler).times

    runs = AlternatingRuns({text: partial(run, sampler) for text, sampler in made.items()})
    is_complete = True
    try:
        for _ in range(cell.repeats):
            runs.run_round(partial(step, 1))
    except KeyboardInterrupt:
        if runs.rounds == 0:
            raise
        is_complete = False
    timings = runs.timings()
    rows = [
        _row(cell, subject, reference, text, made[text], shots[text], errors[text], timings[text])
        for text in made
    ]
    return Measured(rows, is_complete)


def _row(
    cell: Cell,
    subject: Subject,
    reference: StoredPicture,
    text: str,
    sampler: Any,
    shot: Shot,
    errors: Errors,
    timings: Mapping[str, Timing],
) -> Row:
    """Put everything that is known of one sampler in one cell into a flat dict; see `Study` for its keys."""
    times: dict[str, Any] = {}
    for name in ("frame", "shade", "wall"):
        timing = timings[f"{name}_ms"]
        times |= {f"{name}_ms": timing.median_ms, f"{name}_deviation_ms": timing.deviation_ms}
    passes = {
        name.removeprefix("pass "): timing.median_ms
        for name, timing in timings.items()
        if name.startswith("pass ")
    }
    return {
        "key": cell.row_key(text),
        **subject.describe(),
        "sampler": text,
        "method": sampler_to_text(sampler, with_count=False),
        "requested_samples": sampler_parameters(sampler).get("samples"),
        "samples": largest_count(shot.samples_used),
        "samples_used": shot.samples_used,
        # JSON knows no NaN: a black reference has no relative error.
        **{name: None if math.isnan(value or 0.0) else value for name, value in errors.as_dict().items()},
        "reference": cell.reference,
        "reference_standard_error": reference.standard_error,
        **times,
        "passes_ms": passes,
        "compile_ms": shot.compile_ms,
        "runs": timings["frame_ms"].runs,
        **subject.device_names(),
        "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        "version": __version__,
        "warnings": list(shot.warnings),
    }


def largest_count(samples_used: str) -> int | None:
    """Read the largest count out of a text such as "14, 13" or "19 (s1)"; None where there is none."""
    counts = [re.match(r"\s*(\d+)", part) for part in samples_used.split(",")]
    return max((int(count[1]) for count in counts if count), default=None)
