"""Studies on a device: errors are those of the frames, and points agree with pictures."""

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import burnish
from burnish import builtin
from burnish.study import Points, StudyInterrupted, accuracy, measure_errors, sweep

SIZE = (24, 32)
REFERENCE = "reference:0.1"


@pytest.fixture(scope="module")
def scene():
    scene = builtin.make_scene("sphere")
    scene.environment = builtin.make_environment("studio", 16)
    return scene


def measure(scene, device, samplers=("regular:5", "importance:9:fibonacci"), **options):
    defaults = {"reference": REFERENCE, "size": SIZE, "repeats": 2, "device": device, "progress": False}
    return accuracy(scene, samplers, **defaults | options)


def hemisphere(rng, count):
    """Views above the plane z = 0."""
    views = rng.normal(size=(count, 3))
    views[:, 2] = np.abs(views[:, 2]) + 0.2
    views = (views / np.linalg.norm(views, axis=1, keepdims=True)).astype(np.float32)
    normals = np.tile(np.float32([0, 0, 1]), (count, 1))
    tangents = np.tile(np.float32([1, 0, 0]), (count, 1))
    return normals, tangents, views


def test_errors_are_those_of_the_frames(scene, device):
    study = measure(scene, device)
    truth = burnish.render(scene, size=SIZE, sampler=burnish.Reference(0.1), device=device)
    few = burnish.render(scene, size=SIZE, sampler=burnish.Importance(9, points="fibonacci"), device=device)
    row = study.rows[1]
    assert row["relative_rmse"] == pytest.approx(few.error(truth), rel=1e-6)
    assert row["reference_standard_error"] == truth.report.standard_error
    errors = measure_errors(few.color, truth.color, truth.alpha > 0)
    assert {name: row[name] for name in errors.as_dict()} == errors.as_dict()
    assert (row["samples"], row["device"], row["driver"]) == (9, device.name, device.driver)
    np.testing.assert_array_equal(study.pictures[0].pictures["importance:9:fibonacci"], few.color)


def test_a_row_has_the_time_of_every_pass(scene, device):
    for row in measure(scene, device).rows:
        assert {"surface", "shade 0", "read back"} <= set(row["passes_ms"])
        assert row["runs"] == 2 and row["compile_ms"] >= 0
        assert 0 < row["shade_ms"] <= row["frame_ms"]


def test_a_given_reference_is_used(scene, device):
    truth = burnish.render(scene, size=SIZE, sampler=burnish.Regular(5), device=device)
    rows = measure(scene, device, reference=truth).rows
    assert rows[0]["relative_rmse"] == 0.0 and rows[1]["relative_rmse"] > 0.0
    assert rows[0]["reference"].startswith("given ")
    rows = measure(scene, device, reference=truth.color).rows
    assert rows[0]["max_error"] == 0.0


def test_a_given_frame_of_another_view_is_refused_and_of_another_spp_warned_of(scene, device):
    other = burnish.Camera.look_at((0.5, 0.5, 5), (0, 0, 0))
    moved = burnish.render(scene, other, SIZE, burnish.Prefiltered(), device)
    with pytest.raises(ValueError, match=r"reference: expected a frame seen by Camera\(.*, got another view"):
        measure(scene, device, reference=moved)
    with pytest.raises(ValueError, match=r"reference: expected a frame of shape \(\d+, \d+\), got \(8, 8\)"):
        measure(scene, device, reference=burnish.render(scene, size=(8, 8), device=device))
    many = burnish.render(scene, size=SIZE, sampler=burnish.Prefiltered(), spp=2, device=device)
    with pytest.warns(RuntimeWarning, match=r"reference: expected a frame of spp 1, got one of spp 2"):
        measure(scene, device, samplers=["prefiltered"], reference=many, repeats=1)


def test_the_reference_itself_can_be_judged(scene, device):
    (row,) = measure(scene, device, samplers=["reference:0.5"], repeats=1).rows
    assert row["method"] == "reference" and row["requested_samples"] is None
    assert row["relative_rmse"] < 0.5


@pytest.mark.parametrize("as_tuple", [True, False])
def test_points_are_judged_as_pictures_are(scene, device, rng, as_tuple):
    normals, tangents, views = hemisphere(rng, 300)
    env, material = scene.environment, scene.materials[0]
    parts = (env, material, normals, tangents, views)
    (row,) = measure(parts if as_tuple else Points(*parts), device, samplers=["regular:14"]).rows
    few, truth = (
        burnish.shade(env, material, sampler, normals, tangents, views, device=device)
        for sampler in (burnish.Regular(14), burnish.Reference(0.1))
    )
    assert row["relative_rmse"] == pytest.approx(measure_errors(few, truth).relative_rmse, rel=1e-6)
    assert row["flip"] is None and row["samples"] == 14 and row["scene"] == "300 points"
    assert row["wall_ms"] > 0 and row["passes_ms"] == {}


def test_a_journal_serves_another_process_too(scene, device, tmp_path):
    path = tmp_path / "study.jsonl"
    first = measure(scene, device, journal=path)
    lines = path.read_text().splitlines()
    again = builtin.make_scene("sphere")
    again.environment = builtin.make_environment("studio", 16)
    second = measure(again, device, journal=path)
    assert second.rows == first.rows and path.read_text().splitlines() == lines
    assert list(second.pictures[0].pictures) == list(first.pictures[0].pictures)
    # other light, other work
    again.environment = builtin.make_environment("sky", 16)
    measure(again, device, journal=path)
    assert len(path.read_text().splitlines()) == 2 * len(lines)


def test_what_cannot_be_drawn_is_refused(device):
    with pytest.raises(ValueError, match=r"scene_or_points: expected a Scene, Points, .*, got int"):
        measure(7, device)


def test_a_sweep_gives_the_rows_of_single_studies(device):
    materials = [burnish.Material(lobes=[burnish.KurtLobe(roughness=m)]) for m in (0.1, 0.4)]
    study = sweep(
        ["regular:5"],
        ["sphere"],
        ["studio:face_size=16"],
        materials,
        ["box", "gauss6"],
        REFERENCE,
        size=SIZE,
        repeats=1,
        progress=False,
    )
    labels = [(row["material"], row["filter"]) for row in study.rows]
    assert labels == [("m 0.1", "box"), ("m 0.1", "gauss6"), ("m 0.4", "box"), ("m 0.4", "gauss6")]
    assert not study.pictures
    scene = burnish.Scene.sphere(materials[1])
    scene.environment = builtin.make_environment("studio", 16)
    (row,) = measure(scene, device, samplers=["regular:5"], filter="gauss6").rows
    assert study.rows[3]["relative_rmse"] == pytest.approx(row["relative_rmse"], rel=1e-6)
    assert study.rows[2]["relative_rmse"] != study.rows[3]["relative_rmse"]


def test_ctrl_c_in_a_long_reference_ends_the_study(scene, device, monkeypatch):
    def interrupt(share, step):
        raise KeyboardInterrupt

    original = burnish.study.subject.draw

    def render(*arguments):
        return original(*arguments[:-1], interrupt if arguments[-1] else None)

    monkeypatch.setattr(burnish.study.subject, "draw", render)
    with pytest.raises(StudyInterrupted) as caught:
        measure(scene, device)
    assert caught.value.study.rows == []


def command(*arguments):
    common = ["--face-size", "16", "--size", "24x32", "--reference", REFERENCE]
    return [sys.executable, "-m", "burnish", "study", "sphere", *common, *map(str, arguments)]


def test_the_command_writes_what_is_asked_for(tmp_path):
    page, rows = tmp_path / "page.html", tmp_path / "rows.json"
    arguments = ["--samplers", "regular:5,14", "--repeats", "1", "-o", page, "--json", rows]
    result = subprocess.run(command(*arguments), capture_output=True, text=True, timeout=240)
    assert (result.returncode, result.stderr) == (0, "")
    assert "regular:14" in result.stdout and f"wrote {page}" in result.stdout
    data = json.loads(rows.read_text())
    assert [row["sampler"] for row in data["rows"]] == ["regular:5", "regular:14"]
    assert data["command"].startswith("burnish study sphere --face-size 16")
    assert "data:image/png;base64," in page.read_text()


def test_ctrl_c_keeps_rows_and_the_same_command_goes_on(tmp_path):
    journal, rows = tmp_path / "j.jsonl", tmp_path / "rows.json"
    lights = [f"spots:seed={seed}" for seed in range(1, 41)]
    arguments = ["--samplers", "regular:5", "--repeats", "1", "--journal", journal, "--json", rows]
    long = command(*arguments, "--env", *lights)
    process = subprocess.Popen(long, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    limit = time.monotonic() + 120
    while not journal.exists() and process.poll() is None and time.monotonic() < limit:
        time.sleep(0.02)
    os.kill(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=120)
    assert process.returncode == 130
    kept = journal.read_text().splitlines()
    assert 1 <= len(kept) < len(lights)
    assert f"interrupted after {len(kept)} rows; the same command takes up from here" in err
    assert len(json.loads(rows.read_text())["rows"]) == len(kept)

    short = command(*arguments, "--env", *lights[: len(kept) + 1])
    assert subprocess.run(short, capture_output=True, timeout=240).returncode == 0
    assert journal.read_text().splitlines()[: len(kept)] == kept
    assert len(journal.read_text().splitlines()) == len(kept) + 1
