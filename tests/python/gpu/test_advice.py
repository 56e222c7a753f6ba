"""The inverse question on a device: targets are met, estimates rank errors, scenes are left as they were.

The whole promise, 20 combinations at three targets, is `python -m burnish.advice.calibration.check_targets`,
whose table is in docs/targets.md. Here a few small ones, with a generous bound.
"""

import json
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.advice import cost_model
from burnish.advice.cost_model import Traits
from burnish.advice.families import FAMILIES
from burnish.advice.probe import Probe, scaled_size
from burnish.advice.reduced_maps import reduced_face_size
from burnish.advice.truth import DENSE, draw_dense, draw_truth, extrapolate, view_cosines

SIZE = (48, 48)


MEASURE_RATES, MEASURE_FIXED_NS = cost_model.measure_rates, cost_model.measure_fixed_ns
PRICES = {"matched": 10.0, "regular": 10.0, "importance": 12.0, "prefiltered": 30.0}


@pytest.fixture(autouse=True)
def made_up_prices(tmp_path, monkeypatch):
    """Measuring prices compiles many pipelines, and what is tested here is errors."""
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    monkeypatch.setattr(
        cost_model,
        "measure_rates",
        lambda device, family, traits: {"1": PRICES[family], "2": 2 * PRICES[family]},
    )
    monkeypatch.setattr(cost_model, "measure_fixed_ns", lambda device: 20.0)


def sphere(lobe, environment, **fields):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[lobe], **fields))
    scene.environment = environment
    return scene


def truth_of(scene, device, size=SIZE):
    dense = draw_dense(scene, None, size, "gauss6", device)
    return draw_truth(scene, None, size, "gauss6", device, reduced_face_size(list(scene.materials)), dense)


def rank_correlation(a, b):
    ranks = [np.argsort(np.argsort(values.ravel())) for values in (a, b)]
    return np.corrcoef(*ranks)[0, 1]


@pytest.mark.parametrize(
    ("lobe", "environment", "target"),
    [
        (burnish.KurtLobe(0.2), environments.spots(4, 64), 0.05),
        (burnish.KurtLobe((0.3, 0.1)), environments.studio(64), 0.02),
        (burnish.KurtLobe(0.3, r0=0.04, alpha=0.5), environments.sky(face_size=64), 0.02),
    ],
)
def test_a_target_is_met_within_a_factor_of_two(device, lobe, environment, target):
    scene = sphere(lobe, environment)
    frame = burnish.render(scene, size=SIZE, device=device, target_error=target)
    prediction = frame.report.prediction
    reached = frame.error(truth_of(scene, device))
    assert reached <= 2.0 * target, prediction
    assert prediction["meets_target"] and prediction["is_probed"] and prediction["error_reached"] is None
    assert prediction["predicted_error"] == pytest.approx(reached, rel=0.5)
    assert frame.report.sampler["name"] == prediction["sampler"].split(":")[0]
    assert scene.environment is environment


def test_verification_gives_the_error_of_the_frame(device):
    scene = sphere(burnish.KurtLobe(0.25), environments.spots(4, 64))
    frame = burnish.render(scene, size=SIZE, device=device, target_error=0.05, verify=True)
    reached = frame.report.prediction["error_reached"]
    assert reached == pytest.approx(frame.error(truth_of(scene, device)), rel=0.2)
    assert f"error really reached: {100 * reached:.3g} %" in str(frame.report)


def test_several_materials_and_their_diffuse_light_are_priced_and_probed(device):
    materials = [
        burnish.Material(diffuse=0.3, lobes=[burnish.KurtLobe(0.2, r0=0.04, alpha=0.5)]),
        burnish.Material(lobes=[burnish.KurtLobe((0.4, 0.1)), burnish.KurtLobe(0.3, weight=0.2)]),
    ]
    scene = burnish.Scene.spheres(materials, 2)
    scene.environment = environments.studio(64)
    advice = burnish.advise(scene, 0.05, SIZE, device=device)
    assert advice.meets_target and advice.predicted_error <= 0.05
    assert 0 < advice.predicted_ms < max(one.predicted_ms for one in advice.candidates)
    assert (
        burnish.render(scene, size=SIZE, sampler=advice.sampler, device=device).error(truth_of(scene, device))
        <= 2 * 0.05
    )


def test_what_no_sampler_meets_is_said(device):
    scene = sphere(burnish.KurtLobe(0.3), environments.spots(4, 32))
    advice = burnish.advise(scene, 1e-4, (8, 8), device=device)
    assert advice.candidates[-1].family == "reference"
    if not advice.meets_target:
        with pytest.warns(RuntimeWarning, match=r"no sampler is predicted to meet an error of 0\.01 %"):
            burnish.render(scene, size=(8, 8), device=device, target_error=1e-4)


@pytest.mark.parametrize("environment", [None, environments.uniform(0.0, 8)])
def test_a_dark_scene_takes_the_cheapest(device, environment):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(0.3)]))
    scene.environment = environment
    advice = burnish.advise(scene, 0.01, SIZE, device=device)
    assert advice.meets_target and advice.chosen is advice.candidates[0]
    assert any("nothing that is lit" in note for note in advice.notes)


def test_contradictions_are_refused(device):
    scene = burnish.Scene.sphere(burnish.Material())
    with pytest.raises(ValueError, match="sampler: expected None beside a target_error"):
        burnish.render(scene, size=SIZE, sampler=burnish.Regular(), device=device, target_error=0.1)
    with pytest.raises(ValueError, match="verify: expected a target_error beside it, got None"):
        burnish.render(scene, size=SIZE, device=device, verify=True)
    with pytest.raises(ValueError, match="error_estimate: expected a sampler with a number of samples"):
        burnish.render(scene, size=SIZE, sampler=burnish.Reference(), device=device, error_estimate=True)


def test_estimates_rank_the_errors_of_pixels(device):
    scene = sphere(burnish.KurtLobe((0.25, 0.1)), environments.spots(4, 64))
    size = (72, 72)
    frame = burnish.render(scene, size=size, sampler=burnish.Matched(14), device=device, error_estimate=True)
    truth = truth_of(scene, device, size)
    covered = frame.alpha > 0
    error = np.sqrt(np.mean((frame.color.astype(float) - truth.color) ** 2, axis=-1))
    assert rank_correlation(frame.error_estimate[covered], error[covered]) > 0.55
    assert (frame.error_estimate[~covered] == 0).all()
    assert 0.4 < frame.estimated_error() / frame.error(truth) < 2.5


@pytest.mark.parametrize("sampler", [burnish.Matched(14), burnish.Regular(14), burnish.Prefiltered()])
def test_a_uniform_light_leaves_next_to_nothing_to_estimate(device, sampler):
    scene = sphere(burnish.KurtLobe(0.2), environments.uniform(2.0, 16))
    frame = burnish.render(scene, size=SIZE, sampler=sampler, device=device, error_estimate=True)
    assert frame.estimated_error() < 2e-3


def test_weights_that_do_not_add_up_to_the_albedo_show_in_the_estimate(device):
    scene = sphere(burnish.KurtLobe(0.2), environments.uniform(2.0, 16))
    sampler = burnish.Importance(14, points="fibonacci")
    frame = burnish.render(scene, size=SIZE, sampler=sampler, device=device, error_estimate=True)
    truth = burnish.render(scene, size=SIZE, sampler=burnish.Reference(method="quadrature"), device=device)
    assert 0.5 < frame.estimated_error() / frame.error(truth) < 2


def test_the_estimate_is_saved_with_the_picture(device, tmp_path):
    import OpenEXR

    scene = sphere(burnish.KurtLobe(0.2), environments.studio(16))
    frame = burnish.render(scene, size=(12, 16), device=device, error_estimate=True)
    path = tmp_path / "a.exr"
    frame.save(path)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        np.testing.assert_array_equal(file.channels()["error.Y"].pixels, frame.error_estimate)
    assert burnish.render(scene, size=(12, 16), device=device).error_estimate is None


def test_sums_over_reduced_maps_are_the_sums_over_all_texels(device):
    scene = sphere(burnish.KurtLobe(0.25), environments.spots(4, 128))
    all_texels = burnish.render(
        scene, size=(24, 24), sampler=burnish.Reference(method="quadrature"), device=device
    )
    cosines = view_cosines(all_texels.normal, scene.default_camera())
    inner = (all_texels.alpha > 0) & (cosines > 0.2)
    reduced = truth_of(scene, device, (24, 24)).color[inner].astype(float)
    exact = all_texels.color[inner]
    assert np.sqrt(np.sum((reduced - exact) ** 2) / np.sum(exact**2.0)) < 5e-3


def test_view_cosines_fall_toward_the_rim(device):
    for camera in (None, burnish.Camera.orthographic((0, 3, 0.5), (0, 0, 0), half_height=1.2)):
        scene = sphere(burnish.KurtLobe(0.5), environments.uniform(1.0, 4))
        frame = burnish.render(scene, camera, (64, 64), device=device)
        cosines = view_cosines(frame.normal, camera or scene.default_camera())
        covered = frame.alpha > 0
        assert (cosines[~covered] == 0).all() and (cosines <= 1 + 1e-5).all()
        assert cosines[32, 32] > 0.99 and cosines[covered].min() < 0.35


def test_extrapolation_takes_the_dense_sampler_at_unresolved_rims_only():
    fine, coarse, dense = (np.full((2, 2, 3), value, np.float32) for value in (1.0, 1.3, 5.0))
    coarse[0] = 1.003
    is_rim = np.array([[True, False], [True, False]])
    color = extrapolate(fine, coarse, dense, is_rim)
    np.testing.assert_allclose(color[..., 0], [[0.999, 0.999], [5.0, 0.9]], rtol=1e-6)
    np.testing.assert_array_equal(extrapolate(fine, None, dense, is_rim)[..., 0], [[5.0, 1.0], [5.0, 1.0]])


def test_a_probe_without_sums_knows_that_its_dense_sampler_errs(device):
    scene = sphere(burnish.KurtLobe(0.1), environments.spots(4, 64))
    summing, dense = (Probe(scene, None, SIZE, "gauss6", device, most_terms=most) for most in (1e9, 1.0))
    for probe in (summing, dense):
        probe.survey("matched:5")
    assert dense.error("matched:5") == pytest.approx(summing.error("matched:5"), rel=0.15)
    assert dense.error(DENSE) > 0.0 and dense.truth_text == DENSE


def test_a_probe_has_the_shape_of_the_picture_and_its_pixels(device):
    assert scaled_size((1080, 1920), 1080 * 1920 / 4) == (540, 960)
    scene = sphere(burnish.KurtLobe(0.3), environments.studio(32))
    probe = Probe(scene, None, (300, 400), "gauss6", device, covered_pixels=200)
    probe.survey("matched:5")
    height, width = probe.size
    assert width / height == pytest.approx(4 / 3, rel=0.1)
    frame = burnish.render(scene, size=probe.size, sampler=burnish.Matched(5), device=device)
    assert np.sum(frame.alpha > 0) == pytest.approx(200, rel=0.3)


@pytest.mark.parametrize("family", ["matched", "prefiltered"])
def test_prices_are_measured(device, family):
    rates = MEASURE_RATES(device, family, Traits(1, False, 0.0, False))
    assert rates.keys() == {str(count) for count in FAMILIES[family].timed_counts}
    assert all(ns > 0 for ns in rates.values())
    assert MEASURE_FIXED_NS(device) >= 0


@pytest.mark.slow
def test_the_command_gives_a_table_and_a_report(tmp_path):
    report = tmp_path / "advice.json"
    command = "advise sphere --env studio --face-size 32 --size 24x24 --target-error 5% --verify --report"
    result = subprocess.run(
        [sys.executable, "-m", "burnish", *command.split(), str(report)],
        capture_output=True,
        text=True,
        timeout=280,
    )
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.startswith("target 5 %, 24 x 24, on ")
    assert "error really reached" in result.stdout and f"wrote {report}" in result.stdout
    assert json.loads(report.read_text())["meets_target"]


def picture(values):
    """A picture of grey pixels, all of them objects."""
    grey = np.asarray(values, np.float32)[None, :, None]
    return SimpleNamespace(color=np.repeat(grey, 3, axis=-1), alpha=np.ones(grey.shape[:2], np.float32))


@pytest.mark.parametrize(
    ("shown", "least", "most"),
    [
        pytest.param([1.0, 1.0, 1.0, 9.0], 0.5, 1.0, id="a highlight the candidate lacks"),
        pytest.param([1.0, 1.0, 1.0, 1.02], 0.009, 0.011, id="none"),
    ],
)
def test_probe_doubts_a_candidate_that_lacks_a_highlight_of_the_large_picture(
    device, monkeypatch, shown, least, most
):
    """On the small picture the candidate errs .01, less than the dense sampler, and nothing shows."""
    truth, dense, candidate = [1.0, 1.0], [1.1, 1.1], [1.01, 1.01]
    probe = Probe(
        sphere(burnish.KurtLobe(0.3), environments.uniform(face_size=4)), None, SIZE, "gauss6", device
    )
    probe._can_sum, probe._large, probe._truth = True, (1, 4), picture(truth)
    probe._small = (1, 2)
    monkeypatch.setattr(probe, "_dense_pictures", lambda: (picture(dense), picture(shown)))
    monkeypatch.setattr(probe, "_dense_error", lambda size: 0.02)
    drawn = {(1, 2): picture(candidate), (1, 4): picture([1.0] * 4)}
    monkeypatch.setattr(probe, "draw", lambda sampler, size: drawn[size])
    assert least <= probe.error("matched:14") <= most
