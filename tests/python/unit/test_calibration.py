"""Calibration: points see the map under one angle, weights undo their choice, fits find what was put in."""

import math

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.advice.calibration.calibrate import fit_share
from burnish.advice.calibration.fit_errors import Measured, fit_family
from burnish.advice.contrast import measure_spectrum
from burnish.advice.error_model import BANDS, ErrorModel, LobeTraits, evaluate, lobe_features
from burnish.study.calibration_points import points_at_angle
from burnish.study.calibration_set import (
    TRAINING_LOBES,
    UNSEEN_LOBES,
    training_environments,
    unseen_environments,
)


def mirror(points):
    cosines = np.sum(points.normals * points.views, axis=1, keepdims=True)
    return 2 * cosines * points.normals - points.views


def test_points_are_seen_under_the_angle(rng):
    points = points_at_angle(environments.studio(32), 0.2, 0.6, 500, rng)
    np.testing.assert_allclose(np.sum(points.normals * points.views, axis=1), 0.6, atol=1e-5)
    for array in (points.normals, points.tangents, points.views):
        np.testing.assert_allclose(np.linalg.norm(array, axis=1), 1.0, atol=1e-6)
        assert array.dtype == np.float32 and array.flags.c_contiguous


def test_weights_make_the_points_even_again(rng):
    faces = np.full((6, 32, 32, 3), 0.1, np.float32)
    faces[0, 10:12, 10:12] = 500.0
    points = points_at_angle(burnish.Environment.from_faces(faces), 0.05, 0.8, 20000, rng)
    directions = mirror(points)
    assert points.weights.mean() == pytest.approx(1.0, rel=0.03)
    np.testing.assert_allclose(points.weights @ directions / 20000, 0.0, atol=0.03)
    np.testing.assert_allclose((points.weights @ directions**2) / 20000, 1 / 3, atol=0.02)
    # and yet a good part of them reflects the lamp
    assert np.mean(points.weights < 0.01) > 0.2


def test_points_of_an_even_map_weigh_alike(rng):
    points = points_at_angle(environments.uniform(1.0, 1), 0.3, 0.9, 50, rng)
    np.testing.assert_allclose(points.weights, 1.0, rtol=0.1)
    color = np.ones((50, 3), np.float32)
    assert points.relative_rmse(1.1 * color, color) == pytest.approx(0.1, rel=1e-5)


def test_shares_are_lines_over_the_logarithm():
    pairs = [(n, 0.3 + 0.1 * math.log(n) + noise) for n in (2, 8, 32) for noise in (-0.2, 0.0, 0.2)]
    line = fit_share(pairs)
    assert line["at_1"] == pytest.approx(0.3, abs=1e-3) and line["per_log_count"] == pytest.approx(
        0.1, abs=1e-3
    )
    assert fit_share([(1, 0.5), (1, 0.7), (1, 0.6)])["at_1"] == pytest.approx(0.6)


def test_a_fit_finds_the_errors_it_was_given():
    pytest.importorskip("scipy")
    coefficients = {
        "amplitude": np.linspace(-4.0, -1.0, len(BANDS)).tolist(),
        "power": [0.7] * len(BANDS),
        **{"aspect": 0.3, "aspect_over_count": 0.5, "width": 0.2, "fresnel": 0.1, "alpha": 0.0, "suns": -5.0},
    }
    spectra = [measure_spectrum(environments.spots(seed, 32)) for seed in (5, 6)]
    lobes = [
        LobeTraits((a, b), fresnel) for a, b in ((0.1, 0.1), (0.3, 0.1), (0.5, 0.5)) for fresnel in (0, 1)
    ]
    rows = []
    for spectrum in spectra:
        for lobe in lobes:
            features = lobe_features(lobe, 0.7, spectrum)
            for count in (4, 14, 48):
                square, left = evaluate(coefficients, features, count)
                rows.append(Measured(features, count, math.sqrt(square / left)))
    fitted, spread = fit_family(rows)
    assert spread < 0.05
    for row in rows:
        square, left = evaluate(fitted, row.features, row.count)
        assert math.sqrt(square / left) == pytest.approx(row.error, rel=0.2)


def test_a_sampler_that_takes_suns_out_sees_less_contrast():
    spectrum = measure_spectrum(environments.sky(face_size=128))
    lobe = LobeTraits((0.1, 0.1))
    whole, split = (lobe_features(lobe, 0.9, spectrum, has_split) for has_split in (False, True))
    assert split.energies.sum() < 0.1 * whole.energies.sum()
    assert (split.suns > 0).all() and (whole.suns == 0).all()
    np.testing.assert_array_equal(split.left, whole.left)
    model = ErrorModel()
    assert model.predict("matched", 14, [(lobe, 1.0)], spectrum) < 0.5 * model.predict(
        "regular", 14, [(lobe, 1.0)], spectrum
    )


def test_nothing_is_both_fitted_and_judged():
    assert not set(training_environments()) & set(unseen_environments())
    slopes = [{lobe.roughness for lobe in lobes.values()} for lobes in (TRAINING_LOBES, UNSEEN_LOBES)]
    assert not slopes[0] & slopes[1]
