"""Times that can be compared: everything is warm, the candidates take turns, and the noise is stated.

Taking turns matters more than many runs: a machine that slows down for a while then slows down all of
them. Compilation happens in the warm-up and is kept apart.
"""

import statistics
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from burnish.report import Report

Key = TypeVar("Key", bound=Hashable)
Times = Mapping[str, float]
Measure = Callable[[], Times]

SHADE_KINDS = ("shade", "reference")
"""Kinds of the passes that evaluate the samplers; there is one pass for each class of materials."""


@dataclass(frozen=True)
class Timing:
    """Median of some runs and their noise.

    Parameters
    ----------
    median_ms : float
        Milliseconds.
    deviation_ms : float
        Median absolute deviation from the median: half of the runs lie within it. 0 for one run.
    runs : int
        How many there were.
    """

    median_ms: float
    deviation_ms: float
    runs: int


def summarize(times_ms: Sequence[float]) -> Timing:
    """Reduce runs to their median and noise.

    Parameters
    ----------
    times_ms : sequence of float
        Milliseconds, one for each run; at least one.
    """
    if not times_ms:
        raise ValueError("times_ms: expected at least one run, got none")
    median = statistics.median(times_ms)
    return Timing(median, statistics.median(abs(time - median) for time in times_ms), len(times_ms))


def frame_times(report: Report) -> dict[str, float]:
    """Times of one frame in milliseconds.

    Parameters
    ----------
    report : Report
        Of the frame.

    Returns
    -------
    times : dict
        ``frame_ms``, all passes by the device's clock; ``shade_ms``, those that evaluate the sampler;
        ``wall_ms``, from the call to the arrays without compilation; ``pass NAME`` for every pass.
    """
    times = {f"pass {entry['name']}": float(entry["milliseconds"]) for entry in report.passes}
    shade = sum(entry["milliseconds"] for entry in report.passes if entry["kind"] in SHADE_KINDS)
    return {
        "frame_ms": report.total_ms,
        "shade_ms": float(shade),
        "wall_ms": report.wall_ms - report.compile_ms,
        **times,
    }


class AlternatingRuns(Generic[Key]):
    """Runs of several candidates that take turns.

    Parameters
    ----------
    measures : mapping
        For each candidate a function that runs it once and returns times by name, in milliseconds.
        The caller has run each once before: the first run compiles.
    """

    def __init__(self, measures: Mapping[Key, Measure]) -> None:
        self._measures = dict(measures)
        self._rounds: list[dict[Key, Times]] = []

    @property
    def rounds(self) -> int:
        """Complete rounds so far."""
        return len(self._rounds)

    def run_round(self, after_run: Callable[[Key], None] | None = None) -> None:
        """Run every candidate once; a round that is interrupted does not count.

        Parameters
        ----------
        after_run : callable or None
            Called with the candidate after each of its runs.
        """
        times: dict[Key, Times] = {}
        for key, measure in self._measures.items():
            times[key] = measure()
            if after_run is not None:
                after_run(key)
        self._rounds.append(times)

    def timings(self) -> dict[Key, dict[str, Timing]]:
        """Median and noise of every time of every candidate.

        Returns
        -------
        timings : dict of dict of Timing
            A time that is absent from a run counts as 0 there: its pass did not run.
        """
        result: dict[Key, dict[str, Timing]] = {}
        for key in self._measures:
            runs = [times[key] for times in self._rounds]
            names = dict.fromkeys(name for run in runs for name in run)
            result[key] = {name: summarize([run.get(name, 0.0) for run in runs]) for name in names}
        return result


def time_alternating(
    measures: Mapping[Key, Measure], repeats: int, warm_up: int = 1
) -> dict[Key, dict[str, Timing]]:
    """Warm every candidate up, then let them take turns.

    Parameters
    ----------
    measures : mapping
        As for `AlternatingRuns`.
    repeats : int
        Rounds that count, at least 1.
    warm_up : int
        Rounds before that do not.

    Returns
    -------
    timings : dict of dict of Timing
        By candidate, then by the name of the time.
    """
    if repeats < 1:
        raise ValueError(f"repeats: expected at least 1, got {repeats}")
    for _ in range(warm_up):
        for measure in measures.values():
            measure()
    runs = AlternatingRuns(measures)
    for _ in range(repeats):
        runs.run_round()
    return runs.timings()
