"""Hypothesis over materials, points, environments and scenes, against the oracle and what must always hold.

A few examples each, always the same ones; BURNISH_FUZZ_EXAMPLES asks for more, and for others in every run:
scripts/fuzz shade. What once failed stays as an example beside its test.
"""

import os
import warnings

import numpy as np
import pytest
import strategies
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import burnish
from burnish.environments import cube_directions
from burnish.filters import FILTERS
from burnish.oracle.shading import shade as oracle_shade
from engine_support import directions as as_directions
from engine_support import lookup_error, random_points, smooth_environment_faces

EXAMPLES = int(os.environ.get("BURNISH_FUZZ_EXAMPLES", "0"))
# A shader that is compiled for an example takes a second: the samplers below read their samples from buffers.
fuzzed = settings(
    max_examples=EXAMPLES or 6,
    derandomize=not EXAMPLES,
    deadline=None,
    database=None,
    print_blob=True,
    suppress_health_check=[
        HealthCheck.function_scoped_fixture,
        HealthCheck.too_slow,
        HealthCheck.data_too_large,
    ],
)
SAMPLERS = {
    "regular": burnish.Regular(100, normalization="projected"),
    "importance": burnish.Importance(100),
    "matched": burnish.Matched(14),
    "prefiltered": burnish.Prefiltered(),
}


@pytest.fixture(scope="module")
def smooth16():
    return burnish.Environment.from_faces(smooth_environment_faces(16))


def shade_and_count(environment, material, sampler, points, device, filter="gauss6"):
    """Shade; give the radiance and whether the device had to stop values that were not finite."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        radiance = burnish.shade(environment, material, sampler, *points, filter=filter, device=device)
    return radiance, [str(w.message) for w in caught if "were not finite" in str(w.message)]


@pytest.mark.parametrize("name", SAMPLERS)
@fuzzed
@given(
    material=strategies.materials(),
    points=strategies.hostile_points(),
    texels=strategies.faces(),
    filter=st.sampled_from(FILTERS),
)
def test_any_point_under_any_map_gives_finite_radiance_that_is_not_negative(
    device, name, material, points, texels, filter
):
    environment = burnish.Environment.from_faces(texels)
    radiance, stopped = shade_and_count(environment, material, SAMPLERS[name], points, device, filter)
    assert radiance.shape == points[0].shape and radiance.dtype == np.float32
    assert np.isfinite(radiance).all() and (radiance >= 0).all() and not stopped
    again, _ = shade_and_count(environment, material, SAMPLERS[name], points, device, filter)
    np.testing.assert_array_equal(radiance, again, "the same bits twice")


# Share of the brightest point: float32 against float64, and steps of the table of albedos, in smooth light.
SMOOTH_LIMIT = 3e-3


@pytest.mark.parametrize("name", ["regular", "importance"])
@fuzzed
@given(material=strategies.materials(least_roughness=0.01), seed=st.integers(0, 2**31 - 1))
def test_shade_equals_the_oracle(device, smooth16, name, material, seed):
    points = random_points(np.random.default_rng(seed), 40)
    got = burnish.shade(smooth16, material, SAMPLERS[name], *points, device=device)
    levels = smooth16.pyramid("gauss6", device=device)
    expected = oracle_shade(levels, material, SAMPLERS[name], *points)
    weight = sum(max(lobe.weight) for lobe in material.lobes)
    limit = SMOOTH_LIMIT * expected.max() + weight * lookup_error(device, smooth16.faces.max())
    worst = int(np.argmax(np.abs(got - expected).max(axis=-1)))
    np.testing.assert_allclose(got[worst], expected[worst], rtol=0, atol=limit + 1e-6)


@fuzzed
@given(texels=strategies.faces(), filter=st.sampled_from(FILTERS))
def test_any_texels_are_cleaned_and_blurred_within_their_range(device, texels, filter):
    environment = burnish.Environment.from_faces(texels)
    cleaned = environment.faces
    assert np.isfinite(cleaned).all() and (cleaned >= 0).all()
    is_good = np.isfinite(texels) & (texels >= 0)
    np.testing.assert_array_equal(cleaned[is_good], texels[is_good])
    for level in environment.pyramid(filter, device=device):
        assert np.isfinite(level).all() and (level >= 0).all()
        # Half floats have 11 bits.
        assert level.max() <= cleaned.max() * (1 + 2.0**-10)


@fuzzed
@given(
    texels=strategies.faces(min_value=2.0**-10, max_value=4.0),
    stops=st.integers(-8, 8),
    material=strategies.materials(),
)
def test_brighter_light_scales_the_radiance(device, texels, stops, material):
    material = burnish.Material(diffuse=material.diffuse, lobes=material.lobes)
    points = random_points(np.random.default_rng(7), 20)
    one = burnish.Environment.from_faces(texels)
    other = burnish.Environment.from_faces(texels, exposure=stops)
    got = burnish.shade(other, material, burnish.Prefiltered(), *points, device=device)
    expected = burnish.shade(one, material, burnish.Prefiltered(), *points, device=device) * np.float32(
        2.0**stops
    )
    np.testing.assert_allclose(got, expected, rtol=1e-5, atol=1e-30)


@fuzzed
@given(bad=st.sampled_from([np.nan, np.inf, -np.inf]), which=st.integers(0, 2), row=st.integers(0, 3))
def test_points_that_are_not_finite_are_refused(device, smooth16, bad, which, row):
    points = [as_directions(np.eye(3)[[0, 1, 2, 0]]) for _ in range(3)]
    points[which][row, 1] = bad
    with pytest.raises(ValueError, match=f"expected finite numbers, got .* in row {row}"):
        burnish.shade(smooth16, burnish.Material(), burnish.Prefiltered(), *points, device=device)


@fuzzed
@given(
    mesh=strategies.meshes(),
    material=strategies.materials(),
    texels=strategies.faces(largest_exponent=2),
    scale=st.sampled_from([1e-6, 1e-3, 1.0, 1e3, 1e6]),
    mirror=st.sampled_from([1.0, -1.0]),
    stretch=st.sampled_from([0.0, 1e-3, 1.0]),
    eye=st.sampled_from([(0, 0, 4), (0, 0, 0.01), (3, 2, 1), (0, 1e3, 0.1)]),
)
def test_any_scene_gives_a_finite_picture(device, mesh, material, texels, scale, mirror, stretch, eye):
    scene = burnish.Scene()
    transform = np.diag([mirror * scale, scale, stretch * scale, 1.0])
    scene.add(mesh, material, transform)
    scene.environment = burnish.Environment.from_faces(texels)
    eye_world = tuple(float(scale * e) for e in eye)
    camera = burnish.Camera.look_at(eye_world, (0, 0, 1e-3 * scale), near_plane=1e-3 * scale)
    frame = burnish.render(scene, camera, (8, 16), burnish.Prefiltered(), device=device)
    assert frame.color.shape == (8, 16, 3) and frame.alpha.shape == (8, 16)
    assert np.isfinite(frame.color).all() and (frame.color >= 0).all()
    assert (frame.alpha >= 0).all() and (frame.alpha <= 1).all()
    assert frame.report.non_finite == 0


def test_directions_of_the_strategy_reach_every_face(rng):
    """The hostile points come by random draws too: they meet all six faces, so nothing above is blind."""
    import hostile_points

    normals, _, _ = hostile_points.random_points(rng, 2000)
    unit = normals[np.linalg.norm(normals.astype(np.float64), axis=1) > 0.5]
    nearest = np.argmax(unit @ cube_directions(1).reshape(6, 3).T, axis=1)
    assert set(nearest) == set(range(6))
