"""The paper's reproduction on a device, at sizes that say nothing about the paper."""

import json
import re

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.frame import relative_rmse
from burnish.study.paper import PaperSettings, measure_paper
from burnish.study.paper.scenes import glossy, sphere_camera, sphere_scene, wall_camera, wall_scene
from burnish.study.paper.settings import CELLS, FILTERS, SHARES
from burnish.study.paper.truth import draw_truth, truth_maps

TINY = PaperSettings(
    face_size=32,
    seeds=(1, 2),
    pyramid_sizes=(8, 16),
    frame_size=(16, 32),
    frame_samples=(5, 14),
    picture_px=16,
    further_px=8,
    reference_faces=16,
    repeats=1,
)


@pytest.fixture(scope="module")
def paper(device):
    return measure_paper(TINY, device, "burnish study <paper>", progress=False)


@pytest.mark.parametrize("share", SHARES)
def test_the_wall_covers_its_share_exactly(device, share):
    size = (12, 40)
    scene = wall_scene(share, size, glossy((0.1, 0.1)), environments.uniform(1.0, 8))
    frame = burnish.render(scene, wall_camera(), size, burnish.Regular(5), device)
    columns = round(share * size[1])
    assert np.all(frame.alpha[:, :columns] == 1) and np.all(frame.alpha[:, columns:] == 0)
    assert np.all(frame.color[frame.alpha > 0] > 0.5)
    # Neighbouring pixels must not all reflect the same way.
    assert np.ptp(frame.normal[:, :columns, 0]) > 0.5


@pytest.mark.parametrize("roughness", [(0.1, 0.1), (0.2, 0.075)])
def test_the_extrapolated_reference_is_nearer_than_it_says(device, roughness):
    environment = environments.spots(2, 128)
    scene = sphere_scene(glossy(roughness), environment)
    size = (12, 12)
    truth = draw_truth(scene, sphere_camera(), size, truth_maps(environment, 64), device)
    exact = draw_truth(scene, sphere_camera(), size, [environment], device)
    assert exact.error == 0
    covered = exact.shot.covered
    error = relative_rmse(truth.shot.color[covered], exact.shot.color[covered])
    # The exact sum at 128 faces is itself off by about as much: its texels' centres stand for their areas.
    assert truth.error < 2e-3
    assert 0 < error < 3 * truth.error


@pytest.mark.slow
def test_all_that_the_paper_shows_is_measured(paper):
    numbers = paper.numbers
    assert {(row["face_size"], row["filter"]) for row in numbers["pyramids"]} == {
        (size, name) for size in TINY.pyramid_sizes for name in FILTERS
    }
    assert {row["share"] for row in numbers["frames"]} == set(SHARES)
    assert all(row["covered"] == row["share"] for row in numbers["frames"])
    roles = {role for cell in CELLS for role in cell.samplers()}
    assert roles <= {row["role"] for row in numbers["pictures"]}
    assert {row["seed"] for row in numbers["pictures"]} == set(TINY.seeds)
    assert {cell.name for cell in CELLS} == set(paper.pictures)
    errors = [row["relative_rmse"] for row in numbers["pictures"]]
    assert np.all(np.isfinite(errors)) and min(errors) > 0
    counts = {row["cell"]: row["samples"] for row in numbers["pictures"] if row["role"] == "published"}
    assert (counts["14"], counts["17"], counts["270"]) == (14, 17, 271)


@pytest.mark.slow
def test_the_page_holds_everything_and_needs_nothing_else(paper, tmp_path):
    path = tmp_path / "paper.html"
    paper.save_html(path)
    text = path.read_text(encoding="utf-8")
    sections = re.findall(r'<h2 id="(\w+)">', text)
    assert sections == ["short", "table1", "fig7", "fig8", "fig9", "today"]
    assert not re.search(r'(src|href)="(?!data:)', text.replace('src=""', ""))
    assert "http" not in re.sub(r'base64,[^"]*', "", text) and "url(" not in text
    assert text.count("data:image/png;base64,") > 3 * len(CELLS)
    assert "burnish study &lt;paper&gt;" in text and "<paper>" not in text
    for word in ("holds", "does not hold", "not printed in our sources", "matched", "Eqs. 14 to 16"):
        assert word in text
    assert "$" not in re.sub(r"<script>.*</script>", "", text, flags=re.DOTALL)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.slow
def test_the_numbers_can_be_read_again(paper, tmp_path):
    path = tmp_path / "paper.json"
    paper.save_json(path)
    data = json.loads(path.read_text())
    assert data["pictures"] == paper.numbers["pictures"] and data["frames"] == paper.numbers["frames"]
    assert {"item", "claim", "origin", "holds", "measured", "by"} == set(data["verdicts"][0])
