import itertools

import numpy as np
import pytest

from burnish.filters import FILTERS
from burnish.oracle.pyramid import build_pyramid, reduce_level, round_to_half


@pytest.mark.parametrize("filter", FILTERS)
@pytest.mark.parametrize("size", [1, 2, 16])
def test_constant_light_stays_constant(filter, size):
    for level in build_pyramid(np.full((6, size, size, 3), 0.7), filter):
        np.testing.assert_allclose(level, 0.7, rtol=1e-14)


@pytest.mark.parametrize("filter", FILTERS)
def test_levels_halve_down_to_one_texel(filter, rng):
    sizes = [level.shape for level in build_pyramid(rng.random((6, 32, 32, 3)), filter)]
    assert sizes == [(6, n, n, 3) for n in (32, 16, 8, 4, 2, 1)]


def test_box_keeps_the_mean_of_each_face(rng):
    faces = rng.random((6, 16, 16, 3))
    np.testing.assert_allclose(build_pyramid(faces, "box")[-1][:, 0, 0], faces.mean(axis=(1, 2)), rtol=1e-13)


def test_spread_of_one_texel_is_the_filter():
    # Away from edges a lone texel at an even place lands on the coarse texels whose taps read it.
    faces = np.zeros((6, 16, 16, 1))
    faces[0, 8, 8] = 1
    for filter, along in (("box", [1]), ("gauss4", [1, 3]), ("gauss6", [1, 10, 5])):
        coarse = reduce_level(faces, filter)[0, ..., 0]
        scale = {"box": 2, "gauss4": 8, "gauss6": 32}[filter]
        row = np.array(along if filter != "box" else [1]) / scale
        found = coarse[coarse.sum(axis=1) > 0][:, coarse.sum(axis=0) > 0]
        np.testing.assert_allclose(np.sort(found.ravel()), np.sort(np.outer(row, row).ravel()), rtol=1e-14)


def test_half_levels_are_rounded_to_nearest_even():
    assert round_to_half(1 + 2.0**-11) == 1
    assert round_to_half(1 + 3 * 2.0**-11) == 1 + 2.0**-9
    assert round_to_half(2e-8) == 0
    assert round_to_half(65504.0) == 65504


def test_half_levels_build_on_rounded_ones(rng):
    levels = build_pyramid(rng.random((6, 8, 8, 3)) * 1000, "gauss6", half=True)
    for fine, coarse in itertools.pairwise(levels):
        np.testing.assert_array_equal(fine, fine.astype(np.float16).astype(np.float64))
        np.testing.assert_array_equal(coarse, round_to_half(reduce_level(fine, "gauss6")))


def test_wrong_arguments_are_refused():
    with pytest.raises(ValueError, match=r"faces: expected shape \(6, N, N, c\), N a power of two, got"):
        build_pyramid(np.zeros((6, 3, 3, 3)))
    with pytest.raises(ValueError, match="filter: expected"):
        reduce_level(np.zeros((6, 2, 2, 3)), "sinc")
