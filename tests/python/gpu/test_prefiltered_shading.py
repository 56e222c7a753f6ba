"""The sampler `Prefiltered`: shading against the oracle on the engine's own levels, plan and report."""

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.oracle.albedo import blend_albedo, directional_albedo
from burnish.oracle.cube_map import sample_cube
from burnish.oracle.shading import shade as oracle_shade
from burnish.rendering import plan as plan_of
from engine_support import lookup_error, random_points, views_about_z

SAMPLER = burnish.Prefiltered()
ROUND = burnish.KurtLobe(roughness=0.1)
BRUSHED = burnish.KurtLobe(
    roughness=(0.2, 0.075), r0=(0.9, 0.5, 0.04), alpha=0.25, weight=(0.5, 1, 0.2), rotation=0.7
)
# The albedo's table is within 1e-3 of the integral from 3 degrees above the horizon. Float32 places a lookup
# within 1e-5 of a texel, of which the brightest changes by 1000 means.
ALBEDO_ERROR = 1.5e-3
LOOKUP_ERROR = 2e-4


@pytest.fixture(scope="module")
def points():
    return random_points(np.random.default_rng(11), 1000)


def material_of(*lobes, **rest):
    return burnish.Material(lobes=list(lobes), **rest)


def most_lit(material):
    """Most that the lobes brighten the map; 3: what a grazing exponent adds at most."""
    return 3 * sum(max(lobe.weight) for lobe in material.lobes)


def levels_of(environment, device):
    return [level for _, level in environment.prefiltered(device=device)]


def assert_close(device, got, expected, brightest):
    assert np.isfinite(got).all()
    allowed = LOOKUP_ERROR * expected.mean() + lookup_error(device, brightest)
    excess = np.abs(got - expected) - ALBEDO_ERROR * np.abs(expected) - allowed
    worst = np.unravel_index(np.argmax(excess), excess.shape)
    assert excess.max() <= 0, f"point {worst}: got {got[worst]}, expected {expected[worst]}"


def compare(device, environment, material, points):
    got = burnish.shade(environment, material, SAMPLER, *points, device=device)
    expected = oracle_shade(levels_of(environment, device), material, SAMPLER, *points)
    assert_close(device, got, expected, most_lit(material) * environment.faces.max())


@pytest.mark.parametrize("roughness", [1e-3, 0.01, 0.03, 0.05, 0.1, 0.2, 0.6, 1.0, (0.05, 0.4), (0.4, 0.05)])
def test_shade_equals_oracle_for_narrow_and_wide_lobes(device, spots64, points, roughness):
    compare(device, spots64, material_of(burnish.KurtLobe(roughness=roughness, rotation=-2.1)), points)


@pytest.mark.parametrize("alpha", [0.0, 0.25, 0.5, 1.0])
@pytest.mark.parametrize("r0", [1.0, 0.04, (1.0, 0.5, 0.0)], ids=["mirror", "dielectric", "coloured"])
def test_shade_equals_oracle_for_fresnel_and_grazing_exponents(device, spots64, points, alpha, r0):
    compare(
        device,
        spots64,
        material_of(burnish.KurtLobe(roughness=0.15, r0=r0, alpha=alpha, weight=(1.5, 0.7, 0.1))),
        points,
    )


def test_shade_adds_several_lobes_diffuse_and_emission(device, spots64, points):
    lobes = [ROUND, BRUSHED, burnish.KurtLobe(roughness=0.4, r0=0.04, alpha=0.5, weight=0.3)]
    compare(device, spots64, material_of(*lobes, diffuse=(0.2, 0.3, 0.4), emissive=(0.5, 0.0, 2.0)), points)


def test_lobe_that_conserves_energy_equals_oracle(device, spots64, points):
    lobe = burnish.KurtLobe(roughness=(0.6, 0.2), alpha=0.75, conserve_energy=True)
    compare(device, spots64, material_of(lobe), points)


@pytest.mark.parametrize("face_size", [1, 2, 4])
def test_shade_equals_oracle_on_the_smallest_maps(device, rng, points, face_size):
    faces = rng.uniform(0, 4, (6, face_size, face_size, 3)).astype(np.float32)
    environment = burnish.Environment.from_faces(faces)
    for lobe in (ROUND, burnish.KurtLobe(roughness=0.8)):
        compare(device, environment, material_of(lobe), points)


def test_shade_turns_and_exposes_the_map(device, points):
    c, s = np.cos(0.8), np.sin(0.8)
    rotation = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    environment = environments.spots(face_size=64)
    environment.rotation, environment.exposure = rotation, 1.5
    got = burnish.shade(environment, material_of(BRUSHED), SAMPLER, *points, device=device)
    in_map = [p @ rotation for p in points]
    levels = levels_of(environment, device)
    expected = 2.0**1.5 * oracle_shade(levels, material_of(BRUSHED), SAMPLER, *in_map)
    assert_close(device, got, expected, 2.0**1.5 * environment.faces.max())


@pytest.mark.parametrize("roughness", [0.02, 0.1, 0.6, 1.0, (0.2, 0.075), (0.05, 0.3)], ids=str)
@pytest.mark.parametrize(("alpha", "r0"), [(0.0, 1.0), (0.5, 0.04), (1.0, 1.0)])
def test_white_furnace_shows_the_albedo(device, uniform, roughness, alpha, r0):
    views = views_about_z(np.linspace(0.05, 1, 48), np.linspace(0, np.pi / 2, 25))
    lobe = burnish.KurtLobe(roughness=roughness, alpha=alpha, r0=r0)
    got = burnish.shade(uniform, material_of(lobe), SAMPLER, *views, device=device)
    expected = blend_albedo(directional_albedo(views[2], lobe.roughness, alpha), r0)
    np.testing.assert_allclose(got, expected, rtol=1e-3)


def test_narrowest_lobe_is_a_mirror(device, smooth64, points):
    """Its albedo is cos_o at alpha 0, from 10 degrees above the horizon on."""
    normals, tangents, views = (p[np.sum(points[0] * points[2], axis=-1) > 0.2] for p in points)
    lobe = burnish.KurtLobe(roughness=1e-3)
    got = burnish.shade(smooth64, material_of(lobe), SAMPLER, normals, tangents, views, device=device)
    cos_o = np.sum(normals * views, axis=-1, keepdims=True)
    mirrored = sample_cube(smooth64.pyramid(device=device), 2 * cos_o * normals - views)
    np.testing.assert_allclose(got, mirrored * cos_o, rtol=2e-3)


@pytest.mark.parametrize("roughness", [0.1, 0.4])
def test_view_along_the_normal_is_near_the_truth(device, smooth64, roughness):
    """The view, and with r0 = 1 and alpha = 0 the weights, that the map is made for.

    What is left, 1 %, is the blend of two levels.
    """
    normals, tangents, _ = random_points(np.random.default_rng(3), 200)
    material = material_of(burnish.KurtLobe(roughness=roughness))
    got, truth = (
        burnish.shade(smooth64, material, sampler, normals, tangents, normals, device=device)
        for sampler in (SAMPLER, burnish.Reference(method="quadrature"))
    )
    assert np.sqrt(np.mean((got - truth) ** 2) / np.mean(truth**2)) < 0.015


@pytest.mark.parametrize("cos_o", [1e-2, 1e-4, 0.0, -1e-4, -0.5])
def test_grazing_views_are_finite_and_views_from_behind_black(device, spots64, cos_o):
    normals, tangents = np.float32([[0, 0, 1]]), np.float32([[1, 0, 0]])
    views = np.float32([[np.sqrt(1 - cos_o**2), 0, cos_o]])
    lobes = burnish.KurtLobe(roughness=0.05, alpha=0.5), burnish.KurtLobe(roughness=1.0, alpha=1.0)
    got = burnish.shade(spots64, material_of(*lobes), SAMPLER, normals, tangents, views, device=device)
    assert np.isfinite(got).all() and (got > 0).all() == (cos_o > 0)


def test_samplers_that_take_turns_get_each_its_own_map(device):
    environment = environments.spots(face_size=32)
    points = random_points(np.random.default_rng(2), 100)
    samplers = [burnish.Importance(), SAMPLER] * 2
    first, second, third, fourth = (
        burnish.shade(environment, material_of(ROUND), sampler, *points, device=device)
        for sampler in samplers
    )
    np.testing.assert_array_equal(first, third)
    np.testing.assert_array_equal(second, fourth)
    expected = oracle_shade(levels_of(environment, device), material_of(ROUND), SAMPLER, *points)
    assert_close(device, second, expected, environment.faces.max())


def sphere_scene(environment, *lobes):
    scene = burnish.Scene.sphere(material_of(*lobes))
    scene.environment = environment
    return scene


def test_objects_with_maps_of_their_own_reflect_these(device):
    """Maps of one size lie in one cube array, prefiltered one after the other."""
    maps = [environments.uniform(radiance, face_size=16) for radiance in (0.25, 1.0, 4.0)]
    scene = burnish.Scene.spheres([material_of(burnish.KurtLobe(roughness=0.3))] * 3, columns=3)
    scene.environment = maps[0]
    for one, own in zip(scene.objects, maps, strict=True):
        one.reflects = own
    got, expected = (
        burnish.render(scene, size=(32, 96), sampler=sampler, device=device).color
        for sampler in (SAMPLER, burnish.Regular(normalization="furnace"))
    )
    np.testing.assert_allclose(got, expected, rtol=1e-3)
    assert expected.max() > 3.0, "the brightest map is not seen"


def passes(lines):
    return [line["name"] for line in lines]


def test_prefilter_pass_is_planned_for_this_sampler_and_lobes_only(spots64):
    scene = sphere_scene(spots64, ROUND)
    plan = plan_of(scene, SAMPLER)
    assert passes(plan["passes"])[:2] == ["pyramid", "prefilter"]
    assert all(line["reason"] for line in plan["passes"])
    assert {one["table"] for one in plan["classes"]} == {"prefiltered"}
    assert "one lookup a lobe" in plan["classes"][0]["reason"]
    for sampler in (burnish.Regular(), burnish.Importance(), burnish.Reference()):
        assert "prefilter" not in passes(plan_of(scene, sampler)["passes"])
    assert not {"pyramid", "prefilter"} & set(passes(plan_of(sphere_scene(spots64), SAMPLER)["passes"]))


def test_plan_says_that_brushed_lobes_are_taken_round(spots64):
    text = "slope sqrt(mx my)"
    brushed = plan_of(sphere_scene(spots64, BRUSHED), SAMPLER)
    assert text in brushed["classes"][0]["reason"] and any(text in line for line in brushed["warnings"])
    plain = plan_of(sphere_scene(spots64, ROUND), SAMPLER)
    assert text not in plain["classes"][0]["reason"] and not plain["warnings"]
    assert not plan_of(sphere_scene(spots64, BRUSHED), burnish.Regular())["warnings"]


def test_frame_runs_the_prefilter_once_and_reports_one_lookup(device):
    scene = sphere_scene(environments.spots(face_size=32), ROUND)
    reports = [burnish.render(scene, size=(16, 16), sampler=SAMPLER, device=device).report for _ in range(2)]
    assert {"pyramid", "prefilter"} <= set(passes(reports[0].passes))
    assert not {"pyramid", "prefilter"} & set(passes(reports[1].passes))
    for report in reports:
        assert [one["samples"] for one in report.classes] == ["1"] and report.samples_used == "1"
        assert report.sampler["requested"] == "prefiltered"


def test_background_is_as_sharp_as_ever(device, spots64):
    scene = sphere_scene(spots64, ROUND)
    frames = [
        burnish.render(scene, size=(24, 32), sampler=sampler, device=device)
        for sampler in (SAMPLER, burnish.Regular())
    ]
    behind = frames[0].alpha == 0
    np.testing.assert_array_equal(frames[0].color[behind], frames[1].color[behind])
