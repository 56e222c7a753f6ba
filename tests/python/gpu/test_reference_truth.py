"""`Reference`: by every texel against the oracle's sum, by chance against both, and honest."""

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.oracle.pyramid import hold_in_halves
from burnish.oracle.reference import shade_reference
from burnish.oracle.shading import shade as oracle_shade
from engine_support import random_points

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
ROUND = burnish.KurtLobe(roughness=0.2)
BRUSHED = burnish.KurtLobe(
    roughness=(0.5, 0.15), r0=(0.9, 0.5, 0.04), alpha=0.5, weight=(0.5, 1, 0.2), rotation=0.7
)
QUADRATURE = burnish.Reference(method="quadrature")


@pytest.fixture(scope="module")
def points():
    return random_points(np.random.default_rng(17), 120)


def stored(environment):
    """Level 0 as the device holds it, without asking the device."""
    return hold_in_halves(environment.faces)


@pytest.mark.parametrize("lobe", [ROUND, BRUSHED], ids=["round", "brushed"])
def test_quadrature_equals_the_oracle_s_sum(device, spots64, points, lobe):
    """The texels' solid angles differ: 4/(face_texels r^3) at the centre against the exact one."""
    got = burnish.shade(spots64, burnish.Material(lobes=[lobe]), QUADRATURE, *points, device=device)
    expected = shade_reference(stored(spots64), *points, lobe)
    assert np.sqrt(np.mean((got - expected) ** 2) / np.mean(expected**2)) <= 1e-3
    np.testing.assert_allclose(got, expected, rtol=5e-3, atol=1e-3 * expected.mean())


def test_quadrature_adds_lobes_diffuse_and_emission(device, spots64, points):
    material = burnish.Material(diffuse=(0.2, 0.3, 0.4), lobes=[ROUND, BRUSHED], emissive=(1, 2, 3))
    few = [p[:40] for p in points]
    got = burnish.shade(spots64, material, QUADRATURE, *map(np.ascontiguousarray, few), device=device)
    expected = oracle_shade([stored(spots64)], material, QUADRATURE, *few)
    assert np.sqrt(np.mean((got - expected) ** 2) / np.mean(expected**2)) <= 1e-3


@pytest.mark.parametrize("lobe", [ROUND, BRUSHED], ids=["round", "brushed"])
def test_progressive_reference_is_true_to_half_a_percent(device, smooth64, points, lobe):
    material = burnish.Material(lobes=[lobe])
    sampler = burnish.Reference(standard_error=0.001, method="progressive")
    got = burnish.shade(smooth64, material, sampler, *points, device=device)
    # Lookups of the progressive way are bilinear: under smooth light that is what a finer sum sees, too.
    expected = shade_reference(smooth64.faces, *points, lobe)
    assert np.sqrt(np.mean((got - expected) ** 2) / np.mean(expected**2)) <= 5e-3


def bilinear_truth(environment, points, lobe, parts=4):
    """Sum over texels split 4 x 4, with the bilinear lookups that progressive sampling makes."""
    from burnish.oracle.cube_map import pad_cube, sample_cube, texel_directions

    size = parts * environment.face_size
    fine = sample_cube(pad_cube([stored(environment)]), texel_directions(size))
    return shade_reference(fine, *points, lobe)


@pytest.mark.parametrize(("roughness", "standard_error"), [(0.3, 0.01), (0.1, 0.01), ((0.4, 0.1), 0.02)])
def test_progressive_reference_is_honest(device, roughness, standard_error, rng):
    """Its error, over points that were each sampled by other numbers, is what it says it is.

    The standard error is that of luminance, root mean square over the points, relative to their mean.
    With 256 points the estimate of the error itself is good to some 20 %.
    """
    from burnish.environments import spots

    environment = spots(face_size=32)
    lobe = burnish.KurtLobe(roughness=roughness, alpha=0.5)
    points = random_points(rng, 256, least_cos=0.1)
    sampler = burnish.Reference(standard_error=standard_error, method="progressive", max_samples=1 << 20)
    got = burnish.shade(environment, burnish.Material(lobes=[lobe]), sampler, *points, device=device)
    truth = bilinear_truth(environment, points, lobe) @ LUMINANCE
    error = (got @ LUMINANCE - truth) / truth.mean()
    assert np.sqrt(np.mean(error**2)) <= 1.3 * standard_error
    # No bias hides in the noise: the mean of the errors is within three of its own standard errors.
    assert abs(error.mean()) <= 3 * error.std() / np.sqrt(len(error)) + 2e-4
    # A normal distribution keeps 95 % within two standard deviations; points differ, so fewer may do.
    assert np.mean(np.abs(error) <= 2 * standard_error) >= 0.9


def test_progressive_reference_reports_its_error_and_samples(device, spots64):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[ROUND]))
    scene.environment = spots64
    sampler = burnish.Reference(standard_error=0.02, method="progressive")
    frame = burnish.render(scene, size=(24, 24), sampler=sampler, device=device)
    assert "standard error" in frame.report.samples_used
    exact = burnish.render(scene, size=(24, 24), sampler=QUADRATURE, device=device)
    assert frame.error(exact) <= 0.05
    assert any(entry["name"].startswith("reference") for entry in frame.report.passes)


def test_progressive_reference_says_when_it_stopped_short(device, spots64):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.5)]))
    scene.environment = spots64
    sampler = burnish.Reference(standard_error=1e-5, method="progressive", max_samples=2048)
    frame = burnish.render(scene, size=(16, 16), sampler=sampler, device=device)
    assert any("reference stopped at 2048 samples" in warning for warning in frame.report.warnings)


@pytest.mark.parametrize(("sampler", "limit"), [(burnish.Regular(50), 0.04), (burnish.Importance(256), 0.02)])
def test_samplers_come_close_to_the_reference(device, smooth64, points, sampler, limit):
    """Under smooth light: the regular pattern ends at q = 0.2, so its lobe is narrower than the true one."""
    material = burnish.Material(lobes=[ROUND])
    truth = burnish.shade(smooth64, material, QUADRATURE, *points, device=device)
    got = burnish.shade(smooth64, material, sampler, *points, device=device)
    assert np.sqrt(np.mean((got - truth) ** 2) / np.mean(truth**2)) <= limit


def test_points_warn_when_the_reference_stops_short(device):
    """Shaded points come without a report: that the truth is not reached must not pass in silence."""
    sampler = burnish.Reference(standard_error=1e-6, method="progressive", max_samples=1024)
    normals, tangents = np.float32([[0, 0, 1]]), np.float32([[1, 0, 0]])
    material = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)])
    with pytest.warns(RuntimeWarning, match="the reference stopped at 1024 samples"):
        burnish.shade(environments.spots(1, 16), material, sampler, normals, tangents, normals, device=device)
