"""The loss that the mixtures of `matched` are fitted by: its gradient, and its closed form against sums."""

import numpy as np
import pytest

pytest.importorskip("scipy", reason="the fit needs the extra `fit`")

from burnish.tables import fit_objective
from burnish.tables.fit_objective import ASPECTS, copies, loss_and_gradient, quantiser, scale_weights, unpack


@pytest.mark.parametrize("samples", [4, 5])
def test_the_gradient_is_that_of_the_loss(samples, rng):
    start = quantiser(samples, 4.5, 101).unknowns
    start = start + 0.05 * rng.standard_normal(start.size)
    if samples % 2:  # the centre stays at 0
        start.reshape(4, len(ASPECTS), -1)[:2, :, 0] = 0
    loss, gradient = loss_and_gradient(start, samples, 0.1, 1.0)
    assert np.isfinite(loss)
    for _ in range(5):
        step = 1e-6 * rng.standard_normal(start.size) * (gradient != 0)
        ahead = loss_and_gradient(start + step, samples, 0.1, 1.0)[0]
        behind = loss_and_gradient(start - step, samples, 0.1, 1.0)[0]
        assert (ahead - behind) / 2 == pytest.approx(gradient @ step, rel=1e-5, abs=1e-12)


def gaussian(x1, x2, v1, v2):
    return np.exp(-0.5 * (x1**2 / v1 + x2**2 / v2)) / (2 * np.pi * np.sqrt(v1 * v2))


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
