"""Medians of alternating runs; no time is asserted."""

import pytest

from burnish.report import Report
from burnish.study.timing import AlternatingRuns, frame_times, summarize, time_alternating


def test_a_summary_is_the_median_and_its_absolute_deviation():
    timing = summarize([1.0, 2.0, 4.0, 8.0, 100.0])
    assert (timing.median_ms, timing.deviation_ms, timing.runs) == (4.0, 3.0, 5)
    assert summarize([3.0]).deviation_ms == 0.0
    with pytest.raises(ValueError, match="times_ms: expected at least one run, got none"):
        summarize([])


def test_frame_times_sum_the_shade_passes_and_leave_compilation_out():
    passes = {"surface": 1.0, "shade 0": 2.0, "shade 1": 4.0, "reference 0": 8.0, "read back": 16.0}
    report = Report(
        {
            "passes": [
                {"name": name, "kind": name.split()[0], "milliseconds": ms} for name, ms in passes.items()
            ],
            "wall_ms": 150.0,
            "compile_ms": 100.0,
        }
    )
    times = frame_times(report)
    assert (times["frame_ms"], times["shade_ms"], times["wall_ms"]) == (31.0, 14.0, 50.0)
    assert {name: times[f"pass {name}"] for name in passes} == passes


def candidates(log, **times):
    """Functions that note their turn and return the next of their times."""
    rest = {name: iter(values) for name, values in times.items()}

    def make(name):
        def measure():
            log.append(name)
            return next(rest[name])

        return measure

    return {name: make(name) for name in times}


def test_candidates_take_turns_and_the_warm_up_does_not_count():
    log = []
    slow, fast = [{"ms": 900.0}, {"ms": 5.0}, {"ms": 7.0}], [{"ms": 800.0}, {"ms": 1.0}, {"ms": 2.0}]
    timings = time_alternating(candidates(log, slow=slow, fast=fast), repeats=2)
    assert log == ["slow", "fast"] * 3
    assert (timings["slow"]["ms"].median_ms, timings["fast"]["ms"].median_ms) == (6.0, 1.5)
    assert timings["slow"]["ms"].runs == 2
    with pytest.raises(ValueError, match="repeats: expected at least 1, got 0"):
        time_alternating({}, repeats=0)


def test_a_pass_that_did_not_run_counts_as_zero():
    runs = AlternatingRuns(
        candidates([], one=[{"pyramid": 3.0, "shade": 1.0}, {"shade": 2.0}, {"shade": 3.0}])
    )
    for _ in range(3):
        runs.run_round()
    timings = runs.timings()["one"]
    assert timings["pyramid"].median_ms == 0.0
    assert timings["shade"].median_ms == 2.0


def test_an_interrupted_round_does_not_count():
    def interrupt():
        raise KeyboardInterrupt

    steps = iter([lambda: {"ms": 1.0}, lambda: {"ms": 3.0}, interrupt])
    runs = AlternatingRuns({"first": lambda: {"ms": 5.0}, "second": lambda: next(steps)()})
    done = []
    runs.run_round(done.append)
    runs.run_round(done.append)
    with pytest.raises(KeyboardInterrupt):
        runs.run_round(done.append)
    assert runs.rounds == 2
    assert done == ["first", "second"] * 2 + ["first"]
    assert runs.timings()["second"]["ms"].median_ms == 2.0
