"""Sheen: shader against oracle over all of its range, from the normal to the horizon."""

import numpy as np
import pytest
from probe import directions_above, probe

from burnish.oracle.lobe import sheen
from burnish.oracle.lobe.base import slopes
from burnish.oracle.lobe.sheen import SheenLobe, sheen_alpha

COUNT = 3000
LOBES = [SheenLobe(roughness) for roughness in (0.0, 0.1, 0.3, 0.6, 1.0)]
IDS = [f"{lobe.roughness:g}" for lobe in LOBES]


def directions(rng):
    return directions_above(rng, COUNT, -3)


def alpha_of(lobe):
    return np.float32([[sheen_alpha(lobe)]])


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_masking(device, rng, lobe):
    x = np.float32(np.concatenate([[0, 1e-3, 0.5, 1], rng.random(COUNT)]))
    curve = probe(device, "sheen_curve", x, 0.0, alpha_of(lobe))[:, 0, 0]
    np.testing.assert_allclose(curve, sheen._curve(np.float64(x), sheen_alpha(lobe)), rtol=1e-5, atol=1e-5)
    masked = probe(device, "sheen_lambda", x, 0.0, alpha_of(lobe))[:, 0, 0]
    np.testing.assert_allclose(masked, sheen.sheen_lambda(np.float64(x), sheen_alpha(lobe)), rtol=1e-4)


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_reflectance(device, rng, lobe):
    i, o = directions(rng), directions(rng)
    h = probe(device, "sheen_half_vector", i, o, alpha_of(lobe))[:, 0, :3]
    expected = np.float64(i) + np.float64(o)
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    np.testing.assert_allclose(h, expected, atol=1e-6)
    got = probe(device, "sheen_brdf", i, o, alpha_of(lobe))[:, 0, 0]
    brdf = sheen._value(np.float64(i), np.float64(o), lobe)
    # The power of a sine has the sine's rounding, 1/alpha times.
    np.testing.assert_allclose(got, brdf, rtol=1e-4 + 1e-6 / sheen_alpha(lobe), atol=1e-6 * brdf.max())
    d = probe(device, "sheen_d", np.float32(expected), 0.0, alpha_of(lobe))[:, 0, 0]
    a, sine2 = sheen_alpha(lobe), expected[:, 0] ** 2 + expected[:, 1] ** 2
    np.testing.assert_allclose(
        d,
        (2 + 1 / a) * np.maximum(sine2, 1e-30) ** (0.5 / a) / (2 * np.pi),
        rtol=1e-4 + 1e-6 / a,
        atol=1e-6 / a,
    )


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_places_of_the_plane(device, rng, lobe):
    o, p = directions(rng), np.float32(rng.normal(size=(COUNT, 2)))
    p[:4] = 0
    got = probe(device, "sheen_at", o, p, alpha_of(lobe))
    light = sheen.reflect(np.float64(o), lobe, np.float64(p) * slopes(lobe))
    np.testing.assert_allclose(got[:, 0, :3], light.omega_i, atol=2e-6)
    np.testing.assert_allclose(
        got[:, 1, 0], light.base, rtol=1e-3 + 2e-6 / sheen_alpha(lobe), atol=1e-6 * light.base.max()
    )
    stretch = sheen.stretch(np.float64(o), lobe, p * slopes(lobe), p * slopes(lobe)) * np.prod(slopes(lobe))
    np.testing.assert_allclose(got[:, 1, 1], stretch, rtol=1e-5)
