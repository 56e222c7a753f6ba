"""Offsets of accumulated pictures: centred for every count, spread as the filter is, the engine's."""

import numpy as np
import pytest

from burnish import _core
from burnish.oracle.filter_offsets import RADIUS_PX, filter_offsets, window_cumulative

COUNTS = [*range(1, 65), 100, 127, 128, 255, 256, 257, 1000, 1024, 4096]


def star_discrepancy(points):
    """Largest difference of share and area over boxes from the unit square's corner, corners at points."""
    x, y = points.T
    edges_x, edges_y = np.append(np.sort(x), 1.0), np.append(np.sort(y), 1.0)
    area = edges_x[:, None] * edges_y[None, :]
    share = [
        np.searchsorted(np.sort(y[inside]), edges_y, side) / len(points)
        for side, inside in (
            *(("right", x <= edge) for edge in edges_x),
            *(("left", x < edge) for edge in edges_x),
        )
    ]
    closed, opened = np.split(np.array(share), 2)
    return max((closed - area).max(), (area - opened).max())


@pytest.mark.parametrize("count", COUNTS)
def test_the_engine_s_offsets_equal_the_oracle_s(count):
    offsets = _core.filter_offsets(count)
    assert offsets.shape == (count, 2) and offsets.dtype == np.float32
    # The engine's window is a table of 1024 steps.
    np.testing.assert_allclose(offsets, filter_offsets(count), atol=1e-5)


@pytest.mark.parametrize("count", [*COUNTS, 30000, 65535, 65536])
def test_the_mean_is_the_pixel_s_centre_and_the_filter_holds_all(count):
    offsets = _core.filter_offsets(count).astype(np.float64)
    assert np.abs(offsets.mean(axis=0)).max() <= 1e-7
    assert np.abs(offsets).max() < RADIUS_PX
    # Each has its mirror image, so that the mean of any power is 0 as well.
    by_place = np.lexsort(offsets.T)
    np.testing.assert_array_equal(offsets[by_place], -offsets[by_place][::-1])
    length2 = np.sum(offsets**2, axis=-1)
    assert length2[0] <= length2.min() + 1e-12


def test_one_picture_passes_through_the_centre():
    np.testing.assert_array_equal(_core.filter_offsets(1), np.zeros((1, 2)))


@pytest.mark.parametrize("count", COUNTS)
def test_offsets_are_spread_as_the_filter_is(count):
    """Along each axis one in every share; over the square no box holds more than a few too many."""
    shares = window_cumulative(_core.filter_offsets(count))
    middles = (np.arange(count) + 0.5) / count
    for axis in (0, 1):
        np.testing.assert_allclose(np.sort(shares[:, axis]), middles, atol=2e-5)
    # Of lattices as of Hammersley's points it grows as ln(n)/n; random points have about .9/sqrt(n).
    assert star_discrepancy(shares) <= (1.0 + 0.8 * np.log(count)) / count


def test_counts_out_of_range_are_refused():
    with pytest.raises(ValueError, match=r"count: expected 1\.\.65536, got 0"):
        _core.filter_offsets(0)
