"""Regular pattern and importance sampling against the sum over every texel."""

import numpy as np
import pytest

from burnish.oracle.albedo import blend_albedo, directional_albedo
from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import texel_directions
from burnish.oracle.estimator import local_frame, shade_importance, shade_regular
from burnish.oracle.frame import frame_from_tangent
from burnish.oracle.importance import importance_half_vectors
from burnish.oracle.lobe.kurt import KurtLobe
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.regular_pattern import choose_pattern, sample_pattern

LOBES = {
    "narrow": KurtLobe(0.1),
    "wide": KurtLobe(0.6, 0.04, 0.5),
    "brushed": KurtLobe((0.3, 0.05), (1, 0.5, 0.04), 0.25, (0.5, 1, 2), 0.7),
}


def view(degrees, azimuth=0.0):
    theta = np.radians(degrees)
    return np.array([np.sin(theta) * np.cos(azimuth), np.sin(theta) * np.sin(azimuth), np.cos(theta)])


@pytest.fixture
def points(rng):
    """Normals, tangents and views up to 75 degrees from the normal."""
    n = normalize(rng.normal(size=(60, 3)))
    t, b = frame_from_tangent(n, rng.normal(size=(60, 3)))
    angles = zip(rng.uniform(0, 75, 60), rng.uniform(0, 2 * np.pi, 60), strict=True)
    local = np.stack([view(a, p) for a, p in angles])
    return n, t, local[:, :1] * t + local[:, 1:2] * b + local[:, 2:] * n


@pytest.fixture
def smooth():
    d = texel_directions(64)
    return 1 + 0.4 * d + 0.3 * d[..., [1, 2, 0]] * d[..., [2, 0, 1]]


def test_reference_under_constant_light_is_the_albedo(points):
    n, t, o = points
    for lobe in LOBES.values():
        frame = local_frame(n, t, o, lobe.rotation)
        albedo = blend_albedo(directional_albedo(frame.omega_o, lobe.roughness, lobe.alpha), lobe.r0)
        truth = shade_reference(np.ones((6, 128, 128, 3)), n, t, o, lobe)
        np.testing.assert_allclose(truth, albedo * np.asarray(lobe.weight), rtol=2e-3)


@pytest.mark.parametrize(("m", "low"), [(0.1, 0.005), (0.3, 0.041), (0.6, 0.136)])
def test_published_converges_to_truth_over_the_mean_of_1_over_cos_h(m, low, points, smooth):
    n, t, o = points
    lobe = KurtLobe(m)
    # E[1/cos_h] = int D dw: the slope's length sqrt(1 + m^2 s^2) under exp(-s^2) d(s^2).
    x, w = np.polynomial.laguerre.laggauss(40)
    mean = np.sum(w * np.sqrt(1 + m * m * x))
    assert 1 - 1 / mean == pytest.approx(low, abs=1e-3)
    truth = shade_reference(smooth, n, t, o, lobe)
    levels, pattern = build_pyramid(smooth), sample_pattern(m, "s1", 40, 1e-4)
    ratio = {
        name: np.mean(shade_regular(levels, n, t, o, lobe, pattern, 1e-4, normalization=name) / truth)
        for name in ("published", "projected", "furnace")
    }
    assert ratio["published"] == pytest.approx(1 / mean, abs=1.5e-3)
    assert ratio["projected"] == pytest.approx(1, abs=1e-3)
    assert ratio["furnace"] == pytest.approx(1, abs=2e-4)


@pytest.mark.parametrize("points_name", ["hammersley", "fibonacci"])
@pytest.mark.parametrize("name", LOBES)
def test_importance_converges_to_the_truth(name, points_name, points, smooth):
    n, t, o = points
    lobe = LOBES[name]
    h = importance_half_vectors(lobe.roughness, points_name, 4000)
    shaded = shade_importance(build_pyramid(smooth), n, t, o, lobe, h)
    np.testing.assert_allclose(shaded, shade_reference(smooth, n, t, o, lobe), rtol=0.02)


@pytest.mark.parametrize(("m", "tolerance"), [(0.1, 0.005), (0.3, 0.02), (0.6, 0.05)])
def test_thirty_samples_are_near_the_truth_under_smooth_light(m, tolerance, points, smooth):
    n, t, o = points
    lobe = KurtLobe(m)
    shaded = shade_regular(build_pyramid(smooth), n, t, o, lobe, choose_pattern(m, 30, 0.1), 0.1)
    truth = shade_reference(smooth, n, t, o, lobe)
    assert np.sqrt(np.mean((shaded / truth - 1) ** 2)) < tolerance
