"""How the benchmark runs, keeps and judges; nothing here needs a device."""

import json

import numpy as np
import pytest
from benchmark import __main__ as command
from benchmark.bench import PIPELINES, Bench
from benchmark.hand_loop import pack_pairs, sample_table
from benchmark.scaling_plot import plot_curves

import burnish
from burnish.oracle.cube_map import sample_cube


@pytest.fixture
def bench():
    made = Bench.__new__(Bench)
    made.is_on_cpu = False
    made.repeats, made.figures, made.statements, made.curves = 5, {}, {}, {}
    return made


def test_measures_take_turns_and_the_warm_up_is_not_counted(bench):
    order = []

    def measure(name):
        return lambda: order.append(name) or {"ms": float(len(order))}

    times = bench.alternate("part", {"a": measure("a"), "b": measure("b")}, 3)
    assert order == ["a", "b"] * 4
    assert bench.figures == {"part: a: ms": [3.0, 5.0, 7.0], "part: b: ms": [4.0, 6.0, 8.0]}
    assert times == {"a": {"ms": 5.0}, "b": {"ms": 6.0}}


def test_measures_on_a_cpu_get_the_time_of_all_threads_unless_they_know_it(bench):
    bench.is_on_cpu = True
    times = bench.alternate("part", {"a": lambda: {"ms": 1.0}, "b": lambda: {"ms": 1.0, "cpu": 7.0}})
    assert 0 <= times["a"]["cpu"] < 100
    assert times["b"] == {"ms": 1.0, "cpu": 7.0}


def test_the_better_of_the_pipelines_counts(bench):
    times = bench.best_of("part", {"a": lambda k: lambda: {"ms": 10.0 - k, "other": float(k)}})
    assert times["a"] == {"ms": 10.0 - (PIPELINES - 1), "other": PIPELINES - 1.0}
    assert bench.figures["part: a: ms"] == [10.0 - (PIPELINES - 1)] * 5


def write(path, milliseconds):
    run = {"device": "d", "driver": "1", "date": "2026-11-26", "figures": {"a: b: ms": milliseconds}}
    path.write_text(json.dumps(run))
    return str(path)


@pytest.mark.parametrize(
    ("after", "status"), [([1.0, 1.01, 0.99], 0), ([1.5, 1.51, 1.49], 1), ([0.5] * 3, 0)]
)
def test_compare_exits_with_one_on_a_regression(tmp_path, monkeypatch, capsys, after, status):
    files = write(tmp_path / "before", [1.0, 1.0, 1.01]), write(tmp_path / "after", after)
    monkeypatch.setattr("sys.argv", ["bench", "--compare", *files])
    assert command.main() == status
    assert "a: b: ms" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["nothing"], "PART: expected any of machine"),
        (["--repeats", "0"], "--repeats: expected at least 1, got 0"),
        (["--compare", "a", "b", "c"], "--compare: expected BEFORE or BEFORE AFTER, got 3 files"),
    ],
)
def test_wrong_arguments_are_named(monkeypatch, capsys, arguments, text):
    monkeypatch.setattr("sys.argv", ["bench", *arguments])
    with pytest.raises(SystemExit, match="2"):
        command.main()
    assert text in capsys.readouterr().err


def test_runs_of_one_day_add_up_and_others_are_left(bench):
    today = {"device": "d", "driver": "1", "date": "2026-11-26", "statements": {}, "curves": {}}
    earlier = today | {"figures": {"a": [1.0], "b": [2.0]}}
    run = today | {"figures": {"a": [3.0], "c": [4.0]}}
    assert command.add_runs(earlier, run)["figures"] == {"a": [1.0, 3.0], "b": [2.0], "c": [4.0]}
    assert command.add_runs(earlier | {"date": "2026-11-25"}, run) == run
    assert command.add_runs({}, run) == run


def test_curves_are_drawn(tmp_path, bench):
    bench.figures = {"pixels: 480p: wall": [1.0, 2.0], "pixels: 720p: wall": [3.0]}
    points = [[10, "pixels: 480p: wall"], [20, "pixels: 720p: wall"]]
    curves = {"pixels": {"wall": points}}
    run = {"device": "d", "date": "2026-11-26", "figures": bench.figures, "curves": curves}
    plot_curves(run, tmp_path / "curves.png")
    assert (tmp_path / "curves.png").stat().st_size > 1000


def test_the_loop_gets_the_engines_samples():
    sampler = burnish.Regular(samples=20, footprint="published", normalization="published")
    table = sample_table(sampler, 0.1, 256)
    assert table.shape == (19, 4) and table.dtype == np.float32
    assert table[:, 2].sum() == pytest.approx(1, abs=1e-6)
    # All samples lie within the edge of the lobe, where q is the threshold.
    reach = 0.1 * np.sqrt(-np.log(sampler.threshold))
    assert np.all(np.hypot(table[:, 0], table[:, 1]) <= reach)


def test_pairs_hold_the_map_as_the_lookup_expects_it(rng):
    levels = [rng.random((6, n, n, 3)).astype(np.float16) for n in (4, 2, 1)]
    pairs = pack_pairs(levels).reshape(-1, 4, 2)
    assert len(pairs) == sum(6 * (n + 1) * (n + 2) for n in (4, 2, 1))
    # A texel's middle along each axis. In pairs no axis is mirrored: across z (x, y), y (x, z), x (z, y).
    for face, axes in enumerate(((2, 1), (2, 1), (0, 2), (0, 2), (0, 1), (0, 1))):
        direction = np.zeros(3)
        direction[face // 2] = 1 - 2 * (face % 2)
        direction[axes[0]], direction[axes[1]] = 0.25, -0.75
        column, row = 3, 1  # (0.25 + 1)/2 * 4 = 2.5 and .5, behind a border of one
        at = (face * 6 + row) * 5 + column
        assert pairs[at, :3, 0] == pytest.approx(sample_cube(levels, direction, 0.0), abs=1e-6)
        assert np.array_equal(pairs[at, :, 1], pairs[at + 1, :, 0])
