"""The comparison of two benchmark runs, on made-up runs whose truth is known."""

import json

import numpy as np
import pytest
from benchmark.compare import (
    FASTER,
    NOISE,
    SLOWER,
    TOO_FEW,
    compare,
    compare_runs,
    ratio_interval,
    read_run,
    table,
)

MARGIN = 0.05


def runs(rng, median, noise=0.02, count=9):
    return list(median * np.exp(noise * rng.standard_normal(count)))


def run_of(figures, **fields):
    return {"device": "d", "driver": "1", "date": "2026-11-26", "figures": figures} | fields


@pytest.mark.parametrize(("ratio", "verdict"), [(1.0, NOISE), (1.02, NOISE), (1.25, SLOWER), (0.8, FASTER)])
def test_a_change_beyond_margin_and_noise_is_told_from_noise(rng, ratio, verdict):
    change = compare_runs("x", runs(rng, 100), runs(rng, 100 * ratio), MARGIN)
    assert change.verdict == verdict
    assert change.low <= change.ratio <= change.high
    assert change.ratio == pytest.approx(ratio, rel=0.04)


def test_noise_as_large_as_the_change_is_noise(rng):
    assert compare_runs("x", runs(rng, 100, 0.3), runs(rng, 115, 0.3), MARGIN).verdict == NOISE


def test_equal_runs_are_rarely_called_changed(rng):
    # Noise of the size of the margin: of 300 comparisons of the same thing at most 1 % may be called changed.
    pairs = [(runs(rng, 10, 0.05), runs(rng, 10, 0.05)) for _ in range(300)]
    verdicts = [compare_runs("x", before, after, MARGIN).verdict for before, after in pairs]
    assert verdicts.count(NOISE) >= 297


def test_a_change_of_a_fifth_is_nearly_always_found(rng):
    pairs = [(runs(rng, 10, 0.03), runs(rng, 12, 0.03)) for _ in range(100)]
    verdicts = [compare_runs("x", before, after, MARGIN).verdict for before, after in pairs]
    assert verdicts.count(SLOWER) >= 95


def test_one_outlier_changes_nothing(rng):
    before = runs(rng, 100, 0.01)
    assert compare_runs("x", before, [*before[1:], 1000.0], MARGIN).verdict == NOISE


def test_too_few_runs_are_not_judged():
    assert compare_runs("x", [1.0, 1.0], [2.0, 2.0, 2.0], MARGIN).verdict == TOO_FEW


def test_the_interval_holds_the_true_ratio_as_often_as_it_says(rng):
    inside = 0
    for _ in range(300):
        low, high = ratio_interval(runs(rng, 1, 0.1), runs(rng, 1.5, 0.1))
        inside += low <= 1.5 <= high
    # 99 %, less what a bootstrap of nine runs lacks.
    assert inside >= 285


def test_figures_of_one_run_alone_and_without_time_are_not_compared(rng):
    before = run_of({"a": runs(rng, 1), "gone": [1.0] * 3, "nothing": [0.0] * 3})
    after = run_of({"a": runs(rng, 1), "new": [1.0] * 3, "nothing": [0.0] * 3})
    changes = compare(before, after, MARGIN)
    assert [change.figure for change in changes] == ["a"]
    text = table(before, after, changes, MARGIN)
    assert "2 figures" not in text and "1 figures are in before only" in text
    assert "0 slower, 0 faster, 1 noise" in text
    assert compare(before, after, MARGIN, "b*") == []


def test_times_of_all_threads_are_compared_where_both_runs_have_them(rng):
    quiet = run_of({"a: ms": runs(rng, 1), "a: cpu": runs(rng, 2)})
    busy = run_of({"a: ms": runs(rng, 3), "a: cpu": runs(rng, 2)})
    assert [(c.figure, c.verdict) for c in compare(quiet, busy, MARGIN)] == [("a: cpu", NOISE)]
    assert [c.verdict for c in compare(quiet, busy, MARGIN, "*")] == [SLOWER, NOISE]
    on_gpu = run_of({"a: ms": runs(rng, 1)})
    assert [c.figure for c in compare(quiet, on_gpu, MARGIN)] == ["a: ms"]


def test_the_table_names_other_devices_and_shouts_regressions(rng):
    before, after = run_of({"a": runs(rng, 1)}), run_of({"a": runs(rng, 2)}, driver="2")
    text = table(before, after, compare(before, after, MARGIN), MARGIN)
    assert "not the same device and driver" in text
    assert "SLOWER" in text
    assert "median of all ratios: 2.0" in text


def test_read_run_refuses_other_files(tmp_path):
    path = tmp_path / "run.json"
    path.write_text(json.dumps({"shading": {}}))
    with pytest.raises(ValueError, match="expected what --json writes"):
        read_run(path)
    path.write_text(json.dumps(run_of({"a": [1.0]})))
    assert read_run(path)["figures"] == {"a": [1.0]}
