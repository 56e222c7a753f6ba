"""The error model's parts against closed forms, and the cost model's arithmetic and cache."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.advice import cost_model
from burnish.advice.advise import advise, predict_errors
from burnish.advice.contrast import measure_spectrum
from burnish.advice.cost_model import CostModel, Traits, interpolate_rate, traits_of_class
from burnish.advice.error_model import ErrorModel, LobeTraits, lobes_of
from burnish.advice.families import FAMILIES
from burnish.advice.reduced_maps import reduce_environment, reduced_face_size, reduced_maps

ROUND = Traits(1, False, 0.0, False)


class NamedDevice:
    name, driver, lookup = "a device", "its driver", "sampler"


def test_a_uniform_map_has_no_contrast():
    spectrum = measure_spectrum(environments.uniform(3.0, 16))
    assert spectrum.total == pytest.approx(9.0, rel=1e-6)
    np.testing.assert_allclose(spectrum.lost, 0.0, atol=1e-9)


def test_all_energy_of_a_checkerboard_is_in_its_finest_octave():
    faces = np.ones((6, 8, 8, 3), np.float32)
    faces[:, ::2, ::2] = faces[:, 1::2, 1::2] = 3.0
    spectrum = measure_spectrum(burnish.Environment.from_faces(faces))
    # mean 2, variance 1, but for the texels' different solid angles
    assert spectrum.total == pytest.approx(5.0, rel=1e-3)
    assert spectrum.lost[0] == 0.0
    np.testing.assert_allclose(spectrum.lost[1:], 1.0, rtol=0.01)


def test_energy_is_lost_in_rising_order_and_up_to_the_mean(rng):
    faces = rng.random((6, 32, 32, 3), np.float32)
    spectrum = measure_spectrum(burnish.Environment.from_faces(faces))
    assert (np.diff(spectrum.lost) >= -1e-12).all()
    assert spectrum.total - spectrum.lost[-1] == pytest.approx(0.25, rel=0.02)
    assert spectrum.lost_below(np.array([1e-6]))[0] == 0.0


@pytest.mark.parametrize("family", FAMILIES)
def test_predicted_errors_fall_with_the_count_and_with_the_contrast(family):
    model, counts = ErrorModel(), FAMILIES[family].counts
    hard, easy = (
        measure_spectrum(environments.spots(5, 64, contrast=contrast))
        for contrast in ((30, 3000), (1.1, 1.2))
    )
    lobes = [(LobeTraits((0.1, 0.1)), 1.0)]
    errors = [model.predict(family, n, lobes, hard) for n in counts]
    assert all(few > many for few, many in pairwise(errors))
    assert model.predict(family, counts[0], lobes, easy) < 0.5 * errors[0]


def test_brushed_lobes_are_harder_and_diffuse_light_dilutes():
    model, spectrum = ErrorModel(), measure_spectrum(environments.spots(5, 64))

    def error(material):
        return model.predict("matched", 8, lobes_of(material), spectrum)

    round_lobe = burnish.KurtLobe(0.1)
    plain = error(burnish.Material(lobes=[round_lobe]))
    assert error(burnish.Material(lobes=[burnish.KurtLobe((0.3, 0.3 / 9))])) > 1.3 * plain
    assert error(burnish.Material(diffuse=1.0, lobes=[round_lobe])) < plain
    assert error(burnish.Material(diffuse=1.0)) == pytest.approx(1e-5)


def test_a_scene_without_light_is_predicted_without_error():
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(0.1)]))
    assert max(predict_errors(scene).values()) <= 1e-5


def test_rates_are_straight_lines():
    rates = {5: 10.0, 20: 40.0}
    assert interpolate_rate(rates, 5) == 10.0
    assert interpolate_rate(rates, 10) == pytest.approx(20.0)
    assert interpolate_rate(rates, 64) == pytest.approx(128.0)
    assert interpolate_rate({5: 10.0, 20: 80.0}, 2) == pytest.approx(1.0)  # a price is never below 0
    assert interpolate_rate({1: 3.0}, 1) == 3.0
    assert interpolate_rate({14: 14.0, 64: 64.0, 128: 256.0}, 96) == pytest.approx(160.0)


def test_traits_are_read_from_a_report():
    brushed = traits_of_class({"lobe": 2, "fresnel": 1, "alpha": 1, "anisotropy": 1, "diffuse": 1})
    assert brushed == Traits(2, True, 0.5, True)
    assert traits_of_class({"lobe": 0, "fresnel": 0, "alpha": 0, "anisotropy": 0}) == Traits(
        0, False, 0.0, False
    )
    assert traits_of_class({"lobe": 1, "fresnel": 0, "alpha": 2, "anisotropy": 0}).alpha not in (0.0, 0.5)


def test_rates_are_measured_once_and_kept(tmp_path, monkeypatch):
    measured = []

    def measure(device, family, traits):
        measured.append((family, traits.key()))
        return {"5": 10.0, "20": 40.0}

    monkeypatch.setattr(cost_model, "measure_rates", measure)
    path = tmp_path / "deep" / "cost.json"
    model = CostModel(NamedDevice(), path)
    assert model.shade_ns("matched", 10, ROUND) == pytest.approx(20.0)
    assert model.shade_ns("matched", 10, Traits(2, False, 0.0, False)) == pytest.approx(40.0)
    assert CostModel(NamedDevice(), path).shade_ns("matched", 5, ROUND) == 10.0
    assert measured == [("matched", "round, alpha 0")]
    data = json.loads(path.read_text())
    assert (data["device"], data["driver"], data["version"]) == (
        "a device",
        "its driver",
        burnish.__version__,
    )
    model.forget()
    assert not path.exists()
    model.shade_ns("matched", 5, ROUND)
    assert len(measured) == 2


@pytest.mark.parametrize("text", ["", "{", "[]", '{"rates_ns": 3}', '{"rates": {}}'])
def test_a_damaged_cache_is_measured_again(tmp_path, monkeypatch, text):
    path = tmp_path / "cost.json"
    path.write_text(text)
    monkeypatch.setattr(cost_model, "measure_rates", lambda *_: {"5": 7.0})
    assert CostModel(NamedDevice(), path).shade_ns("matched", 5, ROUND) == 7.0


def test_what_has_no_lobe_costs_nothing_by_the_sampler(tmp_path):
    assert (
        CostModel(NamedDevice(), tmp_path / "cost.json").shade_ns("matched", 5, Traits(0, False, 0.0, False))
        == 0
    )


def test_the_cache_lies_where_the_user_wants_it(tmp_path, monkeypatch):
    monkeypatch.setenv("BURNISH_CACHE", "")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cost_model.cache_path(NamedDevice()).parent == tmp_path / "burnish"
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "own"))
    assert cost_model.cache_path(NamedDevice()).parent == tmp_path / "own"


def test_without_a_cache_prices_last_as_long_as_the_model(monkeypatch):
    monkeypatch.setenv("BURNISH_CACHE", "off")
    assert cost_model.cache_path(NamedDevice()) is None
    monkeypatch.setattr(cost_model, "measure_rates", lambda *_: {"5": 7.0})
    model = CostModel(NamedDevice())
    assert model.shade_ns("matched", 5, ROUND) == 7.0
    model.forget()
    monkeypatch.setattr(cost_model, "measure_rates", lambda *_: {"5": 8.0})
    assert model.shade_ns("matched", 5, ROUND) == 8.0


def test_reduced_maps_are_as_fine_as_the_narrowest_lobe_needs():
    def face_size(*slopes):
        return reduced_face_size([burnish.Material(lobes=[burnish.KurtLobe(m) for m in slopes])])

    assert [face_size(0.05), face_size(0.1), face_size(0.6), face_size(0.6, 0.1)] == [256, 128, 32, 128]
    # The cosine is wide, but a small lamp sets within a texel: 32 would be off by .15 %, 64 is by .05 %.
    assert reduced_face_size([burnish.Material(diffuse=1.0)]) == 64


def test_a_reduced_map_keeps_mean_and_settings(rng):
    env = burnish.Environment.from_faces(rng.random((6, 16, 16, 3), np.float32), exposure=1.5, rotation=0.3)
    small = reduce_environment(env, 4)
    assert small.face_size == 4 and small.exposure == env.exposure
    np.testing.assert_array_equal(small.rotation, env.rotation)
    assert reduce_environment(env, 32) is env


def test_a_scene_gets_its_own_maps_back():
    scene = burnish.Scene.sphere(burnish.Material())
    scene.environment, own = environments.studio(16), environments.sky(face_size=16)
    light = scene.environment
    scene.objects[0].reflects = own

    class StopError(Exception):
        pass

    with pytest.raises(StopError), reduced_maps(scene, 8):
        assert scene.environment.face_size == scene.objects[0].reflects.face_size == 8
        raise StopError
    assert scene.environment is light and scene.objects[0].reflects is own


@pytest.mark.parametrize("target", [0.0, -0.1, 1.5, math.nan, "2%", True, None])
def test_odd_targets_are_refused_before_any_work(target):
    with pytest.raises(ValueError, match=r"target_error: expected a relative error in 0\.0001\.\.1, got"):
        advise(burnish.Scene(), target)
