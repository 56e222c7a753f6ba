"""The prefiltered map and its lookup against the sum over every texel."""

import numpy as np
import pytest

from burnish.oracle.albedo import directional_albedo
from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import sample_cube, texel_directions
from burnish.oracle.lobe.kurt import KurtLobe
from burnish.oracle.prefiltered import (
    LEVEL_SLOPE,
    filter_environment,
    prefilter_environment,
    prefiltered_level,
    shade_prefiltered,
)
from burnish.oracle.reference import shade_reference


@pytest.fixture
def faces(rng):
    """Noise of which every texel counts, with a few bright ones."""
    return np.exp(rng.normal(0, 1.5, (6, 32, 32, 3)))


@pytest.mark.parametrize("roughness", [0.15, 0.4, 1.0])
def test_filtered_map_is_what_a_lobe_sees_along_its_normal(roughness, faces, rng):
    """Divided by the albedo of that view; the sum's own weights add up to it within a percent."""
    normals = normalize(rng.normal(size=(20, 3)))
    tangents = rng.normal(size=(20, 3))
    seen = shade_reference(faces, normals, tangents, normals, KurtLobe(roughness))
    albedo = directional_albedo([0.0, 0.0, 1.0], roughness, 0.0)[0]
    np.testing.assert_allclose(filter_environment(faces, normals, roughness), seen / albedo, rtol=0.01)


def test_constant_map_stays_what_it_is():
    for level in prefilter_environment(np.full((6, 16, 16, 3), 0.7)):
        np.testing.assert_allclose(level, 0.7, rtol=1e-12)


def test_levels_are_the_map_and_lobes_twice_as_wide_each_time(faces):
    levels = prefilter_environment(faces)
    assert [level.shape[1] for level in levels] == [32, 16, 8, 4, 2, 1]
    np.testing.assert_array_equal(levels[0], faces)
    expected = filter_environment(faces, texel_directions(4), LEVEL_SLOPE / 4)
    np.testing.assert_array_equal(levels[3], expected)


def test_level_of_a_roughness_passes_through_the_levels_own():
    for level in range(1, 8):
        assert prefiltered_level(LEVEL_SLOPE * 2**level / 256, 256) == pytest.approx(level)
    between = [prefiltered_level(m, 256) for m in np.geomspace(1e-3, 1.0, 200)]
    assert between[0] == 0.0 and np.all(np.diff(between) >= 0)
    assert np.max(np.diff(between)) < 0.06, "a jump"


@pytest.mark.parametrize(("m", "limit"), [(0.19, 0.01), (0.27, 0.04), (0.55, 0.04)])
def test_lookup_along_the_normal_is_near_the_truth(m, limit, rng):
    """The view for which the map is made. Between two levels lies a blend of a narrow and a wide lobe."""
    d = texel_directions(32)
    faces = np.exp(np.sin(3 * d + [0.3, 1.0, 2.0]) + np.sin(5 * d[..., [1, 2, 0]]))
    normals = normalize(rng.normal(size=(60, 3)))
    lobe = KurtLobe(m, r0=0.04, alpha=0.5)
    got = shade_prefiltered(prefilter_environment(faces), normals, rng.normal(size=(60, 3)), normals, lobe)
    albedo = directional_albedo([0.0, 0.0, 1.0], m, 0.5) @ [0.04, 0.96]
    truth = filter_environment(faces, normals, m) * albedo
    assert np.sqrt(np.mean((got - truth) ** 2) / np.mean(truth**2)) < limit


def test_narrowest_lobe_is_a_mirror(faces, rng):
    normals = normalize(rng.normal(size=(50, 3)))
    views = normalize(normals + 0.5 * rng.normal(size=(50, 3)))
    cos_o = np.sum(normals * views, axis=-1, keepdims=True)
    views = np.where(np.abs(cos_o) > 0.1, views, normals)  # nearer to grazing even this lobe is wide
    cos_o = np.sum(normals * views, axis=-1, keepdims=True)
    got = shade_prefiltered(prefilter_environment(faces), normals, views, views, KurtLobe(1e-3))
    mirrored = sample_cube([faces], 2 * cos_o * normals - views)
    np.testing.assert_allclose(got, np.where(cos_o > 0, mirrored * cos_o, 0.0), rtol=1e-3)
