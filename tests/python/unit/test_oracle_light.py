"""Spherical harmonics, albedo and the material mapping, against closed forms."""

import numpy as np
import pytest

from burnish.oracle.albedo import blend_albedo, directional_albedo
from burnish.oracle.arrays import dot, normalize
from burnish.oracle.cube_map import texel_directions, texel_solid_angle
from burnish.oracle.estimator import shade_diffuse
from burnish.oracle.lobe.kurt import kurt_sample
from burnish.oracle.metallic_roughness import MetallicRoughness, map_metallic_roughness
from burnish.oracle.spherical_harmonics import harmonics, irradiance, project_cube


def view(degrees, azimuth=0.0):
    theta = np.radians(degrees)
    return np.array([np.sin(theta) * np.cos(azimuth), np.sin(theta) * np.sin(azimuth), np.cos(theta)])


def test_harmonics_are_orthonormal():
    basis = harmonics(texel_directions(64))
    weights = texel_solid_angle(64)[None, :, :, None]
    gram = (basis * weights).reshape(-1, 9).T @ basis.reshape(-1, 9)
    np.testing.assert_allclose(gram, np.eye(9), atol=1e-3)


def test_irradiance_of_constant_light_is_pi(rng):
    coefficients = project_cube(np.ones((6, 16, 16, 3)))
    np.testing.assert_allclose(
        irradiance(coefficients, normalize(rng.normal(size=(50, 3)))), np.pi, rtol=1e-3
    )


def test_irradiance_of_a_linear_and_a_quadratic_lobe(rng):
    # The clamped cosine takes band 1 by 2 pi/3 and band 2 by pi/4: E of (1 + a.d) is pi + 2 pi/3 a.n,
    # and E of (c.d)^2 - 1/3 is pi/4 ((c.n)^2 - 1/3).
    a, c, n = normalize(rng.normal(size=(3, 3)))
    d = texel_directions(128)
    faces = 1 + dot(d, a)[..., None] + (dot(d, c)[..., None] ** 2 - 1 / 3)
    expected = np.pi + 2 * np.pi / 3 * (a @ n) + np.pi / 4 * ((c @ n) ** 2 - 1 / 3)
    assert irradiance(project_cube(faces), n)[0] == pytest.approx(expected, rel=1e-4)


def test_irradiance_of_the_cosine_lobe_peaks_as_stated():
    # Light max(0, z): three bands give 3.1416 * (1/4 + 1/3 + 5/64 ...) at its pole, against 2 pi/3 exactly.
    d = texel_directions(128)
    up = irradiance(project_cube(np.maximum(d[..., 2:], 0)), [0, 0, 1.0])[0]
    assert up == pytest.approx(np.pi * (1 / 4 + 1 / 3 + 5 / 64), rel=1e-3)


def test_diffuse_light_is_never_negative():
    faces = np.zeros((6, 16, 16, 3))
    faces[4, 7:9, 7:9] = 1000
    coefficients = project_cube(faces)
    sideways = normalize([1.0, 0, -0.4])
    assert np.min(irradiance(coefficients, sideways)) < 0
    np.testing.assert_array_equal(shade_diffuse(coefficients, sideways, 1.0), 0)
    np.testing.assert_allclose(
        shade_diffuse(coefficients, [0, 0, 2.0], (0.5, 0.25, 0)),
        irradiance(coefficients, [0, 0, 1.0]) * np.array([0.5, 0.25, 0]) / np.pi,
    )


@pytest.mark.parametrize("roughness", [(0.1, 0.1), (0.3, 0.05), (1.0, 1.0), (0.05, 0.6)])
@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
def test_albedo_equals_a_monte_carlo_mean(roughness, alpha, rng):
    h = kurt_sample(rng.random(400_000), rng.random(400_000), *roughness)
    for o in (view(0), view(60, 0.4), view(85, 1.2), view(89.5, 3)):
        o_h = h @ o
        cos_i = 2 * o_h * h[:, 2] - o[2]
        weight = np.where(cos_i > 0, np.maximum(cos_i, 1e-300) ** (1 - alpha) * o[2] ** -alpha / h[:, 2], 0)
        for part, value in enumerate((weight, weight * (1 - np.clip(o_h, 0, 1)) ** 5)):
            error = np.std(value) / np.sqrt(len(value))
            found = directional_albedo(o, roughness, alpha)[part]
            assert abs(found - np.mean(value)) < 4.5 * error + 1e-12, (o, part)


def test_albedo_of_a_narrow_lobe_is_cos_to_the_power_1_minus_2_alpha():
    for degrees in (0, 60, 85):
        for alpha in (0.0, 0.5, 1.0):
            c = np.cos(np.radians(degrees))
            parts = directional_albedo(view(degrees), 1e-3, alpha)
            assert parts[0] == pytest.approx(c ** (1 - 2 * alpha), rel=2e-4)
            assert parts[1] == pytest.approx(c ** (1 - 2 * alpha) * (1 - c) ** 5, rel=1e-3, abs=1e-12)


def test_albedo_at_85_degrees_gains_energy_for_alpha_1():
    assert directional_albedo(view(85), 0.01, 1.0)[0] == pytest.approx(11.4, abs=0.1)
    assert directional_albedo(view(85), 0.1, 1.0)[0] == pytest.approx(8.42, abs=0.01)


@pytest.mark.parametrize("roughness", [0.05, 0.3, 1.0, (0.3, 0.05)])
def test_albedo_never_exceeds_one_for_alpha_0(roughness):
    o = np.stack([view(t, p) for t in np.linspace(0, 90, 46) for p in (0, 0.8, 1.5)])
    assert np.max(directional_albedo(o, roughness, 0.0)) <= 1 + 1e-9


def test_albedo_is_finite_for_views_at_and_behind_the_horizon():
    parts = directional_albedo([[1, 0, 0], [0.6, 0, -0.8], [0, 1, 1e-9]], (1.0, 1e-3), 1.0)
    assert np.all(np.isfinite(parts)) and np.all(parts >= 0)


def test_blend_is_linear_in_r0():
    np.testing.assert_allclose(blend_albedo([0.8, 0.1], (0.0, 0.5, 1.0)), [0.1, 0.45, 0.8])


def test_dielectric_lies_over_its_diffuse_part():
    material = map_metallic_roughness(MetallicRoughness((0.8, 0.4, 0.2), metallic=0, roughness=0.5))
    (lobe,) = material.lobes
    assert lobe.roughness == (0.25, 0.25) and lobe.f90 == 1.0 and lobe.weight == (1, 1, 1)
    np.testing.assert_allclose(lobe.r0, 0.04)
    np.testing.assert_allclose(material.diffuse, [0.8, 0.4, 0.2])
    ((share, is_over_emission),) = material.covers
    np.testing.assert_allclose(share, (0.04, 0.96))
    assert not is_over_emission


def test_dielectric_maps_to_diffuse_and_a_white_grazing_lobe():
    source = MetallicRoughness((0.8, 0.4, 0.2), metallic=0, roughness=0.5)
    material = map_metallic_roughness(source, model="kurt")
    (lobe,) = material.lobes
    assert lobe.roughness == (0.25, 0.25) and lobe.alpha == 0.5 and lobe.weight == (1, 1, 1)
    np.testing.assert_allclose(lobe.r0, 0.04)
    np.testing.assert_allclose(material.diffuse, np.array([0.8, 0.4, 0.2]) * 0.96)


def test_metal_maps_to_a_coloured_lobe_alone():
    material = map_metallic_roughness(MetallicRoughness((1, 0.7, 0.3), roughness=0, specular=0.3))
    (lobe,) = material.lobes
    assert lobe.roughness == (1e-3, 1e-3) and lobe.weight == (1, 1, 1)
    np.testing.assert_allclose(lobe.r0, [1, 0.7, 0.3])
    np.testing.assert_array_equal(material.diffuse, 0)


def test_specular_scales_normal_and_grazing_reflection():
    source = MetallicRoughness(0.5, metallic=0, specular=0.5, specular_color=(1, 0.5, 40))
    (lobe,) = map_metallic_roughness(source).lobes
    np.testing.assert_allclose(lobe.weight, 0.5)
    np.testing.assert_allclose(np.multiply(lobe.weight, lobe.r0), [0.02, 0.01, 0.5])
    np.testing.assert_allclose(map_metallic_roughness(source, model="kurt").diffuse, 0.5 * (1 - 0.5))
    assert map_metallic_roughness(source).covers == (((0.5, 0.0), False),)
    assert map_metallic_roughness(MetallicRoughness(0.5, metallic=0, specular=0)).lobes == []


def test_anisotropy_and_clearcoat():
    source = MetallicRoughness(1.0, roughness=0.4, anisotropy=0.5, anisotropy_rotation=0.3, clearcoat=0.7)
    material = map_metallic_roughness(source)
    base, coat = material.lobes
    assert material.covers[1] == (None, True)
    np.testing.assert_allclose(base.roughness, (0.16 * 0.75 + 0.25, 0.16))
    assert base.rotation == 0.3
    assert coat.roughness == (1e-3, 1e-3) and coat.r0 == 0.04 and coat.weight == (0.7,) * 3
