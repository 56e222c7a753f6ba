"""Mip levels: shader against oracle, also for texel counts that make no sense."""

import math

import numpy as np
import pytest
from probe import LEAST_NORMAL, ULP, assert_close, probe, rows, units

from burnish.oracle import footprint


@pytest.fixture
def directions(rng):
    """Unit vectors, some along an axis or grazing."""
    grazing = rng.normal(size=(500, 3)) * [1, 1, 1e-6]
    return units(
        np.concatenate([np.eye(3), -np.eye(3), np.ones((1, 3)), grazing, rng.normal(size=(5000, 3))])
    )


def test_mip_level(device, rng):
    beside_one = 1 + ULP * np.arange(-100, 100)
    texels = rows([0, 1, 2, 4, 1024.0**2, 3e38], beside_one, 10.0 ** rng.uniform(-30, 38, 5000))
    actual = probe(device, "mip_level", texels)[:, 0, 0]
    expected = footprint.level_of_texels(texels, 2**130)
    # Vulkan's log2; the halving is exact.
    allowed = 0.5 * np.where(texels < 2, 2.0**-21, 3 * ULP * 2 * np.maximum(expected, 0.5))
    assert_close("mip_level", actual, expected, allowed, texels=texels)


def test_mip_level_of_what_is_no_count(device):
    texels = np.array([0.0, -0.0, -1.0, -3e38, -np.inf, np.nan, np.inf], np.float32)
    levels = probe(device, "mip_level", texels)[:, 0, 0]
    np.testing.assert_array_equal(levels, [0, 0, 0, 0, 0, 0, np.inf])  # samplers clamp the last


def test_texels_exact(device, directions, rng):
    count = len(directions)
    face_texels, area = 1024**2, 10.0 ** rng.uniform(-6, 0, count)
    cos_h = rng.uniform(0.05, 1, count)
    cos_d = rng.choice((0.0, 1e-7, 1.0), count)
    cos_d[::2] = rng.uniform(0, 1, count)[::2]
    factor = (face_texels * area / 14 * cos_h).astype(np.float32)
    cos_d_hz = (cos_d / cos_h).astype(np.float32)
    inverse_largest = (1 / np.max(np.abs(directions), axis=-1)).astype(np.float32)
    actual = probe(device, "texels_exact", (factor, cos_d_hz, inverse_largest))[:, 0, 0]
    # The factors as float32 has them; a pattern's constants go in and out of `lobe_area`.
    expected = footprint.exact_texels(cos_d_hz.astype(float), directions, 1.0, 1, 1) * factor
    # Four products, and three times the rounding of the inverse and of the unit direction's length.
    allowed = 7 * ULP * expected + LEAST_NORMAL
    assert_close(
        "texels_exact", actual, expected, allowed, direction=directions, factor=factor, cos_d_hz=cos_d_hz
    )


def test_published_area_term(device, directions):
    mx, my, threshold = 0.3, 0.05, 0.2
    actual = probe(device, "published_area_term", directions)[:, 0, 0]
    reach = math.sqrt(-math.log(threshold))
    constant = 4 * math.pi * math.sin(math.atan(mx * reach)) * math.sin(math.atan(my * reach))
    expected = footprint.published_area(directions, mx, my, threshold) / constant
    # No differences: squares and sums, 3/2 each, a product, and a square root of 9/2.
    allowed = 7 * ULP * expected + LEAST_NORMAL**0.5
    assert_close("published_area_term", actual, expected, allowed, direction=directions)


def test_texels_published(device, directions, rng):
    count = len(directions)
    factor = (10.0 ** rng.uniform(-3, 5, count)).astype(np.float32)
    term = (10.0 ** rng.uniform(-6, 0, count)).astype(np.float32)
    cosine = (10.0 ** rng.uniform(-6, 0, count)).astype(np.float32)
    cosine[:3] = 1e-6, 1.0, 20.0
    inverse_largest = (1 / np.max(np.abs(directions), axis=-1)).astype(np.float32)
    actual = probe(device, "texels_published", (factor, term, cosine, inverse_largest))[:, 0, 0]
    expected = footprint.published_texels(cosine, directions, term, 1, 4) * factor
    # Two products, a quotient, and the roundings of the inverse and of the unit direction's length.
    allowed = 7 * ULP * expected
    assert_close("texels_published", actual, expected, allowed, factor=factor, term=term, cosine=cosine)


def test_texels_published_stays_finite_at_grazing_half_vectors(device):
    cosine = np.array([1e-6, 1e-8, 0.0, -0.5], np.float32)
    factor, term, inverse_largest = np.float32(2), np.float32(0.5), np.float32(1.25)
    actual = probe(device, "texels_published", (factor, term, cosine, inverse_largest))[:, 0, 0]
    np.testing.assert_allclose(actual, 1 / (0.8 * 1e-6), rtol=6 * ULP)
