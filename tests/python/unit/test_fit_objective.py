"""The loss that the mixtures of `matched` are fitted by: its gradient, and its closed form against sums."""

import numpy as np
import pytest

pytest.importorskip("scipy", reason="the fit needs the extra `fit`")

from burnish.oracle.matched_table import load_student_tables, mixture_at
from burnish.tables import fit_objective
from burnish.tables.fit_objective import (
    copies,
    loss_and_gradient,
    quantiser,
    scale_weights,
    unpack,
)
from burnish.tables.fit_target import ASPECTS, GAUSSIAN, student_target

TARGETS = {"gaussian": GAUSSIAN, "student": student_target(np.inf), "in a window": student_target(2.7)}


@pytest.mark.parametrize("name", TARGETS)
@pytest.mark.parametrize("samples", [4, 5])
def test_the_gradient_is_that_of_the_loss(samples, name, rng):
    target = TARGETS[name]
    start = quantiser(samples, 4.5, 101, target).unknowns
    start = start + 0.05 * rng.standard_normal(start.size)
    if samples % 2:  # the centre stays at 0
        start.reshape(4, len(ASPECTS), -1)[:2, :, 0] = 0
    loss, gradient = loss_and_gradient(start, samples, 0.1, 1.0, target)
    assert np.isfinite(loss)
    for _ in range(5):
        step = 1e-6 * rng.standard_normal(start.size) * (gradient != 0)
        ahead = loss_and_gradient(start + step, samples, 0.1, 1.0, target)[0]
        behind = loss_and_gradient(start - step, samples, 0.1, 1.0, target)[0]
        assert (ahead - behind) / 2 == pytest.approx(gradient @ step, rel=1e-5, abs=1e-12)


def gaussian(x1, x2, v1, v2):
    return np.exp(-0.5 * (x1**2 / v1 + x2**2 / v2)) / (2 * np.pi * np.sqrt(v1 * v2))


@pytest.mark.parametrize("window", [np.inf, 2.7, 1.4])
def test_students_density_is_a_sum_of_gaussians(window):
    target = student_target(window)
    radius = np.linspace(0, 8, 50)
    sums = np.sum(
        target.share * np.exp(-(radius[:, None] ** 2) / target.spread) / (np.pi * target.spread), axis=1
    )
    exact = (1 + radius**2) ** -2 * np.exp(-(radius**2) / (2 * window**2)) / np.pi
    # What the window leaves is scaled to 1.
    np.testing.assert_allclose(sums / sums[0], exact / exact[0], rtol=0.02, atol=1e-5)
    assert np.sum(target.share) == pytest.approx(1)


def test_mixtures_for_lobes_with_a_tail_are_round_on_short_ones():
    """What is not turns with the plane of view, where a smooth picture shows a star around the normal."""
    for table in load_student_tables():
        for count, rows in table.items():
            mixture = mixture_at(rows, count, 1.0)
            along, across = (np.sum(mixture.w * (y**2 + mixture.s**2)) for y in (mixture.y1, mixture.y2))
            skew = np.sum(mixture.w * mixture.y1 * mixture.y2)
            if count > 3:  # fewer lie on a line
                assert abs(along - across) < 0.05 * (along + across), count
                assert abs(skew) < 0.03 * (along + across), count


def test_the_closed_form_is_the_sum_of_blurred_differences(monkeypatch):
    # Of the one aspect, without the terms of the kernel's error, of moments and of neighbours.
    samples, node = 3, 20
    mixtures = unpack(samples, quantiser(samples, 4.5, 101).unknowns)
    weights = np.zeros(len(ASPECTS))
    weights[node] = 1.0
    monkeypatch.setattr(fit_objective, "node_weights", lambda samples: weights)
    monkeypatch.setattr(fit_objective, "_SMOOTHNESS", 0.0)
    loss = loss_and_gradient(mixtures.unknowns, samples, 0.0, 0.0)[0]

    rho = ASPECTS[node]
    axis = np.linspace(-170, 170, 1361)
    x1, x2 = np.meshgrid(axis, axis, indexing="ij")
    area = (axis[1] - axis[0]) ** 2
    numerator = denominator = 0.0
    for c, sigma in zip(scale_weights(samples)[:, node], fit_objective._SCALES, strict=True):
        lobe = gaussian(x1, x2, 0.5 * rho**2 + sigma**2, 0.5 + sigma**2)
        mixture = np.zeros_like(lobe)
        for k, count in enumerate(copies(samples)):
            v = np.exp(2 * mixtures.log_s[node, k]) + sigma**2
            mass = mixtures.share[node, k] / samples
            for sign in (1.0, -1.0)[: int(count)]:
                at1, at2 = sign * rho * mixtures.y1[node, k], sign * mixtures.y2[node, k]
                mixture += mass * gaussian(x1 - at1, x2 - at2, v, v)
        numerator += c * np.sum((lobe - mixture) ** 2) * area
        denominator += c * np.sum(lobe**2) * area
    assert loss == pytest.approx(numerator / denominator, rel=1e-3)


def test_sharpness_counts_on_short_lobes_and_wider_light_on_long_ones():
    weights = scale_weights(14)
    assert weights[0, 0] > 100 * np.sum(weights[1:3, 0])
    assert weights[0, -1] < weights[2, -1]
