"""The matched sampler against its oracle: the levels it reads, lookups by view and at every point, suns.

The oracle gets the engine's own levels for shading, so only the shading is judged; the levels have a test of
their own.
"""

import numpy as np
import pytest

import burnish
from burnish import _core
from burnish.environments import spots
from burnish.oracle.cube_map import pad_cube
from burnish.oracle.matched import MatchedMap
from burnish.oracle.shading import shade_matched_lobes
from burnish.oracle.spherical_pyramid import build_spherical_pyramid
from burnish.oracle.sun_split import split_suns
from engine_support import compare_radiance, lookup_error, random_points, smooth_environment_faces, unit

# Relative to a point's radiance, or the mean over the points where that is more. The albedo's table is that
# exact. Lookups at the edge of a disc a thousand times brighter than its surroundings turn the rounding of a
# direction into radiance; and rounding decides which of two rows serves a view half-way between them, a step
# of 1e-3 of the lobe. Those are few. The samplers of GPUs round the weights of their lookups.
LIMIT, LIMIT_HARDWARE = 3e-4, 2e-2
SHARE_BEYOND = 0.01
FACTOR_BEYOND = 100

ROUND = {
    "narrow": burnish.KurtLobe(roughness=0.1),
    "middle": burnish.KurtLobe(roughness=0.3, r0=(0.9, 0.5, 0.04), alpha=0.5, weight=(0.5, 1, 0.2)),
    "wide": burnish.KurtLobe(roughness=0.6, r0=0.04, alpha=0.25),
    "widest": burnish.KurtLobe(roughness=0.9),
}
BRUSHED = {
    "brushed": burnish.KurtLobe(roughness=(0.2, 0.075), rotation=0.4),
    "brushed, all effects": burnish.KurtLobe(
        roughness=(0.3, 0.05), r0=(0.9, 0.5, 0.04), alpha=0.25, weight=(0.5, 1, 0.2), rotation=0.7
    ),
    "brushed across": burnish.KurtLobe(roughness=(0.06, 0.2), r0=0.04, alpha=0.5),
    "brushed and wide": burnish.KurtLobe(roughness=(0.5, 0.25), r0=0.04, alpha=0.5),
}


@pytest.fixture(scope="module")
def points():
    return random_points(np.random.default_rng(21), 600)


def read_levels(device, environment):
    return _core.environment_spherical(device, environment, "gauss6")


def compare(device, got, expected):
    limit = LIMIT if lookup_error(device, 1) == 0 else LIMIT_HARDWARE
    compare_radiance(got, expected, limit, SHARE_BEYOND, FACTOR_BEYOND)


@pytest.mark.parametrize("size", [1, 2, 4, 64])
def test_levels_are_round_on_the_sphere_as_the_oracles(device, rng, size):
    faces = np.exp(rng.standard_normal((6, size, size, 3))).astype(np.float32)
    environment = burnish.Environment.from_faces(faces)
    levels = read_levels(device, environment)
    expected = build_spherical_pyramid(environment.pyramid("gauss6", device=device))
    assert [level.shape[1] for level in levels] == [level.shape[1] for level in expected]
    for got, wanted in zip(levels, expected, strict=True):
        # Half an ulp of half precision, and what float32 directions change of radiance between texels.
        limit = 6e-4 if device.is_software else 6e-3
        np.testing.assert_allclose(got, wanted, rtol=limit)


@pytest.mark.parametrize("name", ROUND)
@pytest.mark.parametrize("samples", [2, 3, 5, 14, 64])
def test_round_lobes_equal_the_oracle(device, spots64, points, name, samples):
    material = burnish.Material(lobes=[ROUND[name]])
    got = burnish.shade(spots64, material, burnish.Matched(samples), *points, device=device)
    light_map = MatchedMap(pad_cube(read_levels(device, spots64)))
    compare(device, got, shade_matched_lobes(light_map, material, samples, *points))


@pytest.mark.parametrize("name", BRUSHED)
@pytest.mark.parametrize("samples", [2, 5, 14, 64])
def test_brushed_lobes_equal_the_oracle(device, spots64, points, name, samples):
    material = burnish.Material(lobes=[BRUSHED[name]])
    got = burnish.shade(spots64, material, burnish.Matched(samples), *points, device=device)
    light_map = MatchedMap(pad_cube(read_levels(device, spots64)))
    compare(device, got, shade_matched_lobes(light_map, material, samples, *points))


def test_a_table_that_no_texel_buffer_holds_lies_in_a_storage_buffer(monkeypatch, device, spots64, points):
    material = burnish.Material(lobes=[BRUSHED["brushed"]])
    expected = burnish.shade(spots64, material, burnish.Matched(5), *points, device=device)
    # The map's 100 thousand pairs lie in a texel buffer, the table's 164 thousand entries do not.
    monkeypatch.setenv("BURNISH_TEXEL_LIMIT", "120000")
    small = burnish.Device(device.name, lookup=device.lookup)
    np.testing.assert_array_equal(
        burnish.shade(spots64, material, burnish.Matched(5), *points, device=small), expected
    )


def test_several_round_lobes_add_up(device, spots64, points):
    lobes = [ROUND["narrow"], ROUND["middle"]]
    got = burnish.shade(spots64, burnish.Material(lobes=lobes), burnish.Matched(9), *points, device=device)
    light_map = MatchedMap(pad_cube(read_levels(device, spots64)))
    compare(device, got, shade_matched_lobes(light_map, burnish.Material(lobes=lobes), 9, *points))


@pytest.fixture(scope="module")
def sunny():
    """Two suns of half a degree and different colours over smooth light, 128 texels a face."""
    from burnish.environments import cube_directions

    faces = smooth_environment_faces(128)
    directions = cube_directions(128)
    for sun, color in (((0.3, 0.8, 0.5), (30000, 28000, 20000)), ((-0.7, 0.4, -0.2), (9000, 9000, 15000))):
        faces[directions @ unit(np.array(sun)) > np.cos(np.radians(0.5))] = color
    return burnish.Environment.from_faces(np.ascontiguousarray(faces, np.float32))


@pytest.mark.parametrize("lobe", [ROUND["narrow"], ROUND["wide"], BRUSHED["brushed, all effects"]])
def test_suns_are_split_off_as_in_the_oracle(device, sunny, points, lobe):
    material = burnish.Material(lobes=[lobe])
    got = burnish.shade(sunny, material, burnish.Matched(14), *points, device=device)
    suns, filled = split_suns(sunny.faces)
    assert len(suns) == 2
    rest = burnish.Environment.from_faces(np.ascontiguousarray(filled, np.float32))
    light_map = MatchedMap(pad_cube(read_levels(device, rest)), suns)
    compare(device, got, shade_matched_lobes(light_map, material, 14, *points))


@pytest.mark.parametrize("lobe", [ROUND["narrow"], ROUND["middle"], BRUSHED["brushed"]])
def test_suns_err_less_than_one_percent(device, sunny, points, lobe):
    material = burnish.Material(lobes=[lobe])
    truth = burnish.shade(
        sunny, material, burnish.Reference(method="quadrature"), *points, device=device
    ).astype(np.float64)
    got = burnish.shade(sunny, material, burnish.Matched(14), *points, device=device)
    assert np.sqrt(np.sum((got - truth) ** 2) / np.sum(truth**2)) < 0.01


@pytest.mark.parametrize("name", ROUND | BRUSHED)
def test_a_uniform_map_gives_the_albedo(device, uniform, points, name):
    material = burnish.Material(lobes=[(ROUND | BRUSHED)[name]])
    got = burnish.shade(uniform, material, burnish.Matched(5), *points, device=device)
    regular = burnish.shade(uniform, material, burnish.Regular(14), *points, device=device)
    # Both are the albedo table's, whatever their samples.
    np.testing.assert_allclose(got, regular, rtol=2e-5, atol=1e-6)


def test_a_map_that_is_turned_and_exposed_keeps_its_suns(device, points):
    sky = burnish.Environment.from_faces(spots(3, 64).faces)
    sky.rotation, sky.exposure = 35.0, 1.0
    material = burnish.Material(lobes=[ROUND["narrow"]])
    first = burnish.shade(sky, material, burnish.Matched(14), *points, device=device)
    sky.exposure = 2.0
    second = burnish.shade(sky, material, burnish.Matched(14), *points, device=device)
    np.testing.assert_allclose(second, 2 * first, rtol=1e-6)


def test_counts_without_a_mixture_are_refused():
    with pytest.raises(ValueError, match=r"samples: expected one of 2, 3, .* 64, got 11"):
        burnish.Matched(11)


def test_points_below_the_horizon_are_black_and_finite(device, spots64, points):
    normals, tangents, views = points
    material = burnish.Material(lobes=[ROUND["middle"], ROUND["wide"]])
    got = burnish.shade(spots64, material, burnish.Matched(14), normals, tangents, -views, device=device)
    assert np.isfinite(got).all()
