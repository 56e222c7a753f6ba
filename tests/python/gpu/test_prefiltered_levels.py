"""The levels of prefiltered maps against the sum over every texel of the map."""

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.oracle.cube_map import texel_directions
from burnish.oracle.prefiltered import LEVEL_SLOPE, filter_environment
from burnish.oracle.pyramid import hold_in_halves
from engine_support import edge_texels, smooth_environment_faces


def noise(face_size, seed=9):
    rng = np.random.default_rng(seed)
    return np.float32(np.exp(rng.normal(0, 2, (6, face_size, face_size, 3))))


def against_every_texel(device, environment, count=400):
    """Roughness, radiance and what it should be, (texels, 3), at texels of every level but the map's own."""
    rng = np.random.default_rng(4)
    for roughness, level in environment.prefiltered(device=device)[1:]:
        size = level.shape[1]
        some = rng.permutation(6 * size * size)[:count]
        directions = texel_directions(size).reshape(-1, 3)[some]
        expected = filter_environment(environment.faces, directions, roughness)
        yield roughness, level.reshape(-1, 3)[some], expected


def relative_rmse(got, expected):
    return np.sqrt(np.mean((got - expected) ** 2) / np.mean(expected**2))


@pytest.mark.parametrize("face_size", [1, 2, 4, 64])
def test_levels_have_the_sizes_of_a_pyramid_s_and_slopes_that_double(device, face_size):
    levels = burnish.Environment.from_faces(noise(face_size)).prefiltered(device=device)
    assert [level.shape for _, level in levels] == [
        (6, face_size >> k, face_size >> k, 3) for k in range(len(levels))
    ]
    assert levels[-1][1].shape[1] == 1 and all(level.dtype == np.float32 for _, level in levels)
    assert levels[0][0] == 0.0
    for roughness, level in levels[1:]:
        assert roughness == pytest.approx(LEVEL_SLOPE / level.shape[1])


@pytest.mark.parametrize("face_size", [1, 2, 64])
def test_level_0_is_the_map_rounded_to_half(device, face_size):
    faces = noise(face_size)
    _, finest = burnish.Environment.from_faces(faces).prefiltered(device=device)[0]
    np.testing.assert_array_equal(finest, hold_in_halves(faces))


@pytest.mark.parametrize(("face_size", "limit"), [(16, 0.02), (64, 0.01), (128, 0.01)])
def test_levels_under_smooth_light_are_the_filtered_map(device, face_size, limit):
    """Half a percent is what 64 samples (level 1) leave, and the few above the horizon of the widest lobes.

    Coarse maps vary within a texel, which the sum over texels does not know.
    """
    environment = burnish.Environment.from_faces(smooth_environment_faces(face_size))
    for roughness, got, expected in against_every_texel(device, environment):
        assert relative_rmse(got, expected) < limit, f"roughness {roughness}"
        assert got.mean() == pytest.approx(expected.mean(), rel=2e-3), f"roughness {roughness}"


def test_levels_under_bright_spots_are_near_the_filtered_map(device, spots64):
    """Spots of 3000 times the background show every sample: 4 % at 64 of them, 2.5 % from 128 on."""
    levels = list(against_every_texel(device, spots64))
    errors = [relative_rmse(got, expected) for _, got, expected in levels]
    assert errors[0] < 0.045 and max(errors[1:]) < 0.03, errors
    for _, got, expected in levels:
        assert got.mean() == pytest.approx(expected.mean(), rel=0.015)


@pytest.mark.parametrize("face_size", [1, 2, 4, 64])
def test_constant_map_stays_what_it_is(device, face_size):
    """To the last bit of half precision: weights are divided by their own sum."""
    faces = np.full((6, face_size, face_size, 3), 0.7, np.float32)
    for _, level in burnish.Environment.from_faces(faces).prefiltered(device=device):
        np.testing.assert_array_equal(level, np.float32(np.float16(0.7)))


def test_no_level_has_a_seam(device):
    """Across an edge neighbouring texels differ no more than across the middle of a face."""
    for faces in (smooth_environment_faces(64), environments.spots(face_size=64).faces):
        for _, level in burnish.Environment.from_faces(faces).prefiltered(device=device)[1:5]:
            flat = level.reshape(-1, 3)
            edges = edge_texels(level.shape[1]).values()
            across = max(np.abs(flat[own] - flat[other]).max() for own, other in edges)
            within = max(np.abs(np.diff(level, axis=axis)).max() for axis in (1, 2))
            assert across <= 1.5 * within


@pytest.mark.parametrize("axis", range(6))
def test_light_of_one_face_reaches_its_four_neighbours_alike(device, axis):
    faces = np.zeros((6, 32, 32, 3), np.float32)
    faces[axis] = 1.0
    _, level = burnish.Environment.from_faces(faces).prefiltered(device=device)[2]
    flat = level.reshape(-1, 3)[:, 0]
    fading = []
    for pair, (own, other) in edge_texels(level.shape[1]).items():
        if axis in pair:
            lit_first = np.all(own // level.shape[1] ** 2 == axis)
            fading.append((flat[own], flat[other]) if lit_first else (flat[other], flat[own]))
    assert len(fading) == 4
    for lit, dark in fading:
        # Beside the edge light and dark sum to one but in the corners; the order along an edge may differ.
        middle = slice(2, -2)
        np.testing.assert_allclose(np.sort(lit[middle]), np.sort(fading[0][0][middle]), atol=0.02)
        np.testing.assert_allclose(np.sort(dark[middle]), np.sort(fading[0][1][middle]), atol=0.02)
        assert np.all(lit > dark)


def test_levels_stay_finite_at_the_end_of_half_precision(device):
    faces = np.zeros((6, 16, 16, 3), np.float32)
    faces[0] = 65504.0
    faces[2, 3, 3] = np.inf
    levels = burnish.Environment.from_faces(faces).prefiltered(device=device)
    assert all(np.isfinite(level).all() for _, level in levels)


def test_an_unknown_filter_is_refused(device, smooth64):
    with pytest.raises(ValueError, match="filter: expected one of box, gauss4, gauss6, got 'lanczos'"):
        smooth64.prefiltered("lanczos", device=device)
