"""`burnish.shade` against the oracle, point by point, on the very texels that the device looks up.

The oracle gets the engine's own pyramid (the pyramid has tests of its own), so only the shading is judged.
The engine computes in float32, and so do its lookups on CPU devices and its own lookup everywhere; the
samplers of GPUs round their weights, which `lookup_error` allows for.
"""

import numpy as np
import pytest

import burnish
from burnish.environments import spots
from burnish.filters import FILTERS
from burnish.oracle.shading import shade as oracle_shade
from engine_support import lookup_error, random_points

# Errors are relative to the mean radiance over the points. Float32 places a lookup within 1e-5 of a texel,
# and where a narrow lobe reads level 0 at the edge of a disc, radiance changes by 1000 means within a texel:
# few points may differ by more than the limit, none by ten times as much.
LIMIT = 1e-4
SHARE_BEYOND = 0.005

ISOTROPIC = burnish.KurtLobe(roughness=(0.1, 0.1))
BRUSHED = burnish.KurtLobe(
    roughness=(0.2, 0.075), r0=(0.9, 0.5, 0.04), alpha=0.25, weight=(0.5, 1, 0.2), rotation=0.7
)


@pytest.fixture(scope="module")
def points():
    return random_points(np.random.default_rng(11), 2000)


def compare(device, environment, material, sampler, points, filter="gauss6"):
    got = burnish.shade(environment, material, sampler, *points, filter=filter, device=device)
    levels = environment.pyramid(filter, device=device)
    expected = oracle_shade(levels, material, sampler, *points)
    assert np.isfinite(got).all()
    error = np.abs(got - expected).max(axis=-1) / expected.mean()
    limit = LIMIT + most_lit(material) * lookup_error(device, environment.faces.max()) / expected.mean()
    worst, beyond = int(np.argmax(error)), int(np.sum(error > limit))
    assert error[worst] <= 10 * limit and beyond <= SHARE_BEYOND * len(error), (
        f"point {worst}: got {got[worst]}, expected {expected[worst]}; {beyond} of {len(error)} "
        f"points differ by more than {limit} of the mean radiance"
    )


def most_lit(material):
    """Sum of the lobes' largest weights: radiance of the map comes out at most that much brighter."""
    return sum(max(lobe.weight) for lobe in material.lobes)


def lobe_material(*lobes, **rest):
    return burnish.Material(lobes=list(lobes), **rest)


@pytest.mark.parametrize("lobe", [ISOTROPIC, BRUSHED], ids=["isotropic", "brushed"])
@pytest.mark.parametrize(
    ("samples", "footprint", "normalization", "bias"),
    [
        (7, "exact", "published", 0.0),
        (14, "published", "published", 0.0),
        (14, "exact", "projected", -0.5),
        (20, "published", "projected", 0.5),
        (50, "exact", "published", 0.0),
        (64, "exact", "projected", 1.0),
        (100, "published", "published", 0.25),
        (100, "exact", "projected", 0.0),
    ],
)
def test_shade_regular_equals_oracle(device, spots64, points, lobe, samples, footprint, normalization, bias):
    sampler = burnish.Regular(
        samples=samples, footprint=footprint, normalization=normalization, mip_bias=bias
    )
    compare(device, spots64, lobe_material(lobe), sampler, points)


@pytest.mark.parametrize("lobe", [ISOTROPIC, BRUSHED], ids=["isotropic", "brushed"])
@pytest.mark.parametrize(
    ("samples", "point_set", "bias"),
    [
        (1, "fibonacci", 0.0),
        (7, "hammersley", 1.0),
        (14, "hammersley", 0.0),
        (14, "fibonacci", 0.0),
        (64, "hammersley", -1.0),
        (100, "fibonacci", 0.5),
    ],
)
def test_shade_importance_equals_oracle(device, spots64, points, lobe, samples, point_set, bias):
    sampler = burnish.Importance(samples=samples, points=point_set, mip_bias=bias)
    compare(device, spots64, lobe_material(lobe), sampler, points)


@pytest.mark.parametrize("alpha", [0.0, 0.25, 0.5, 1.0])
@pytest.mark.parametrize("r0", [1.0, 0.04, (1.0, 0.5, 0.0)], ids=["mirror", "dielectric", "coloured"])
def test_shade_equals_oracle_for_fresnel_and_grazing_exponents(device, spots64, points, alpha, r0):
    sampler = burnish.Regular(7, normalization="published") if alpha in (0.25, 1.0) else burnish.Importance(7)
    lobe = burnish.KurtLobe(roughness=(0.15, 0.15), r0=r0, alpha=alpha, weight=(1.5, 0.7, 0.1))
    compare(device, spots64, lobe_material(lobe), sampler, points)


@pytest.mark.parametrize("roughness", [(0.01, 0.01), (0.6, 0.6), (1.0, 1.0), (0.05, 0.4), (0.4, 0.05)])
@pytest.mark.parametrize(
    "sampler",
    [burnish.Regular(7, normalization="projected"), burnish.Importance(7)],
    ids=["regular", "importance"],
)
def test_shade_equals_oracle_for_narrow_and_wide_lobes(device, spots128, points, roughness, sampler):
    compare(
        device, spots128, lobe_material(burnish.KurtLobe(roughness=roughness, rotation=-2.1)), sampler, points
    )


@pytest.mark.parametrize("count", [2, 3, 4])
@pytest.mark.parametrize(
    "sampler",
    [
        burnish.Regular(normalization="published"),
        burnish.Regular(50, normalization="projected"),
        burnish.Importance(),
    ],
    ids=["regular", "regular in a loop", "importance"],
)
def test_shade_adds_several_lobes(device, spots64, points, count, sampler):
    lobes = [
        ISOTROPIC,
        BRUSHED,
        burnish.KurtLobe(roughness=0.4, r0=0.04, alpha=0.5, weight=0.3),
        burnish.KurtLobe(roughness=0.02, alpha=1.0, weight=(0, 0, 1)),
    ][:count]
    compare(device, spots64, lobe_material(*lobes), sampler, points)


@pytest.mark.parametrize("samples", [5, 14, 50])
def test_lobe_of_no_weight_changes_nothing(device, spots64, points, samples):
    """Also where one lobe is without a loop and both are in one."""
    nothing = burnish.KurtLobe(roughness=(0.3, 0.05), weight=0.0)
    sampler = burnish.Regular(samples, normalization="published")
    alone = burnish.shade(spots64, lobe_material(ISOTROPIC), sampler, *points, device=device)
    beside = burnish.shade(spots64, lobe_material(ISOTROPIC, nothing), sampler, *points, device=device)
    error = np.abs(beside - alone).max(axis=-1) / alone.mean()
    assert error.max() <= 10 * LIMIT and np.mean(error > LIMIT) <= SHARE_BEYOND


def test_shade_diffuse_equals_oracle(device, smooth64, points):
    compare(device, smooth64, burnish.Material(diffuse=(0.8, 0.5, 0.1)), burnish.Regular(), points)


def test_shade_emission_is_added_as_it_is(device, spots64, points):
    material = burnish.Material(emissive=(1.0, 20.0, 0.25))
    got = burnish.shade(spots64, material, burnish.Regular(), *points, device=device)
    np.testing.assert_array_equal(got, np.broadcast_to(np.float32([1.0, 20.0, 0.25]), got.shape))


def test_shade_diffuse_lobe_and_emission_together(device, spots64, points):
    material = lobe_material(BRUSHED, diffuse=(0.2, 0.3, 0.4), emissive=(0.5, 0.0, 2.0))
    compare(device, spots64, material, burnish.Regular(normalization="projected"), points)


def test_shade_without_lobe_diffuse_or_emission_is_black(device, spots64, points):
    got = burnish.shade(spots64, burnish.Material(), burnish.Regular(), *points, device=device)
    assert not got.any()


@pytest.mark.parametrize("filter", FILTERS)
def test_shade_looks_up_the_filter_asked_for(device, spots64, points, filter):
    compare(
        device, spots64, lobe_material(ISOTROPIC), burnish.Regular(normalization="published"), points, filter
    )


def turn(angle_y, angle_x):
    """Rotation about y, then x."""
    cy, sy, cx, sx = np.cos(angle_y), np.sin(angle_y), np.cos(angle_x), np.sin(angle_x)
    return np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]) @ np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])


@pytest.mark.parametrize("exposure", [0.0, 1.5])
def test_shade_turns_and_exposes_the_map(device, points, exposure):
    """A map turned by R is read at R^T w for a direction w of the world; emission stays as it is."""
    material = lobe_material(BRUSHED, diffuse=(0.3, 0.2, 0.1), emissive=(0.5, 0.25, 4.0))
    sampler = burnish.Regular(normalization="published")
    environment = spots(face_size=64)
    rotation = turn(0.8, -0.5)
    environment.rotation, environment.exposure = rotation, exposure
    got = burnish.shade(environment, material, sampler, *points, device=device)
    levels = environment.pyramid(device=device)
    in_map = [p @ rotation for p in points]
    emitted = np.array(material.emissive)
    expected = 2.0**exposure * (oracle_shade(levels, material, sampler, *in_map) - emitted) + emitted
    error = np.abs(got - expected).max(axis=-1) / expected.mean()
    assert (
        error.max() <= LIMIT + 2.0**exposure * lookup_error(device, environment.faces.max()) / expected.mean()
    )


@pytest.mark.parametrize("face_size", [1, 2, 4])
def test_shade_equals_oracle_on_the_smallest_maps(device, rng, points, face_size):
    faces = rng.uniform(0, 4, (6, face_size, face_size, 3)).astype(np.float32)
    environment = burnish.Environment.from_faces(faces)
    compare(device, environment, lobe_material(ISOTROPIC), burnish.Regular(normalization="published"), points)


def test_shade_takes_any_number_of_points(device, smooth64):
    material, sampler = lobe_material(ISOTROPIC), burnish.Importance()
    everything = random_points(np.random.default_rng(5), 129)
    whole = burnish.shade(smooth64, material, sampler, *everything, device=device)
    for count in (1, 63, 64, 65, 128):
        part = [np.ascontiguousarray(p[:count]) for p in everything]
        np.testing.assert_array_equal(
            burnish.shade(smooth64, material, sampler, *part, device=device), whole[:count]
        )


def test_shade_replaces_tangents_it_cannot_use(device, spots64, points):
    """A tangent of zero, or along the normal, is replaced by one that the normal alone decides."""
    normals, _, views = points
    for tangents in (np.zeros_like(normals), normals, -3 * normals):
        got = burnish.shade(
            spots64, lobe_material(BRUSHED), burnish.Importance(), normals, tangents, views, device=device
        )
        assert np.isfinite(got).all() and got.mean() > 0.1


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_shade_is_finite_and_steady_from_behind_and_at_grazing_angles(device, spots64, scale):
    normals = np.float32([[0, 0, 1]] * 5)
    tangents = np.float32([[1, 0, 0]] * 5)
    cosines = np.array([1e-2, 1e-4, 0.0, -1e-4, -0.5])
    views = np.stack([np.sqrt(1 - cosines**2), 0 * cosines, cosines], axis=-1)
    material = lobe_material(
        burnish.KurtLobe(roughness=0.05, alpha=0.5), burnish.KurtLobe(roughness=1.0, alpha=1.0)
    )
    got = burnish.shade(
        spots64, material, burnish.Regular(), normals, tangents, np.float32(scale * views), device=device
    )
    assert np.isfinite(got).all() and (got >= 0).all()
