"""Light on diffuse surfaces: the cube of exact sums, nine harmonics by choice, and their errors."""

import numpy as np
import pytest

import burnish
from burnish.environments import cube_directions
from burnish.oracle.irradiance import cosine_sum, diffuse_light
from engine_support import directions, unit
from lit_maps import FACE_SIZE, MADE_MAPS, REAL_MAPS, lamp, make_map

WHITE = burnish.Material(diffuse=(1, 1, 1))
HARMONICS = burnish.Prefiltered(diffuse="harmonics")


def normals_of(rng, count=400):
    """Normals of all directions, and those where faces of a cube meet."""
    edges = np.array([[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)], float)
    edges = edges[np.any(edges != 0, axis=1)]
    near = np.repeat(edges, 4, axis=0) + 0.02 * rng.standard_normal((4 * len(edges), 3))
    return unit(np.concatenate([edges, near, rng.standard_normal((count, 3))]))


def seen_from_in_front(device, environment, normals, sampler=None, material=WHITE):
    tangents = np.cross(normals, unit(normals + np.array([0.3, 0.5, 0.8])))
    points = (directions(one) for one in (normals, tangents, normals))
    return burnish.shade(environment, material, sampler or burnish.Prefiltered(), *points, device=device)


def relative_rmse(got, expected):
    return np.sqrt(np.mean((got - expected) ** 2) / np.mean(expected**2))


@pytest.mark.parametrize("name", [*MADE_MAPS, *REAL_MAPS])
def test_the_cube_is_close_to_the_sum_over_every_texel(device, rng, request, name):
    environment = make_map(name, lambda: request.getfixturevalue("shared_data"))
    normals = normals_of(rng)
    exact = cosine_sum(environment.faces, normals)
    got = seen_from_in_front(device, environment, normals)
    assert relative_rmse(got, exact) <= 1.5e-3
    assert got.min() >= 0


@pytest.mark.parametrize("name", MADE_MAPS)
def test_the_cube_is_the_oracle_s(device, rng, name):
    """The oracle sums at each of the cube's normals; the engine's cells on the horizon leave out 1e-4."""
    environment = make_map(name, None)
    normals = normals_of(rng)
    expected = diffuse_light(environment.faces, normals, "cube")
    got = seen_from_in_front(device, environment, normals)
    np.testing.assert_allclose(got, expected, rtol=5e-4, atol=2e-4 * expected.max())


@pytest.mark.parametrize(
    "sampler", [burnish.Regular, burnish.Importance, burnish.Matched, burnish.Prefiltered]
)
def test_every_sampler_takes_both_forms(device, rng, sampler):
    environment, normals = lamp(), normals_of(rng, 100)
    material = burnish.Material(diffuse=(0.7, 0.5, 0.1))
    for form in ("cube", "harmonics"):
        got = seen_from_in_front(device, environment, normals, sampler(diffuse=form), material)
        expected = (0.7, 0.5, 0.1) * diffuse_light(environment.faces, normals, form)
        np.testing.assert_allclose(got, expected, rtol=1e-3, atol=1e-3 * expected.max())


def sphere(environment, material=WHITE):
    scene = burnish.Scene.sphere(material)
    scene.environment = environment
    return scene


def effect(report, name):
    return next(one for one in report.effects if one["name"] == name)


def test_the_report_says_which_form_and_how_good(device):
    environment = lamp()
    normals = cube_directions(32).reshape(-1, 3).astype(np.float64)
    normals = unit(normals)
    exact = cosine_sum(environment.faces, normals)
    frame = burnish.render(sphere(environment), size=(16, 16), device=device)
    assert "one lookup in a cube of exact sums" in effect(frame.report, "diffuse")["reason"]
    assert 1e-4 <= frame.report.diffuse_error <= 2e-3
    harmonics = burnish.render(sphere(environment), size=(16, 16), sampler=HARMONICS, device=device)
    true = relative_rmse(diffuse_light(environment.faces, normals, "harmonics"), exact)
    assert harmonics.report.diffuse_error == pytest.approx(true, rel=0.05) and true > 0.05
    reason = effect(harmonics.report, "diffuse")["reason"]
    assert "nine spherical harmonics, 7." in reason and reason.endswith(" % off")
    assert harmonics.report.sampler["requested"] == "prefiltered:diffuse=harmonics"
    reference = burnish.render(
        sphere(environment), size=(16, 16), sampler=burnish.Reference(method="quadrature"), device=device
    )
    assert reference.report.diffuse_error == 0.0
    assert "sum over every texel" in effect(reference.report, "diffuse")["reason"]


def test_a_map_s_cube_is_made_once_and_only_for_what_is_diffuse(device):
    environment = lamp(degrees=9.0)
    passes = []
    for material in (burnish.Material(lobes=[burnish.KurtLobe(0.3)]), WHITE, WHITE):
        report = burnish.render(sphere(environment, material), size=(8, 8), device=device).report
        passes.append([one["name"] for one in report.passes])
    assert ["irradiance" in names for names in passes] == [False, True, False]
    plan = burnish.rendering.plan(sphere(environment))
    assert any(one["name"] == "irradiance" and "1 map" in one["reason"] for one in plan["passes"])


def test_each_object_sees_its_own_turned_and_exposed_map(device):
    """Against the reference, which reads the maps themselves."""
    turn = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]], float)
    scene = burnish.Scene.spheres([burnish.Material(diffuse=0.8), WHITE, WHITE], columns=3)
    scene.environment = lamp()
    faces = lamp((0.1, -0.2, 0.9), 12).faces
    scene.objects[1].reflects = burnish.Environment.from_faces(faces, exposure=1.5, rotation=turn)
    scene.objects[2].reflects = burnish.environments.sky(face_size=FACE_SIZE // 2)
    truth = burnish.render(
        scene, size=(60, 120), sampler=burnish.Reference(method="quadrature"), device=device
    )
    for sampler in (burnish.Regular(), burnish.Matched()):
        frame = burnish.render(scene, size=(60, 120), sampler=sampler, device=device)
        assert frame.error(truth) <= 2e-3


def test_the_cube_is_linear_in_the_light(device, rng):
    """A map 2^40 times as dim, or 2^12 times as bright, looks the same: nothing is rounded to half floats."""
    normals, faces = normals_of(rng, 50), lamp(radiance=4.0).faces
    one = seen_from_in_front(device, burnish.Environment.from_faces(faces), normals)
    for stops in (-40, 12):
        scaled = burnish.Environment.from_faces(faces * np.float32(2.0**stops))
        got = seen_from_in_front(device, scaled, normals)
        np.testing.assert_allclose(got * 2.0**-stops, one, rtol=1e-5)


def test_error_estimates_contain_the_diffuse_light_s(device):
    scene = sphere(lamp())
    truth = burnish.render(
        scene, size=(40, 40), sampler=burnish.Reference(method="quadrature"), device=device
    )
    for sampler in (burnish.Matched(14), burnish.Matched(14, diffuse="harmonics")):
        frame = burnish.render(scene, size=(40, 40), sampler=sampler, device=device, error_estimate=True)
        error = frame.error(truth)
        assert error / 1.3 <= frame.estimated_error() <= 4 * error
