"""`Reference` is the truth for every part of a material: against independent sums in float64."""

import numpy as np
import pytest

import burnish
from burnish.oracle.cube_map import pad_cube, sample_cube, texel_directions
from burnish.oracle.irradiance import cosine_sum
from burnish.oracle.pyramid import round_to_half
from burnish.oracle.reference import shade_reference
from engine_support import random_points
from lit_maps import MADE_MAPS, REAL_MAPS, make_map

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
PLASTIC = burnish.KurtLobe(roughness=0.3, r0=0.04, alpha=0.5)
BRUSHED = burnish.KurtLobe(roughness=(0.5, 0.25), r0=(0.9, 0.5, 0.2), weight=(0.5, 1, 0.2), rotation=0.7)
MATERIALS = {
    "diffuse": burnish.Material(diffuse=(0.8, 0.5, 0.2)),
    "plastic": burnish.Material(diffuse=(0.6, 0.3, 0.1), lobes=[PLASTIC]),
    "two lobes and emission": burnish.Material(
        diffuse=(0.2, 0.3, 0.4), lobes=[PLASTIC, BRUSHED], emissive=(0.1, 0.2, 0.3)
    ),
}
QUADRATURE = burnish.Reference(method="quadrature")
STANDARD_ERROR = 0.003


@pytest.fixture(scope="module")
def points():
    return random_points(np.random.default_rng(17), 40, least_cos=0.2)


def truth_of(faces, material, points):
    total = np.asarray(material.diffuse) * cosine_sum(faces, points[0]) + np.asarray(material.emissive)
    for lobe in material.lobes:
        total = total + shade_reference(faces, *points, lobe)
    return total


def relative_rmse(got, expected):
    return np.sqrt(np.mean((got - expected) ** 2) / np.mean(expected**2))


@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("name", [*MADE_MAPS, *REAL_MAPS])
def test_quadrature_is_the_sum_over_every_texel(device, points, request, name, material):
    """The texels' solid angles are those at their middle: they are off by some 1e-4 of the exact ones."""
    environment = make_map(name, lambda: request.getfixturevalue("shared_data"))
    faces = round_to_half(environment.faces)
    faces = faces.repeat(64 // faces.shape[1], axis=1).repeat(64 // faces.shape[1], axis=2)
    got = burnish.shade(environment, MATERIALS[material], QUADRATURE, *points, device=device)
    assert relative_rmse(got, truth_of(faces, MATERIALS[material], points)) <= 2e-3


@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("name", [*MADE_MAPS, *REAL_MAPS])
def test_progressive_is_within_its_standard_error(device, points, request, name, material):
    """Its lookups are bilinear, so the sum is over texels split 2 x 2 that are read that way."""
    environment = make_map(name, lambda: request.getfixturevalue("shared_data"))
    sampler = burnish.Reference(STANDARD_ERROR, "progressive", 1 << 20)
    got = burnish.shade(environment, MATERIALS[material], sampler, *points, device=device)
    size = max(2 * environment.face_size, 64)
    fine = sample_cube(pad_cube([round_to_half(environment.faces)]), texel_directions(size))
    truth = truth_of(fine, MATERIALS[material], points)
    error = ((got - truth) @ LUMINANCE) / np.mean((truth - MATERIALS[material].emissive) @ LUMINANCE)
    # With 40 points the spread of the error itself is known to some 10 %; sums over texels add .05 %.
    assert np.sqrt(np.mean(error**2)) <= 1.3 * STANDARD_ERROR + 5e-4
    assert abs(np.mean(error)) <= 3 * np.std(error) / np.sqrt(len(error)) + 5e-4


def test_pictures_of_diffuse_surfaces_know_their_standard_error(device):
    """A diffuse sphere alone: the samples are spread until what is asked for is reached, and it is said."""
    scene = burnish.Scene.sphere(MATERIALS["diffuse"])
    scene.environment = MADE_MAPS["lamp"]()
    exact = burnish.render(scene, size=(24, 24), sampler=QUADRATURE, device=device)
    sampler = burnish.Reference(0.01, method="progressive")
    frame = burnish.render(scene, size=(24, 24), sampler=sampler, device=device)
    assert 0 < frame.report.standard_error <= 0.01
    assert 0.2 * frame.report.standard_error <= frame.error(exact) <= 0.01


def test_a_quadrature_of_four_lobes_and_diffuse_is_whole(device, points):
    """A CPU driver ends an invocation's loops after 65535 rounds together: five sums of 24576 take more."""
    material = burnish.Material(diffuse=0.3, lobes=[PLASTIC, BRUSHED, PLASTIC, BRUSHED])
    environment = MADE_MAPS["spots"]()
    got = burnish.shade(environment, material, QUADRATURE, *points, device=device)
    assert relative_rmse(got, truth_of(round_to_half(environment.faces), material, points)) <= 2e-3
