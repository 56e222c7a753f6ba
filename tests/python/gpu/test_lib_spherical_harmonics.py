"""Nine harmonics: shader against oracle."""

import numpy as np
from probe import ULP, assert_close, probe, units

from burnish.oracle import spherical_harmonics


def normals(rng):
    return units(np.concatenate([np.eye(3), -np.eye(3), np.ones((1, 3)), rng.normal(size=(5000, 3))]))


def test_harmonics(device, rng):
    n = normals(rng)
    actual = probe(device, "harmonics", n).reshape(len(n), 12)[:, :9]
    # The worst is .32 (3 z^2 - 1): a term of 3 rounds twice, one of 2 twice, and the constant once.
    assert_close("harmonics", actual, spherical_harmonics.harmonics(n), 2 * ULP, normal=n)


def test_irradiance_over_pi(device, rng):
    n = normals(rng)
    # Radiance coefficients from faint to a sun's, of either sign.
    coefficients = rng.normal(size=(len(n), 9, 3)) * 10.0 ** rng.uniform(-3, 4, (len(n), 1, 1))
    scaled = (coefficients * spherical_harmonics.COSINE_FACTORS[:, None] / np.pi).astype(np.float32)
    padded = np.pad(scaled, ((0, 0), (0, 0), (0, 1)), constant_values=1e9)  # alpha is not read
    actual = probe(device, "irradiance_over_pi", n, *np.moveaxis(padded, 1, 0))[:, 0, :3]
    back = scaled * np.pi / spherical_harmonics.COSINE_FACTORS[:, None]
    expected = np.stack([spherical_harmonics.irradiance(back[k], n[k]) for k in range(len(n))]) / np.pi
    # Each term has the harmonic's error; the sum of nine rounds nine times, against the sum of magnitudes.
    size = np.einsum("nk,nkc->nc", np.abs(spherical_harmonics.harmonics(n)), np.abs(scaled))
    allowed = ULP * (9 * size + 2 * np.sum(np.abs(scaled), axis=1))
    assert_close(
        "irradiance_over_pi", actual, np.maximum(expected, 0), allowed, normal=n, coefficients=scaled
    )
