"""White furnaces: under light of 1 from everywhere a surface shows its albedo."""

import numpy as np
import pytest

import burnish
from burnish.oracle.albedo import blend_albedo, directional_albedo
from engine_support import random_points, views_about_z

ROUGHNESSES = [(0.02, 0.02), (0.1, 0.1), (0.3, 0.3), (0.6, 0.6), (1.0, 1.0), (0.2, 0.075), (0.05, 0.3)]
# From 3 degrees above the horizon to the normal, and over a quarter of the azimuth: the lobes are symmetric.
VIEWS = views_about_z(np.linspace(0.05, 1, 48), np.linspace(0, np.pi / 2, 25))
REGULAR = {name: burnish.Regular(normalization=name) for name in ("published", "projected", "furnace")}


def shade_white(device, uniform, sampler, lobe=None, views=VIEWS, **material):
    lobes = [] if lobe is None else [lobe]
    return burnish.shade(uniform, burnish.Material(lobes=lobes, **material), sampler, *views, device=device)


@pytest.mark.parametrize("roughness", ROUGHNESSES, ids=str)
@pytest.mark.parametrize(("alpha", "r0"), [(0.0, 1.0), (0.0, 0.04), (0.5, 1.0), (0.5, 0.04), (1.0, 1.0)])
def test_furnace_normalization_shows_the_albedo(device, uniform, roughness, alpha, r0):
    lobe = burnish.KurtLobe(roughness=roughness, alpha=alpha, r0=r0)
    got = shade_white(device, uniform, REGULAR["furnace"], lobe)
    expected = blend_albedo(directional_albedo(VIEWS[2], lobe.roughness, alpha), r0)
    np.testing.assert_allclose(got, expected, rtol=1e-3)


@pytest.mark.parametrize("roughness", ROUGHNESSES, ids=str)
@pytest.mark.parametrize("sampler", [*REGULAR.values(), burnish.Importance()], ids=[*REGULAR, "importance"])
def test_white_surface_of_alpha_0_returns_no_more_light_than_it_gets(device, uniform, roughness, sampler):
    """A finite pattern is not its integral: it may gain half a percent, the furnace 0.1 %."""
    got = shade_white(device, uniform, sampler, burnish.KurtLobe(roughness=roughness))
    assert got.max() <= (1 + 1e-3 if sampler is REGULAR["furnace"] else 1 + 5e-3)
    assert got.min() > 0


def test_diffuse_surface_shows_its_reflectance(device, uniform, rng):
    got = shade_white(
        device, uniform, REGULAR["furnace"], views=random_points(rng, 100), diffuse=(0.1, 0.5, 1)
    )
    np.testing.assert_allclose(got, np.broadcast_to([0.1, 0.5, 1.0], got.shape), rtol=1e-5)


@pytest.mark.parametrize("roughness", [(0.1, 0.1), (0.6, 0.6), (0.05, 0.3)], ids=str)
@pytest.mark.parametrize(("alpha", "r0"), [(0.0, 1.0), (0.5, 0.04), (1.0, 1.0)])
def test_reference_shows_the_albedo(device, uniform, roughness, alpha, r0):
    """On the mean over all points to three standard errors; each point to what chance leaves."""
    lobe = burnish.KurtLobe(roughness=roughness, alpha=alpha, r0=r0)
    views = views_about_z(np.linspace(0.1, 1, 8), np.linspace(0, np.pi / 2, 4))
    expected = blend_albedo(directional_albedo(views[2], lobe.roughness, alpha), r0)
    sampler = burnish.Reference(standard_error=0.001, method="progressive")
    got = shade_white(device, uniform, sampler, lobe, views)
    assert abs(got.mean() / expected.mean() - 1) <= 0.003
    np.testing.assert_allclose(got, expected, rtol=0.02)


def test_furnace_is_exact_in_a_picture_too(device, uniform):
    """With alpha 0 nothing of a sphere is brighter than the background; its middle shows the albedo."""
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.1)]))
    scene.environment = uniform
    camera = burnish.Camera.look_at((0, 0, 4), (0, 0, 0))
    frame = burnish.render(scene, camera, (49, 49), device=device)
    np.testing.assert_allclose(frame.color[frame.alpha == 0], 1.0, rtol=1e-6)
    assert frame.color.max() <= 1 + 1e-3
    np.testing.assert_allclose(frame.color[24, 24], directional_albedo([0, 0, 1], 0.1, 0.0)[0], rtol=1e-3)
