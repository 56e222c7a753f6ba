"""Point, directional and spot lights on every kind of material, against the oracle; and what they cost."""

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.oracle import direct_lights as oracle
from engine_support import random_points

MATERIALS = {
    "diffuse": burnish.Material(diffuse=(0.7, 0.4, 0.2)),
    "Kurt": burnish.Material(0.1, [burnish.KurtLobe((0.3, 0.1), r0=0.04, alpha=0.5, rotation=0.7)]),
    "GGX": burnish.Material(lobes=[burnish.GgxLobe((0.1, 0.4), r0=(0.9, 0.5, 0.04), compensate="scale")]),
    "layers": burnish.Material.metallic_roughness(0.6, roughness=0.6, clearcoat=0.8, clearcoat_roughness=0.3),
}
LIGHTS = {
    "point": burnish.PointLight((0.4, 2, 1), (3, 2, 1)),
    "sphere": burnish.PointLight((-1, 1.5, 2), 4.0, radius=0.3),
    "point that ends": burnish.PointLight((1, 1, 1), 2.0, range=2.5),
    "direction": burnish.DirectionalLight((0.2, -1, -2), (1, 2, 3)),
    "disc": burnish.DirectionalLight((-3, -1, 0.4), 2.0, angle=0.2),
    "spot": burnish.SpotLight((0, 3, 0), (0.3, -2, 0.5), 9.0, inner_angle=0.2, outer_angle=0.6, radius=0.1),
}


@pytest.fixture(scope="module")
def black():
    return burnish.Environment.from_faces(np.zeros((6, 1, 1, 3), np.float32))


@pytest.fixture(scope="module")
def points():
    rng = np.random.default_rng(7)
    return (*random_points(rng, 120), rng.uniform(-1.5, 1.5, (120, 3)).astype(np.float32))


def lit_scene(lights):
    scene = burnish.Scene()
    scene.lights = lights
    return scene


def shade(device, environment, material, sampler, points, lights):
    *frame, positions = points
    return burnish.shade(
        environment, material, sampler, *frame, device=device, positions=positions, scene=lit_scene(lights)
    )


def assert_close(got, expected, limit):
    scale = np.maximum(expected, np.mean(expected))
    assert np.max(np.abs(got - expected) / scale) < limit


@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("light", LIGHTS)
def test_lights_equal_the_oracle(device, black, points, material, light):
    material, lights = MATERIALS[material], [LIGHTS[light]]
    *frame, positions = points
    seen = np.sum(frame[0] * frame[2], axis=-1, keepdims=True) > 0
    expected = np.where(seen, oracle.shade_lights(material, lights, positions, *frame), 0.0)
    got = shade(device, black, material, burnish.Matched(3), points, lights)
    assert expected.any()
    assert_close(got, expected, 2e-3)
    for sampler in (burnish.Regular(14), burnish.Importance(5)):
        np.testing.assert_allclose(
            shade(device, black, material, sampler, points, lights), got, rtol=2e-3, atol=1e-6 * got.max()
        )


@pytest.mark.parametrize("method", ["quadrature", "progressive"])
def test_the_reference_sums_over_the_disc(device, black, points, method):
    """Of a wide lobe and of one much narrower than the light."""
    few = tuple(array[:24] for array in points)
    *frame, positions = few
    lights = list(LIGHTS.values())
    for lobe in (
        burnish.GgxLobe(0.3),
        burnish.KurtLobe(0.02, alpha=0.5),
        burnish.GgxLobe((0.02, 0.5), r0=0.04),
    ):
        material = burnish.Material(0.3, [lobe])
        seen = np.sum(frame[0] * frame[2], axis=-1, keepdims=True) > 0
        expected = np.where(
            seen, oracle.shade_lights(material, lights, positions, *frame, is_truth=True), 0.0
        )
        sampler = burnish.Reference(method=method)
        got = shade(device, black, material, sampler, few, lights)
        assert_close(got, expected, 1e-2)


def lamps(count):
    """Points and spots that end soon, around a sphere over a plane; a few that do not end."""
    rng = np.random.default_rng(3)
    for k in range(count):
        place, color = rng.uniform((-2, 0.2, -2), (2, 1.6, 2)), rng.uniform(0.2, 1, 3)
        if k % 2:
            yield burnish.PointLight(place, color, range=rng.uniform(0.4, 1.0))
        else:
            axis = rng.normal(size=3)
            yield burnish.SpotLight(
                place, axis, color, 0.1, rng.uniform(0.2, 1.5), range=None if k % 8 else 1.0
            )


@pytest.mark.parametrize("count", [4, 32, 71])
@pytest.mark.parametrize("place", [(0, 0, 0), (4e5, 0, -3e5)])
def test_pictures_show_what_points_show(device, black, count, place):
    """Tiles list the lights that reach them: none is lost, wherever the scene stands."""
    material = burnish.Material(0.5, [burnish.GgxLobe(0.4)])
    scene = burnish.Scene()
    move = np.eye(4)
    move[:3, 3] = place
    scene.add(burnish.Mesh.plane(3.0), material, move)
    up = move.copy()
    up[1, 3] += 0.8
    scene.add(burnish.Mesh.sphere(), material, up @ np.diag([0.6, 0.6, 0.6, 1]))
    scene.environment = black
    lights = list(lamps(count))
    scene.lights = [moved(light, place) for light in lights]
    eye = np.array([1, 2.5, 3.5])
    camera = burnish.Camera.look_at(eye + place, np.array(place, float), vertical_fov=0.9)
    frame = burnish.render(scene, camera, (45, 70), burnish.Matched(3), device)
    assert "light lists" in [one["kind"] for one in frame.report.passes]
    assert light_line(frame)["on"]
    met = frame.alpha > 0
    positions = frame.position[met]
    views = np.float32(eye + place - positions)
    got = burnish.shade(
        black, material, burnish.Matched(3), frame.normal[met], np.roll(frame.normal[met], 1, axis=1), views,
        device=device, positions=positions, scene=scene,
    )  # fmt: skip
    assert np.mean(got > 0) > 0.02
    # Normals of pictures are packed.
    assert_close(frame.color[met], got, 5e-3)


def light_line(frame):
    return next(one for one in frame.report.effects if one["name"] == "direct lights")


def moved(light, place):
    values = {name: getattr(light, name) for name in ("intensity", "range")}
    if isinstance(light, burnish.SpotLight):
        values |= {name: getattr(light, name) for name in ("direction", "inner_angle", "outer_angle")}
    return type(light)(position=np.add(light.position, place), **values)


def test_exposure_and_sun_leave_lights_as_they_are(device, points, spots64):
    material, lights = MATERIALS["layers"], list(LIGHTS.values())
    turned = burnish.Environment.from_faces(spots64.faces, exposure=-9, rotation=1.0)
    alone, both = (shade(device, turned, material, burnish.Matched(5), points, some) for some in ([], lights))
    black = burnish.Environment.from_faces(np.zeros((6, 1, 1, 3), np.float32))
    np.testing.assert_allclose(
        both - alone, shade(device, black, material, burnish.Matched(5), points, lights), rtol=1e-3, atol=1e-4
    )


def test_lights_without_light_are_absent(device, spots64):
    """What gives no light changes no pixel and no pass; without lights nothing of them is drawn."""
    scene = burnish.Scene.sphere(MATERIALS["layers"])
    scene.environment = spots64
    without = burnish.render(scene, size=(24, 24), device=device)
    scene.lights = [burnish.PointLight((0, 3, 0), 0.0, range=9), burnish.DirectionalLight((0, -1, 0), 0.0)]
    dark = burnish.render(scene, size=(24, 24), device=device)
    np.testing.assert_array_equal(dark.color, without.color)
    kinds = [[one["kind"] for one in frame.report.passes] for frame in (without, dark)]
    assert "light lists" not in kinds[1] and set(kinds[1]) <= set(kinds[0])
    assert not light_line(dark)["on"] and "none gives any light" in light_line(dark)["reason"]


def test_captured_maps_hold_light_on_diffuse_surfaces(device, black):
    scene = burnish.Scene.plane(burnish.Material(diffuse=0.5))
    scene.lights = [burnish.DirectionalLight((0, -1, 0), np.pi)]
    faces = scene.capture((0, 1, 0), face_size=8, device=device).faces
    np.testing.assert_allclose(faces[3], 0.5, rtol=2e-3)


def test_black_scenes_without_environment_are_lit(device):
    scene = burnish.Scene.sphere(burnish.Material(diffuse=0.5))
    scene.lights = [burnish.PointLight((0, 0, 3), 5.0)]
    frame = burnish.render(scene, size=(16, 16), device=device)
    assert frame.color.max() > 0.1 and not frame.report.warnings


@pytest.mark.parametrize(
    "make, text",
    [
        (lambda: burnish.PointLight((0, 0, np.nan)), "position: expected finite"),
        (lambda: burnish.PointLight((0, 0, 0), -1), "intensity: expected finite numbers >= 0, got -1"),
        (
            lambda: burnish.PointLight((0, 0, 0), 1, radius=-1),
            "radius: expected a finite number >= 0, got -1",
        ),
        (
            lambda: burnish.PointLight((0, 0, 0), 1, radius=2, range=1),
            "range: expected a finite number above",
        ),
        (
            lambda: burnish.DirectionalLight((0, 0, 0)),
            "direction: expected finite numbers of a length above 0",
        ),
        (lambda: burnish.DirectionalLight((0, 0, 1), angle=4), "angle: expected radians"),
        (lambda: burnish.SpotLight((0, 0, 0), (0, 0, 1), outer_angle=2), "outer_angle: expected radians"),
        (lambda: burnish.SpotLight((0, 0, 0), (0, 0, 1), 1, 0.5, 0.4), "inner_angle: expected radians"),
    ],
)
def test_bad_lights_are_refused(make, text):
    with pytest.raises(ValueError, match=text):
        make()


def test_points_need_places_for_lights_that_have_one(device, black, points):
    frame = points[:3]
    with pytest.raises(ValueError, match="positions: expected an array beside a scene with lights"):
        burnish.shade(
            black,
            MATERIALS["GGX"],
            burnish.Matched(3),
            *frame,
            device=device,
            scene=lit_scene([LIGHTS["point"]]),
        )
    with pytest.raises(ValueError, match="positions: expected C-contiguous float32 or float64 of shape"):
        burnish.shade(
            black, MATERIALS["GGX"], burnish.Matched(3), *frame, device=device, positions=points[3][:4]
        )


def test_lights_beyond_any_measure_stay_finite(device, points):
    """At a light, inside one, and at distances whose squares are no float32."""
    environment = environments.uniform(1.0, face_size=8)
    frame = [np.tile(np.float32([[0, 0, 1]]), (4, 1)) for _ in range(3)]
    frame[1] = np.tile(np.float32([[1, 0, 0]]), (4, 1))
    positions = np.array([[0, 0, 0], [0, 0, 1e-25], [1e25, 0, 0], [0, 0, -1e-3]])
    for radius in (0.0, 0.5):
        lights = [burnish.PointLight((0, 0, 0), 1.0, radius=radius, range=radius + 1.0)]
        for sampler in (burnish.Matched(3), burnish.Reference()):
            color = burnish.shade(
                environment, MATERIALS["layers"], sampler, *frame, device=device, positions=positions,
                scene=lit_scene(lights), strict=radius > 0,
            )  # fmt: skip
            assert np.isfinite(color).all()
