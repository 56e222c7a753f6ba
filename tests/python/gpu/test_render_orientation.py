"""Which way is up, right and toward: colours on the axes appear where the conventions put them."""

import numpy as np
import pytest

import burnish

# One colour for each of +X -X +Y -Y +Z -Z.
COLORS = np.float32([[1, 0, 0], [0, 1, 1], [0, 1, 0], [1, 0, 1], [0, 0, 1], [1, 1, 0]])
AXES = np.float32([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])


@pytest.fixture(scope="module")
def painted():
    return burnish.Environment.from_faces(
        np.ascontiguousarray(np.broadcast_to(COLORS[:, None, None], (6, 16, 16, 3)))
    )


def nothing_but(environment):
    scene = burnish.Scene()
    scene.environment = environment
    return scene


def up_for(forward):
    return (0, 1, 0) if abs(forward[1]) < 0.5 else (0, 0, 1)


@pytest.mark.parametrize("face", range(6))
def test_background_shows_each_face_along_its_axis(device, painted, face):
    forward = AXES[face]
    camera = burnish.Camera.look_at((0, 0, 0), forward, up_for(forward), vertical_fov=0.8)
    frame = burnish.render(nothing_but(painted), camera, (8, 8), device=device)
    np.testing.assert_array_equal(frame.color, np.broadcast_to(COLORS[face], (8, 8, 3)))
    assert not frame.alpha.any()


def test_background_has_up_in_row_0_and_right_in_the_last_column(device, painted):
    """Seen along -z from the origin: +y above, -y below, +x to the right, -x to the left."""
    camera = burnish.Camera.look_at((0, 0, 0), (0, 0, -1), vertical_fov=2.6)
    color = burnish.render(nothing_but(painted), camera, (33, 33), device=device).color
    np.testing.assert_array_equal(color[16, 16], COLORS[5])
    np.testing.assert_array_equal(color[0, 16], COLORS[2])
    np.testing.assert_array_equal(color[32, 16], COLORS[3])
    np.testing.assert_array_equal(color[16, 32], COLORS[0])
    np.testing.assert_array_equal(color[16, 0], COLORS[1])


@pytest.mark.parametrize("is_orthographic", [False, True])
def test_objects_have_up_in_row_0_and_right_in_the_last_column(device, painted, is_orthographic):
    scene = burnish.Scene()
    for axis, color in zip(AXES, COLORS, strict=True):
        matrix = np.diag([0.2, 0.2, 0.2, 1.0])
        matrix[:3, 3] = axis
        scene.add(burnish.Mesh.sphere(1.0, 16), burnish.Material(emissive=color.tolist()), matrix)
    scene.environment = painted
    make = burnish.Camera.orthographic if is_orthographic else burnish.Camera.look_at
    extra = {"half_height": 1.3} if is_orthographic else {"vertical_fov": 0.75}
    camera = make((0, 0, 4), (0, 0, 0), **extra)
    color = burnish.render(scene, camera, (65, 65), device=device).color
    edge = 6 if is_orthographic else 11
    np.testing.assert_array_equal(color[32, 32], COLORS[4])  # the nearer of the two on the z axis
    np.testing.assert_array_equal(color[edge, 32], COLORS[2])
    np.testing.assert_array_equal(color[64 - edge, 32], COLORS[3])
    np.testing.assert_array_equal(color[32, 64 - edge], COLORS[0])
    np.testing.assert_array_equal(color[32, edge], COLORS[1])


@pytest.mark.parametrize("face", range(6))
def test_a_mirror_shows_the_face_it_looks_at(device, painted, face):
    """Seen along its normal, a smooth surface shows what is behind the eye."""
    normal = np.repeat(AXES[face][None], 4, axis=0)
    tangent = np.repeat(np.roll(AXES[face], 1)[None], 4, axis=0)
    material = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.02)])
    # The first of the 14 importance samples stands for the whole tail: it reads the coarsest level.
    for sampler, limit in (
        (burnish.Regular(), 1e-3),
        (burnish.Importance(), 0.05),
        (burnish.Reference(), 1e-2),
    ):
        got = burnish.shade(painted, material, sampler, normal, tangent, normal, device=device)
        np.testing.assert_allclose(got, np.broadcast_to(COLORS[face], (4, 3)), atol=limit)


def test_turning_the_environment_moves_the_background(device, painted):
    """world_from_environment a quarter turn about y takes the map's +z to the world's +x."""
    environment = burnish.Environment.from_faces(painted.faces, rotation=[[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    camera = burnish.Camera.look_at((0, 0, 0), (1, 0, 0))
    frame = burnish.render(nothing_but(environment), camera, (8, 8), device=device)
    np.testing.assert_array_equal(frame.color[4, 4], COLORS[4])


def test_depth_is_the_distance_along_the_axis(device, painted):
    scene = burnish.Scene()
    scene.add(burnish.Mesh.plane(20.0), burnish.Material(diffuse=0.5))
    scene.environment = painted
    camera = burnish.Camera.look_at((0, 3, 0), (0, 0, 0), up=(0, 0, -1))
    frame = burnish.render(scene, camera, (9, 9), device=device)
    np.testing.assert_allclose(frame.depth, 3.0, rtol=1e-5)
    np.testing.assert_allclose(frame.normal, np.broadcast_to([0, 1, 0], (9, 9, 3)), atol=1e-4)
