"""Captured maps: what arrives at a point, against rays cast in numpy; and objects that reflect them."""

import numpy as np
import pytest

import burnish
from burnish.environments import cube_directions
from burnish.oracle.render import capture as oracle_capture
from engine_support import oracle_objects, smooth_environment_faces
from image_compare import relative_rmse

FACE_SIZE = 64
RED, GREEN = (8.0, 0.5, 0.5), (0.1, 4.0, 0.2)


def placed(scale, translation):
    matrix = np.diag([*np.broadcast_to(np.float64(scale), 3), 1.0])
    matrix[:3, 3] = translation
    return matrix


@pytest.fixture(scope="module")
def environment():
    return burnish.Environment.from_faces(smooth_environment_faces(64))


def room(environment):
    """A floor, a red lamp to the right, a green ball behind, and a mirror ball in the middle."""
    scene = burnish.Scene()
    mirror = burnish.Material(diffuse=0.1, lobes=[burnish.KurtLobe(roughness=0.1)])
    scene.add(
        burnish.Mesh.plane(8.0), burnish.Material(diffuse=(0.6, 0.5, 0.4)), placed(1, (0, -1, 0)), "floor"
    )
    scene.add(
        burnish.Mesh.sphere(1.0, 48), burnish.Material(emissive=RED), placed(0.5, (2, 0.3, 0.1)), "lamp"
    )
    scene.add(
        burnish.Mesh.sphere(1.0, 48),
        burnish.Material(diffuse=0.3, emissive=GREEN),
        placed((0.7, 0.4, 0.5), (0.2, 0.6, -2)),
        "behind",
    )
    scene.add(burnish.Mesh.sphere(1.0, 64), mirror, placed(0.6, (0, 0, 0)), "mirror")
    scene.environment = environment
    return scene


def silhouettes(expected):
    """Texels beside which an object ends: there a texel may fall to either side."""
    jump = np.zeros(expected.shape[:3], bool)
    for axis in (1, 2):
        for shift in (-1, 1):
            near = np.roll(expected, shift, axis=axis)
            jump |= np.abs(near - expected).max(axis=-1) > 0.2 * expected.mean()
    return jump


def compare(device, scene, point, without=None, name=None):
    got = scene.capture(point=point, object=name, face_size=FACE_SIZE, device=device).faces
    levels = scene.environment.pyramid(device=device)
    expected = oracle_capture(oracle_objects(scene), point, FACE_SIZE, levels, without)
    inside = ~silhouettes(expected)
    assert inside.mean() > 0.75
    error = np.abs(got - expected).max(axis=-1) / expected.mean(axis=-1)
    assert error[inside].max() <= 0.01, f"{np.sum(error[inside] > 0.01)} texels are off by more than 1 %"
    assert relative_rmse(got[inside], expected[inside]) <= 1e-3
    return got


def test_captured_map_equals_cast_rays(device, environment):
    compare(device, room(environment), (0.4, 0.9, 0.3))


def test_captured_map_leaves_its_object_out(device, environment):
    scene = room(environment)
    got = compare(device, scene, (0.0, 0.0, 0.0), without=3, name="mirror")
    # From inside the ball, with the ball left in, one would see its back faces or nothing of it: from a point
    # beside it the ball would show.
    without = scene.capture(point=(0.0, 1.2, 0.0), object="mirror", face_size=FACE_SIZE, device=device).faces
    within = scene.capture(point=(0.0, 1.2, 0.0), face_size=FACE_SIZE, device=device).faces
    assert np.abs(within[3, 32, 32] - without[3, 32, 32]).max() > 0.01
    np.testing.assert_allclose(within[2], without[2], rtol=1e-3)
    assert np.isfinite(got).all()


def test_captured_map_of_an_object_is_taken_at_its_centroid(device, environment):
    scene = room(environment)
    named = scene.capture(object="mirror", face_size=16, device=device).faces
    numbered = scene.capture(object=3, face_size=16, device=device).faces
    at_point = scene.capture(point=(0, 0, 0), object="mirror", face_size=16, device=device).faces
    np.testing.assert_array_equal(named, numbered)
    np.testing.assert_allclose(named, at_point, rtol=0.05, atol=0.05)


def test_captured_map_without_objects_is_the_environment(device, environment):
    """Texel centres meet texel centres: the far map comes back, in half precision."""
    scene = burnish.Scene()
    scene.environment = environment
    captured = scene.capture(point=(3, -2, 1), face_size=64, device=device)
    np.testing.assert_allclose(captured.faces, environment.faces, rtol=2e-3)


@pytest.mark.parametrize("axis", range(6))
def test_captured_map_has_each_object_on_its_side(device, axis):
    """A lamp along one axis lights the middle of that face, and a lamp off the middle its right texels."""
    direction = np.float64([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]][axis])
    offset = 0.4 * np.roll(direction, 1) + 0.2 * np.roll(direction, 2)
    scene = burnish.Scene()
    scene.add(
        burnish.Mesh.sphere(1.0, 32), burnish.Material(emissive=RED), placed(0.2, 2 * (direction + offset))
    )
    faces = scene.capture(point=(0, 0, 0), face_size=64, device=device).faces
    lit = faces[..., 0] > 1
    assert lit[axis].sum() > 10 and lit.sum() == lit[axis].sum()
    seen = (cube_directions(64) * lit[..., None]).sum(axis=(0, 1, 2))
    wanted = direction + offset
    cosine = seen @ wanted / np.linalg.norm(seen) / np.linalg.norm(wanted)
    assert cosine > np.cos(np.radians(0.5))


def test_object_reflects_its_captured_map(device, environment):
    """The lamp is seen in the ball only by its own map, and the ball then looks as if lit by that map."""
    scene = room(environment)
    # The camera looks from the lamp's side, so that the ball's right half mirrors the lamp.
    camera = burnish.Camera.look_at((1.0, 1.0, 3.0), (0, 0, 0), vertical_fov=0.4)
    sampler = burnish.Regular(normalization="published")
    far = burnish.render(scene, camera, (48, 48), sampler, device=device)
    own = scene.capture(object="mirror", face_size=64, device=device)
    scene.find_object("mirror").reflects = own
    near = burnish.render(scene, camera, (48, 48), sampler, device=device)
    ball = np.abs(far.color - near.color).max(axis=-1) > 1e-6
    assert ball.sum() > 200
    assert next(line for line in near.report.effects if line["name"] == "own maps")["on"]
    alone = burnish.Scene()
    mirror = scene.objects[3]
    alone.add(scene.meshes[mirror.mesh], scene.materials[mirror.material], mirror.world_from_object)
    alone.environment = own
    expected = burnish.render(alone, camera, (48, 48), sampler, device=device)
    shown = (expected.alpha > 0) & np.isclose(expected.depth, near.depth, rtol=1e-4)
    assert shown.sum() > 200
    np.testing.assert_allclose(near.color[shown], expected.color[shown], rtol=1e-5, atol=1e-6)
    scene.find_object("mirror").reflects = None
    again = burnish.render(scene, camera, (48, 48), sampler, device=device)
    np.testing.assert_array_equal(again.color, far.color)


@pytest.mark.parametrize("face_size", [1, 2, 256])
def test_capture_makes_maps_of_every_power_of_two(device, environment, face_size):
    captured = room(environment).capture(point=(0, 1, 0), face_size=face_size, device=device)
    assert captured.face_size == face_size and np.isfinite(captured.faces).all()


def test_capture_refuses_other_face_sizes(device, environment):
    with pytest.raises(ValueError, match=r"face_size: expected a power of two in 1\.\.2048, got 48"):
        room(environment).capture(point=(0, 1, 0), face_size=48, device=device)


def test_capture_shows_a_turned_and_exposed_environment_as_it_is_in_the_world(device):
    rotation = np.float64([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    environment = burnish.Environment.from_faces(smooth_environment_faces(32), 1.0, rotation)
    scene = burnish.Scene()
    scene.environment = environment
    captured = scene.capture(point=(0, 0, 0), face_size=32, device=device)
    assert captured.exposure == 0
    # The map's +z is the world's +x, twice as bright.
    np.testing.assert_allclose(
        captured.faces[0, 15:17, 15:17].mean(axis=(0, 1)),
        2 * environment.faces[4, 15:17, 15:17].mean(axis=(0, 1)),
        rtol=2e-3,
    )
