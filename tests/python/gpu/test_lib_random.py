"""Whole-number points: shader and oracle agree to the last bit."""

import numpy as np
from probe import probe, words

from burnish.oracle import random
from burnish.oracle.chi_square import chi_square_test

EXTREMES = np.array([0, 1, 2**16 - 1, 2**16, 2**31 - 1, 2**31, 2**32 - 1], np.uint32)


def integers(rng, count=20000):
    return np.concatenate([EXTREMES, rng.integers(0, 2**32, count, np.uint32)])


def test_hash_uint(device, rng):
    x = integers(rng)
    np.testing.assert_array_equal(words(probe(device, "hash_uint", x))[:, 0, 0], random.hash_uint(x))


def test_hashes_of_successive_numbers_are_distinct_and_even(device):
    hashes = words(probe(device, "hash_uint", np.arange(2**18, dtype=np.uint32)))[:, 0, 0]
    assert len(np.unique(hashes)) == len(hashes)
    for shift in (0, 10, 22):  # low, middle and high bits
        observed = np.bincount(hashes >> shift & 1023, minlength=1024)
        assert chi_square_test(observed, np.full(1024, 256.0)) > 1e-4


def test_unit_from_uint(device, rng):
    x = integers(rng)
    actual = probe(device, "unit_from_uint", x)[:, 0, 0]
    np.testing.assert_array_equal(actual, random.unit_from_uint(x))
    assert actual.min() == 0 and actual.max() == 1 - 2.0**-24


def test_recurrence_2d(device, rng):
    index, seed = integers(rng), integers(rng)[::-1]
    actual = probe(device, "recurrence_2d", (index, seed))[:, 0, :2]
    np.testing.assert_array_equal(actual, random.recurrence_2d(index, seed))


def test_recurrence_3d(device, rng):
    index, seed = integers(rng), integers(rng)[::-1]
    actual = probe(device, "recurrence_3d", (index, seed))[:, 0, :3]
    np.testing.assert_array_equal(actual, random.recurrence_3d(index, seed))


def test_recurrence_3d_x(device, rng):
    index, seed = integers(rng), integers(rng)[::-1]
    actual = words(probe(device, "recurrence_3d_x", (index, seed)))[:, 0, 0]
    np.testing.assert_array_equal(actual, random.recurrence_3d_x(index, seed))


def test_dither(device, rng):
    column, row, picture = (rng.integers(0, end, 20000) for end in (2**14, 2**14, 2**16))
    actual = probe(device, "dither", np.stack([column, row, picture], -1).astype(np.uint32))[:, 0, 0]
    np.testing.assert_array_equal(actual, random.dither(np.stack([column, row], -1), picture))


def test_dither_spreads_thresholds_over_pixels_and_pictures():
    pixels = np.stack(np.meshgrid(np.arange(64), np.arange(64), indexing="ij"), -1)
    shares = np.arange(1, 16) / 16
    for block in np.lib.stride_tricks.sliding_window_view(random.dither(pixels, 3), (8, 8))[::5, ::5].reshape(
        -1, 64
    ):
        # Independent thresholds would miss by 6 % on average, and by 15 % somewhere.
        assert np.abs((block[:, None] < shares).mean(0) - shares).max() < 0.08
    over_pictures = random.dither(np.array([5, 9]), np.arange(16))
    assert np.abs((over_pictures[:, None] < shares).mean(0) - shares).max() < 0.1


def test_points_of_one_seed_fill_the_square_evenly(device):
    count = 4096
    points = probe(device, "recurrence_2d", (np.arange(count), np.full(count, 7)))[:, 0, :2]
    cells = np.floor(points * 16).astype(int)
    filled = np.bincount(cells[:, 0] * 16 + cells[:, 1], minlength=256)
    # 16 each; independent points would spread by 4 and reach 4 or 28.
    assert filled.min() >= 12 and filled.max() <= 20
