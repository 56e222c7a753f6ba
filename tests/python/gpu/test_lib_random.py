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


def test_points_of_one_seed_fill_the_square_evenly(device):
    count = 4096
    points = probe(device, "recurrence_2d", (np.arange(count), np.full(count, 7)))[:, 0, :2]
    cells = np.floor(points * 16).astype(int)
    filled = np.bincount(cells[:, 0] * 16 + cells[:, 1], minlength=256)
    # 16 each; independent points would spread by 4 and reach 4 or 28.
    assert filled.min() >= 12 and filled.max() <= 20
