"""The paper's reproduction without a device: reduced maps, formulas, the command."""

import json

import numpy as np
import pytest

import burnish
from burnish import cli, environments
from burnish.cube_layout import cube_solid_angles
from burnish.samplers import sampler_from_text, sampler_to_text
from burnish.study import paper as reproduction
from burnish.study.paper.formulas import estimator_in_furnace, grazing_albedos, pattern_counts
from burnish.study.paper.settings import CELLS, PaperSettings
from burnish.study.paper.truth import reduce_environment, truth_maps


def flux_and_moment(environment):
    """Flux of the whole map, and its first moment."""
    size = environment.face_size
    flux = environment.faces.astype(np.float64) * cube_solid_angles(size)[None, ..., None]
    directions = environments.cube_directions(size)
    return flux.sum(axis=(0, 1, 2)), np.einsum("fyxc,fyxk->ck", flux, directions)


def test_a_reduced_map_keeps_flux_and_place():
    full = environments.spots(3, 64)
    reduced = reduce_environment(full, 16)
    (flux, moment), (reduced_flux, reduced_moment) = map(flux_and_moment, (full, reduced))
    np.testing.assert_allclose(reduced_flux, flux, rtol=1e-6)
    # Means over 4 x 4 texels would miss by as much as a texel's half here and there: 1e-3 of the flux.
    np.testing.assert_allclose(reduced_moment, moment, atol=2e-3 * np.max(flux))


def test_a_constant_map_changes_only_with_the_shape_of_texels():
    reduced = reduce_environment(environments.uniform(2.0, 64), 16).faces
    # A large texel gets its flux from a region twice as wide, whose texels have slightly other solid angles.
    np.testing.assert_allclose(reduced, 2.0, rtol=0.015)


def test_a_small_map_is_summed_as_it_is():
    small = environments.uniform(1.0, 16)
    assert truth_maps(small, 16) == [small]
    assert [one.face_size for one in truth_maps(environments.uniform(1.0, 64), 16)] == [16, 8]
    with pytest.raises(ValueError, match="face_size: expected at most 16, got 32"):
        reduce_environment(small, 32)


def test_formulas_agree_with_the_design():
    counts = {(row["printed"], row["threshold"]): row["samples"] for row in pattern_counts()}
    assert counts == {(19, 0.1): 19, (30, 0.1): 30, (14, 0.2): 14, (17, 0.2): 17, (270, 0.01): 271}
    low = [1 - estimator_in_furnace(slope, 0.0)["clamped"] for slope in (0.1, 0.3, 0.6)]
    assert low == pytest.approx([0.005, 0.04, 0.13], rel=0.15)
    horizon = estimator_in_furnace(0.3, 85.0)
    assert horizon["printed"] < 0.4 < 0.9 < horizon["clamped"] < 1
    albedos = {(row["slope"], row["alpha"]): row["albedo"] for row in grazing_albedos()}
    assert albedos[0.1, 1.0] == pytest.approx(8.4, abs=0.05) and albedos[0.3, 0.0] < 1 < albedos[0.3, 0.5]


@pytest.mark.parametrize("cell", CELLS, ids=lambda cell: cell.name)
def test_samplers_of_a_cell_can_be_made(cell):
    samplers = {role: sampler_from_text(text) for role, text in cell.samplers().items()}
    assert {"published", "importance", "importance_bias", "footprint", "exact"} <= set(samplers)
    published, footprint = samplers["published"], samplers["footprint"]
    assert (published.footprint, published.normalization) == ("published", "published")
    assert (footprint.footprint, footprint.normalization) == ("exact", "published")
    assert published.threshold == pytest.approx(cell.threshold)
    assert len({sampler_to_text(sampler) for sampler in samplers.values()}) == len(samplers)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--paper", "sphere"], "--paper: expected none of the scenes and their arguments, got SCENE sphere"),
        (["--paper", "--env", "sky"], "got --env"),
        (["--paper", "--samplers", "regular:5"], "got --samplers"),
        (["--paper", "--csv", "rows.csv"], "got --csv"),
        (["--paper", "--face-size", "64"], "got --face-size"),
        (["--paper", "--repeats", "0"], "repeats: expected at least 1, got 0"),
        (["--paper", "-o", "paper.pdf"], "--output: expected a name ending in .html or .htm"),
        (["sphere", "--quick"], "--quick: expected --paper beside it"),
    ],
)
def test_arguments_that_make_no_sense_are_refused(monkeypatch, capsys, arguments, message):
    monkeypatch.setattr(reproduction, "measure_paper", lambda *_: pytest.fail("measured all the same"))
    assert cli.main(["study", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == "" and message in err and err.count("\n") == 1


def test_the_command_measures_writes_and_prints(monkeypatch, capsys, tmp_path):
    given = []

    def measure(settings, device, command):
        given.append((settings, device, command))
        numbers = {"pictures": [], "frames": [], "pyramids": []}
        return reproduction.Paper(numbers)

    monkeypatch.setattr(reproduction, "measure_paper", measure)
    monkeypatch.setattr(reproduction, "list_verdicts", lambda _: ["a verdict"])
    monkeypatch.setattr("burnish.study.paper.measure.list_verdicts", lambda _: [])
    path = tmp_path / "paper.json"
    assert cli.main(["study", "--paper", "--quick", "--repeats", "2", "--json", str(path)]) == 0
    ((settings, device, command),) = given
    assert settings == PaperSettings.quick(2) and device is None
    assert command == f"burnish study --paper --quick --repeats 2 --json {path}"
    assert json.loads(path.read_text())["burnish_paper"] == 1
    assert capsys.readouterr().out == f"a verdict\n\nwrote {path}\n"


def test_an_interruption_leaves_nothing(monkeypatch, capsys, tmp_path):
    def measure(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(reproduction, "measure_paper", measure)
    names = ["-o", str(tmp_path / "paper.html"), "--json", str(tmp_path / "paper.json")]
    assert cli.main(["study", "--paper", *names]) == 130
    assert list(tmp_path.iterdir()) == []
    assert "interrupted; nothing half-written is left" in capsys.readouterr().err


def test_the_default_is_the_papers_setup():
    settings = PaperSettings()
    assert settings.face_size == 1024 and settings.frame_size == (1080, 1920)
    assert settings.pyramid_sizes == (256, 512, 1024)
    assert PaperSettings.quick().face_size < settings.face_size
    assert burnish.study.PaperSettings is PaperSettings
