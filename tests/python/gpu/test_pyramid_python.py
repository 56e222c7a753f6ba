"""The engine's pyramid against the oracle's filter, level by level, seams and corners by themselves."""

import itertools

import numpy as np
import pytest

import burnish
from burnish.filters import FILTERS
from burnish.oracle.cube_map import FACE_AXES
from burnish.oracle.pyramid import build_pyramid, hold_in_halves, reduce_level
from engine_support import edge_texels, smooth_environment_faces


def half_ulp(values):
    """Half the distance to the next number of half precision; below 2^-14 they are 2^-24 apart."""
    exponent = np.floor(np.log2(np.maximum(np.abs(values), 2.0**-14)))
    return 0.5 * 2.0 ** (exponent - 10)


def noise(face_size, seed=9):
    rng = np.random.default_rng(seed)
    return np.float32(np.exp(rng.normal(0, 2, (6, face_size, face_size, 3))))


def assert_rounded_to_nearest(level, finer, filter):
    exact = reduce_level(finer, filter)
    # The engine adds in float32: 36 products of up to the largest texel under the filter.
    slack = 1e-6 * np.abs(exact) + 1e-7 * finer.max() * 2.0**-10
    error = np.abs(level - exact)
    beyond = error > half_ulp(exact) + slack
    assert not beyond.any(), (
        f"{beyond.sum()} of {beyond.size} texels, the worst by {np.max(error - half_ulp(exact))}"
    )


@pytest.mark.parametrize("filter", FILTERS)
@pytest.mark.parametrize("face_size", [1, 2, 4, 8, 64, 256])
def test_every_level_is_the_filter_of_the_one_above_rounded_to_half(device, face_size, filter):
    faces = noise(face_size)
    levels = burnish.Environment.from_faces(faces).pyramid(filter, device=device)
    assert [level.shape[1] for level in levels] == [face_size >> k for k in range(len(levels))]
    assert levels[-1].shape[1] == 1
    np.testing.assert_array_equal(levels[0], hold_in_halves(faces))
    for finer, level in itertools.pairwise(levels):
        assert_rounded_to_nearest(level, finer.astype(np.float64), filter)


@pytest.mark.parametrize("filter", FILTERS)
@pytest.mark.parametrize("face_size", [1, 2, 8, 64])
def test_pyramid_equals_the_oracle_s(device, face_size, filter):
    """From the top in one go: a texel that rounds the other way moves later levels by an ulp at most."""
    faces = noise(face_size, 4)
    levels = burnish.Environment.from_faces(faces).pyramid(filter, device=device)
    for level, expected in zip(levels, build_pyramid(faces, filter, half=True), strict=True):
        assert np.all(np.abs(level - expected) <= 2 * half_ulp(expected))
        assert np.mean(level != expected) <= 0.01


@pytest.mark.parametrize("filter", FILTERS)
def test_light_at_an_edge_reaches_both_faces_alike(device, filter):
    """Lines of light on both sides of an edge stay mirror images, as bright as if there were no edge."""
    size = 16
    edges = edge_texels(size)
    assert len(edges) == 12
    for pair, (own, other) in edges.items():
        faces = np.zeros((6 * size * size, 3), np.float32)
        faces[own[4:12]] = faces[other[4:12]] = 1.0
        levels = burnish.Environment.from_faces(faces.reshape(6, size, size, 3)).pyramid(
            filter, device=device
        )
        coarse_own, coarse_other = edge_texels(size // 2)[pair]
        coarse = levels[1].reshape(-1, 3)
        np.testing.assert_array_equal(
            coarse[coarse_own], coarse[coarse_other], err_msg=f"edge {sorted(pair)}"
        )
        lit = {"box": 1 / 2, "gauss4": 4 / 8, "gauss6": 15 / 32}[filter]  # the taps that meet the two lines
        np.testing.assert_allclose(coarse[coarse_own][4 - 1 : 4 + 1], lit, rtol=1e-3)


@pytest.mark.parametrize("filter", FILTERS)
def test_light_at_a_corner_reaches_three_faces_alike(device, filter):
    size = 8
    for signs in np.ndindex(2, 2, 2):
        corner = 1.0 - 2.0 * np.array(signs)
        at = []
        for face in range(6):
            if FACE_AXES[face, 0] @ corner > 0:
                column = (size - 1) if FACE_AXES[face, 1] @ corner > 0 else 0
                row = (size - 1) if FACE_AXES[face, 2] @ corner > 0 else 0
                at.append((face, row, column))
        assert len(at) == 3
        faces = np.zeros((6, size, size, 3), np.float32)
        for texel in at:
            faces[texel] = 64.0
        level = burnish.Environment.from_faces(faces).pyramid(filter, device=device)[1]
        values = [level[face, row // 2, column // 2, 0] for face, row, column in at]
        assert values[0] > 10 and values[0] == values[1] == values[2], f"corner {corner}: {values}"


@pytest.mark.parametrize("filter", FILTERS)
def test_pyramid_keeps_a_constant(device, filter):
    levels = burnish.Environment.from_faces(np.full((6, 32, 32, 3), 0.7, np.float32)).pyramid(
        filter, device=device
    )
    for level in levels:
        np.testing.assert_array_equal(level, levels[0][0, 0, 0, 0])


@pytest.mark.parametrize("filter", FILTERS)
def test_pyramid_has_no_seam_under_smooth_light(device, filter):
    """Across an edge neighbouring texels differ no more than across the middle of a face."""
    levels = burnish.Environment.from_faces(smooth_environment_faces(64)).pyramid(filter, device=device)
    for level in levels[1:4]:
        size = level.shape[1]
        flat = level.reshape(-1, 3)
        across = max(np.abs(flat[own] - flat[other]).max() for own, other in edge_texels(size).values())
        within = max(np.abs(np.diff(level, axis=axis)).max() for axis in (1, 2))
        assert across <= 1.5 * within


@pytest.mark.parametrize("filter", FILTERS)
def test_pyramid_stays_finite_at_the_end_of_half_precision(device, filter):
    faces = np.zeros((6, 16, 16, 3), np.float32)
    faces[0] = 65504.0
    faces[2, 3, 3] = np.inf
    levels = burnish.Environment.from_faces(faces).pyramid(filter, device=device)
    assert all(np.isfinite(level).all() for level in levels)
    assert levels[0].max() == 65504.0
