"""The command ``burnish study``, with measuring replaced where it would only take time."""

import argparse

import pytest

import burnish
from burnish import cli
from burnish.cli.study import DEFAULT_SAMPLERS
from burnish.cli.study_arguments import parse_roughness
from burnish.samplers import expand_counts, sampler_from_text
from burnish.study.journal import Journal
from burnish.study.runner import StudyInterrupted, run_cells
from burnish.study.store import PictureStore
from study_support import FakeSubject, make_cell


@pytest.fixture
def fake_sweep(monkeypatch):
    """Replace the measuring; gives the arguments that it was called with."""
    calls = []

    def sweep(*arguments, **named):
        calls.append((arguments, named))
        store = PictureStore()
        return run_cells([make_cell(FakeSubject())], Journal(), store, True, False, named["command"])

    monkeypatch.setattr(burnish.study, "sweep", sweep)
    return calls


def test_roughness_is_one_slope_or_two():
    assert parse_roughness("0.1") == (0.1, 0.1)
    assert parse_roughness("0.2/0.075") == (0.2, 0.075)
    for text in ("", "rough", "1/2/3"):
        with pytest.raises(argparse.ArgumentTypeError, match=r"expected a slope such as 0\.1"):
            parse_roughness(text)


def test_default_samplers_are_all_there():
    texts = [one for text in DEFAULT_SAMPLERS for one in expand_counts(text)]
    kinds = {type(sampler_from_text(text)).__name__ for text in texts}
    wanted = {"Regular", "Importance", "Matched", "Prefiltered"}
    assert kinds == {name for name in wanted if hasattr(burnish._core, name)}


def test_arguments_reach_the_sweep(fake_sweep, capsys):
    command = (
        "study sphere plane --env studio spots:seed=3 --roughness 0.1 0.2/0.05 "
        "--samplers regular:5,7 importance:9 --filter box gauss4 --size 20x30 --spp 2 --face-size 16 "
        "--rotate-env 45 --repeats 4 --workers 3 "
        "--reference reference:0.1 --journal j.jsonl --camera 1 --device swift"
    )
    assert cli.main(command.split()) == 0
    ((arguments, named),) = fake_sweep
    samplers, scenes, lights, materials, filters, reference, camera, size, spp, repeats, device = arguments
    assert samplers == ["regular:5", "regular:7", "importance:9"]
    assert scenes == ["sphere", "plane"] and filters == ["box", "gauss4"]
    assert [light.name for light in lights] == ["studio", "spots"]
    assert dict(lights[1].parameters) == {"seed": 3, "face_size": 16} and lights[1].rotation_degrees == 45.0
    assert [material.lobes[0].roughness for material in materials] == [
        pytest.approx((0.1, 0.1)),
        pytest.approx((0.2, 0.05)),
    ]
    assert (reference, camera, size, spp, repeats, device) == ("reference:0.1", "1", (20, 30), 2, 4, "swift")
    assert (named["journal"], named["workers"], named["keep_pictures"]) == ("j.jsonl", 3, False)
    assert named["command"] == f"burnish {command}"
    out = capsys.readouterr().out
    assert "regular:10" in out and "relative_rmse" in out


def test_everything_asked_for_is_written(fake_sweep, tmp_path, capsys):
    names = [tmp_path / name for name in ("page.html", "rows.json", "rows.csv", "curves.svg")]
    options = zip(("-o", "--json", "--csv", "--plot"), map(str, names), strict=True)
    arguments = ["study", "sphere", *(word for pair in options for word in pair)]
    assert cli.main(arguments) == 0
    assert fake_sweep[0][1]["keep_pictures"]
    out = capsys.readouterr().out
    for name in names:
        assert name.stat().st_size > 0 and f"wrote {name}" in out
    assert cli.main([*arguments, "-q"]) == 0
    assert capsys.readouterr().out == ""


def test_one_file_that_cannot_be_written_costs_no_other(fake_sweep, tmp_path, capsys):
    rows, table = tmp_path / "rows.json", tmp_path / "rows.csv"
    rows.symlink_to("/dev/full")
    assert cli.main(["study", "sphere", "--json", str(rows), "--csv", str(table)]) == 2
    out, err = capsys.readouterr()
    assert "regular:10" in out and f"wrote {table}" in out and table.stat().st_size > 0
    assert err == f"burnish study: error: {rows}: cannot be written: No space left on device\n"


def test_an_interruption_writes_what_there_is(monkeypatch, tmp_path, capsys):
    def sweep(*arguments, **named):
        study = run_cells([make_cell(FakeSubject())], Journal(), PictureStore(), True, False)
        raise StudyInterrupted(study)

    monkeypatch.setattr(burnish.study, "sweep", sweep)
    path = tmp_path / "rows.json"
    assert cli.main(["study", "sphere", "--json", str(path), "--journal", str(tmp_path / "j.jsonl")]) == 130
    assert len(burnish.study.Study.load_json(path).rows) == 3
    assert "interrupted after 3 rows; the same command takes up from here" in capsys.readouterr().err


def test_an_interruption_without_a_journal_names_the_option(monkeypatch, capsys):
    def sweep(*arguments, **named):
        raise StudyInterrupted(run_cells([make_cell(FakeSubject())], Journal(), PictureStore(), True, False))

    monkeypatch.setattr(burnish.study, "sweep", sweep)
    assert cli.main(["study", "sphere"]) == 130
    err = capsys.readouterr().err
    assert err == "burnish study: interrupted after 3 rows; --journal FILE would let it go on\n"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "the following arguments are required: SCENE"),
        (["cube"], "scene: expected a file or one of sphere, spheres, plane, shaderball, got 'cube'"),
        (["sphere", "--env", "fog"], "environment: expected a file or one of studio, sky, spots, uniform"),
        (["sphere", "--samplers", "magic:3"], "--samplers: expected matched"),
        (["sphere", "--samplers", "regular:5,many"], "--samplers: expected matched"),
        (["sphere", "--samplers", "regular:5", "regular:5"], "got regular:5 twice"),
        (["sphere", "--roughness", "rough"], "expected a slope such as 0.1, or two such as 0.2/0.075"),
        (["sphere", "--repeats", "0"], "repeats: expected at least 1, got 0"),
        (["sphere", "-o", "page.pdf"], "--output: expected a name ending in .html or .htm, got 'page.pdf'"),
        (["sphere", "--plot", "curve.gif"], "--plot: expected a name ending in .png or .svg or .pdf"),
        (["sphere", "--json", "absent/rows.json"], "absent/rows.json: expected an existing folder"),
        (["sphere", "--journal", "absent/j.jsonl"], "expected an existing folder, got absent"),
    ],
)
def test_errors_are_one_line_and_exit_code_2(capfd, tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    try:
        code = cli.main(["study", *arguments])
    except SystemExit as stop:
        code = stop.code
    out, err = capfd.readouterr()
    assert (code, out) == (2, "")
    assert message in err and err.count("\n") == 1


def test_missing_packages_are_named_before_the_work(monkeypatch, capsys, tmp_path):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib.figure", None)
    monkeypatch.setattr("burnish.cli.study._measure", lambda options: pytest.fail("measured all the same"))
    assert cli.main(["study", "sphere", "-o", str(tmp_path / "page.html")]) == 2
    assert "needs the package matplotlib; install it with: pip install" in capsys.readouterr().err


def test_a_missing_dask_is_named(monkeypatch, capsys):
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    assert cli.main(["study", "sphere", "--workers", "2"]) == 2
    err = capsys.readouterr().err
    assert "needs the package dask[distributed]; install it with: pip install 'burnish[cluster]'" in err
