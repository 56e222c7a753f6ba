"""Lafortune's lobe: shader against oracle from a uniform one to a mirror, around several directions."""

import numpy as np
import pytest
from probe import directions_above, probe, units

from burnish.oracle.arrays import dot
from burnish.oracle.lobe import lafortune
from burnish.oracle.lobe.base import slopes
from burnish.oracle.lobe.lafortune import LafortuneLobe

COUNT = 3000
LOBES = [
    LafortuneLobe(c, n)
    for c, n in [
        ((-1, -1, 1), 0.0),
        ((-1, -1, 1), 1.0),
        ((-1, -1, 0.5), 10.0),
        ((1, 1, 1), 3.0),
        ((-1.2, -0.3, 0.9), 40.0),
        ((-1, -1, 1), 1e4),
        ((0.7, -0.7, -0.2), 5.0),
    ]
]
IDS = [f"{lobe.c} {lobe.exponent:g}" for lobe in LOBES]


def views(rng):
    return directions_above(rng, COUNT)


def own(lobe):
    return np.float32([[*lobe.c, lobe.exponent]])


def lights(rng, view, lobe):
    """Directions over the lobe and its foot, a fifth of them anywhere."""
    axis = np.asarray(view, np.float64) * lobe.c
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    near = axis + rng.normal(size=axis.shape) * 2 * slopes(lobe)[0]
    anywhere = rng.random(COUNT) < 0.2
    near[anywhere] = rng.normal(size=(np.count_nonzero(anywhere), 3))
    return units(near)


def relative(lobe):
    """What a power loses: n times the rounding of the vectors that its cosine is of."""
    return 2e-5 + 4e-7 * lobe.exponent


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_power_lobe(device, rng, lobe):
    o = views(rng)
    got = probe(device, "power_lobe", o, 0.0, own(lobe))[:, 0]
    axis, gain = lafortune._axis(np.float64(o), lobe)
    np.testing.assert_allclose(got[:, :3], axis, atol=1e-6)
    np.testing.assert_allclose(got[:, 3], gain, rtol=relative(lobe), atol=1e-25)


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_values_and_densities(device, rng, lobe):
    o = views(rng)
    i = lights(rng, o, lobe)
    axis, _ = lafortune._axis(np.float64(o), lobe)
    i64 = np.float64(i)
    cosine = np.maximum(1 - 0.5 * np.sum((axis - i64) ** 2, axis=-1), 0)
    power = np.where(cosine > 0, cosine**lobe.exponent, 0)
    # A small share of the peak is lost in the rounding of the axis.
    foot = 2e-6 * max(lobe.exponent, 1.0) ** 0.5
    close = {"rtol": 20 * relative(lobe), "atol": foot}
    got = probe(device, "cosine_power", np.float32(axis), i, own(lobe))[:, 0, 0]
    np.testing.assert_allclose(got, power, **close)
    got = probe(device, "lafortune_pdf", i, o, own(lobe))[:, 0, 0] * 2 * np.pi / (lobe.exponent + 1)
    np.testing.assert_allclose(got, power, **close)
    plain = lafortune.lafortune_brdf(i64, np.float64(o), lobe)[:, 0]
    expected = plain * np.maximum(i64[:, 2], 0)
    scale = np.maximum(lafortune._axis(np.float64(o), lobe)[1], 1e-25)
    got = probe(device, "lafortune_value", i, o, own(lobe))[:, 0, 0]
    np.testing.assert_allclose(got / scale, expected / scale, **close)


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_lafortune_under_light(device, rng, lobe):
    o = views(rng)
    i = lights(rng, o, lobe)
    for variance in (0.0, 1e-4, 0.2):
        wide = np.concatenate([i, np.full((COUNT, 1), variance, np.float32)], axis=-1)
        got = probe(device, "lafortune_under_light", wide, o, own(lobe))[:, 0, 0]
        expected = lafortune.under_light(np.float64(i), np.float64(o), lobe, np.array(variance))
        scale = np.maximum(lafortune._axis(np.float64(o), lobe)[1], 1e-25)
        np.testing.assert_allclose(
            got / scale,
            expected / scale,
            rtol=20 * relative(lobe),
            atol=2e-6 * max(lobe.exponent, 1.0) ** 0.5,
        )


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_places_of_the_plane(device, rng, lobe):
    o, p = views(rng), np.float32(rng.normal(size=(COUNT, 2)))
    p[:4] = 0
    got = probe(device, "lafortune_at", o, p, own(lobe))
    light = lafortune.reflect(np.float64(o), lobe, np.float64(p) * slopes(lobe))
    np.testing.assert_allclose(got[:, 0, :3], light.omega_i, atol=2e-6)
    scale = np.maximum(lafortune._axis(np.float64(o), lobe)[1], 1e-25)
    np.testing.assert_allclose(got[:, 1, 0] / scale, light.base / scale, rtol=relative(lobe), atol=1e-5)
    stretch = lafortune.stretch(np.float64(o), lobe, p * slopes(lobe), p * slopes(lobe)) * np.prod(
        slopes(lobe)
    )
    np.testing.assert_allclose(got[:, 1, 1], stretch, rtol=1e-5)


@pytest.mark.parametrize("lobe", LOBES, ids=IDS)
def test_axes_of_the_plane(device, rng, lobe):
    o = views(rng)
    axis, _ = lafortune._axis(np.float64(o), lobe)
    axis = units(axis)
    got = probe(device, "lafortune_axes", axis, 0.0, own(lobe))[:, :2, :3]
    np.testing.assert_allclose(got, np.swapaxes(lafortune._axes(np.float64(axis)), -1, -2), atol=3e-5)
    np.testing.assert_allclose(dot(got, np.float64(axis)[:, None]), 0, atol=1e-6)
    linear = probe(device, "lafortune_linear_map", o, 0.0, own(lobe))[:, :2, :3]
    np.testing.assert_allclose(np.linalg.norm(linear, axis=-1), (2 / (lobe.exponent + 1)) ** 0.5, rtol=1e-5)
