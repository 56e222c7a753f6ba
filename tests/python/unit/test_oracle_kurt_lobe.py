import numpy as np
import pytest

from burnish.oracle.arrays import dot, normalize, reflect
from burnish.oracle.chi_square import chi_square_test, sidak_level
from burnish.oracle.lobe.kurt import (
    MIN_X1,
    KurtLobe,
    grazing_factor,
    kurt_brdf,
    kurt_d,
    kurt_pdf,
    kurt_pdf_omega_i,
    kurt_sample,
    schlick_fresnel,
)

ROUGHNESSES = [(1e-3, 1e-3), (0.1, 0.1), (1.0, 1.0), (0.1, 1e-3), (1e-2, 1.0), (0.3, 0.05), (1.0, 1e-3)]


def slope_grid(mx, my, nodes=400):
    """Half-vectors on a polar grid of slopes in units of roughness, and the solid angle each stands for."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    s, ws = 3.5 * (x + 1), 3.5 * w
    phi = 2 * np.pi * (np.arange(nodes) + 0.5) / nodes
    s, phi = s[:, None], phi[None, :]
    slope_x, slope_y = mx * s * np.cos(phi), my * s * np.sin(phi)
    h = normalize(np.stack([slope_x, slope_y, np.ones_like(slope_x)], axis=-1))
    # A patch of slopes subtends its area times cos_h^3.
    return h, mx * my * s * ws[:, None] * (2 * np.pi / nodes) * h[..., 2] ** 3


@pytest.mark.parametrize("m", ROUGHNESSES)
def test_projected_density_integrates_to_one(m):
    h, solid_angle = slope_grid(*m)
    assert np.sum(kurt_d(h, *m) * h[..., 2] * solid_angle) == pytest.approx(1, abs=1e-10)


def test_projected_density_integrates_to_one_over_plain_angles():
    # The same without slopes: theta and phi, so that the grid above cannot share an error with D.
    m, nodes = (0.3, 0.6), 2000
    theta = (np.arange(nodes) + 0.5) / nodes * np.pi / 2
    phi = (np.arange(400) + 0.5) / 400 * 2 * np.pi
    theta, phi = theta[:, None], phi[None, :]
    h = np.stack(
        np.broadcast_arrays(np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), -1
    )
    cell = np.sin(theta) * (np.pi / 2 / nodes) * (2 * np.pi / 400)
    assert np.sum(kurt_d(h, *m) * h[..., 2] * cell) == pytest.approx(1, abs=1e-5)


def test_density_vanishes_at_and_below_the_horizon():
    h = [[1, 0, 0], [0, 1, 1e-300], [0.6, 0, -0.8], [0, 0, -1], [1, 0, 1e-12], [1, 0, 1e-10]]
    np.testing.assert_array_equal(kurt_d(h, 1.0, 1.0), 0)


def test_density_at_the_normal():
    assert kurt_d([0, 0, 1], 1e-3, 0.5) == pytest.approx(1 / (np.pi * 1e-3 * 0.5))


def test_fresnel_limits():
    assert schlick_fresnel(1.0, 0.04) == 0.04
    assert schlick_fresnel(0.0, 0.04) == 1.0
    np.testing.assert_array_equal(schlick_fresnel(np.linspace(0, 1, 9), 1.0), 1.0)
    assert schlick_fresnel(0.5, 0.0) == 1 / 32


@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
def test_reciprocity(rng, alpha):
    i, o = (normalize(rng.normal(size=(500, 3)) * [1, 1, 0] + [0, 0, 0.5]) for _ in range(2))
    lobe = KurtLobe((0.5, 0.2), (0.04, 0.5, 1.0), alpha, (0.5, 1, 2))
    forward, backward = kurt_brdf(i, o, lobe), kurt_brdf(o, i, lobe)
    assert np.all(forward >= 0) and np.max(forward) > 0.1
    np.testing.assert_allclose(forward, backward, rtol=1e-12)


def test_brdf_of_the_mirror_direction():
    lobe, c = KurtLobe((0.1, 0.2), 1.0, 0.5), np.cos(0.7)
    i, o = [np.sin(0.7), 0, c], [-np.sin(0.7), 0, c]
    np.testing.assert_allclose(kurt_brdf(i, o, lobe), 1 / (np.pi * 0.1 * 0.2) / (4 * c * c), rtol=1e-12)


def test_brdf_is_zero_below_the_horizon():
    lobe = KurtLobe(1.0, 0.04, 0.5)
    below, above = [0.6, 0, -0.8], [0.6, 0, 0.8]
    np.testing.assert_array_equal(kurt_brdf([below, above, [1, 0, 0]], [above, below, above], lobe), 0)


def test_grazing_factor_is_finite_everywhere():
    cos_i, cos_o = np.meshgrid([-1, -1e-9, 0, 1e-300, 1e-4, 1], [-1, 0, 1e-9, 1e-4, 1])
    for alpha in (0, 0.5, 1):
        factor = grazing_factor(cos_i, cos_o, alpha)
        assert np.all(np.isfinite(factor))
        np.testing.assert_array_equal(factor[cos_i <= 0], 0)
    assert grazing_factor(0.25, 0.04, 0.5) == pytest.approx(0.5 / 0.2)


@pytest.mark.parametrize("m", [(0.1, 0.1), (0.3, 0.05), (1.0, 1.0), (1e-3, 1e-3)])
def test_samples_follow_their_density(rng, m):
    count, cells = 200_000, 20
    h = kurt_sample(rng.random(count), rng.random(count), *m)
    # Cells in radius and azimuth of the slopes in units of roughness; their chance by quadrature of D cos_h.
    s = np.linspace(0, 3.5, cells + 1)
    x, w = np.polynomial.legendre.leggauss(8)
    middle, half = (s[1:] + s[:-1]) / 2, np.diff(s) / 2
    nodes = middle[:, None] + half[:, None] * x
    expected = np.zeros((cells, cells))
    for k in range(cells):
        phi = 2 * np.pi * (k + 0.5 + 0.5 * x) / cells
        grid = np.meshgrid(nodes.ravel(), phi, indexing="ij")
        slope_x, slope_y = m[0] * grid[0] * np.cos(grid[1]), m[1] * grid[0] * np.sin(grid[1])
        at = normalize(np.stack([slope_x, slope_y, np.ones_like(slope_x)], axis=-1))
        density = kurt_pdf(at, *m) * at[..., 2] ** 3 * m[0] * m[1] * grid[0]
        weight = (half[:, None] * w).ravel()[:, None] * (w * np.pi / cells)[None, :]
        expected[:, k] = (density * weight).reshape(cells, -1).sum(axis=1)
    radius = np.hypot(h[:, 0] / m[0], h[:, 1] / m[1]) / h[:, 2]
    azimuth = np.mod(np.arctan2(h[:, 1] / m[1], h[:, 0] / m[0]), 2 * np.pi)
    observed = np.histogram2d(radius, azimuth, [s, np.linspace(0, 2 * np.pi, cells + 1)])[0]
    observed = np.append(observed, count - observed.sum())
    expected = np.append(expected, 1 - expected.sum()) * count
    assert chi_square_test(observed, expected) > sidak_level(0.01, 4)


def test_samples_at_the_ends_of_their_range():
    h = kurt_sample([0.0, 1 - 2**-53, MIN_X1], [0.0, 0.5, 1 - 2**-53], 1e-3, 1.0)
    assert np.all(np.isfinite(h))
    np.testing.assert_allclose(np.linalg.norm(h, axis=-1), 1, rtol=1e-15)


def test_density_of_directions_integrates_to_one(rng):
    # Over directions below the horizon too, uniformly over the sphere.
    m, o = (0.4, 0.2), normalize([0.3, -0.5, 0.8])
    z, phi = rng.uniform(-1, 1, 10**6), rng.uniform(0, 2 * np.pi, 10**6)
    i = np.stack([np.sqrt(1 - z * z) * np.cos(phi), np.sqrt(1 - z * z) * np.sin(phi), z], axis=-1)
    h = normalize(i + o)
    assert np.mean(kurt_pdf_omega_i(h, o, *m)) * 4 * np.pi == pytest.approx(1, abs=0.02)


def test_reflection_is_an_involution(rng):
    o, h = normalize(rng.normal(size=(2, 100, 3)))
    i = reflect(o, h)
    np.testing.assert_allclose(reflect(i, h), o, atol=1e-14)
    np.testing.assert_allclose(dot(i, h), dot(o, h), atol=1e-14)
