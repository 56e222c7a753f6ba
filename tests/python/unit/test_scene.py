"""Scenes, meshes, materials and cameras made in Python."""

import gc

import numpy as np
import pytest

import burnish

QUAD = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"roughness": 0.0}, r"roughness: expected 1e-06\.\.1, got 0"),
        ({"roughness": (0.1, 1.5)}, r"roughness: expected 1e-06\.\.1, got 1\.5"),
        ({"roughness": float("nan")}, r"roughness: expected 1e-06\.\.1, got nan"),
        ({"r0": (0.5, 0.5, 1.5)}, r"r0: expected 0\.\.1, got 1\.5"),
        ({"alpha": -0.5}, r"alpha: expected 0\.\.1, got -0\.5"),
        ({"weight": -1}, r"weight: expected finite numbers >= 0, got -1"),
        ({"rotation": float("inf")}, r"rotation: expected a finite number, got inf"),
    ],
)
def test_lobe_names_what_is_out_of_range(arguments, text):
    with pytest.raises(ValueError, match=text):
        burnish.KurtLobe(**arguments)


def test_lobe_takes_one_number_or_one_per_axis():
    lobe = burnish.KurtLobe(roughness=0.25, r0=0.5, weight=2)
    assert lobe.roughness == (0.25, 0.25)
    assert lobe.r0 == (0.5, 0.5, 0.5)
    assert lobe.weight == (2, 2, 2)
    assert not lobe.is_anisotropic and lobe.has_fresnel
    lobe = burnish.KurtLobe(roughness=(0.25, 0.5), r0=np.ones(3), rotation=1)
    assert lobe.is_anisotropic and not lobe.has_fresnel


def test_values_do_not_change_behind_a_scene():
    lobe = burnish.KurtLobe()
    with pytest.raises(AttributeError):
        lobe.alpha = 0.5
    scene = burnish.Scene.sphere(burnish.Material(lobes=[lobe]))
    scene.set_material(0, burnish.Material(diffuse=0.5))
    assert scene.materials[0].diffuse == (0.5, 0.5, 0.5)
    with pytest.raises(ValueError, match="index: expected an index below 1, got 1"):
        scene.set_material(1, burnish.Material())


def test_material_limits_its_lobes():
    with pytest.raises(ValueError, match="lobes: expected at most 4, got 5"):
        burnish.Material(lobes=[burnish.KurtLobe()] * 5)
    with pytest.raises(ValueError, match=r"diffuse: expected 0\.\.1, got 2"):
        burnish.Material(diffuse=2)


def test_mesh_returns_what_it_was_given():
    uv = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32)
    mesh = burnish.Mesh(QUAD, TRIANGLES, uv0=uv, name="quad")
    np.testing.assert_array_equal(mesh.positions, QUAD)
    np.testing.assert_array_equal(mesh.indices, TRIANGLES)
    np.testing.assert_array_equal(mesh.uv0, uv)
    np.testing.assert_array_equal(mesh.normals, np.tile([0, 0, 1], (4, 1)))
    assert mesh.tangents is None
    assert mesh.triangle_count == 2


def test_mesh_refuses_arrays_of_another_kind():
    with pytest.raises(ValueError, match=r"positions: expected C-contiguous float32 of shape \(n, 3\)"):
        burnish.Mesh(QUAD.astype(float), TRIANGLES)
    with pytest.raises(ValueError, match="got non-contiguous"):
        burnish.Mesh(np.zeros((4, 6), np.float32)[:, ::2], TRIANGLES)
    with pytest.raises(ValueError, match="indices: expected each below the vertex count 4, got 4"):
        burnish.Mesh(QUAD, TRIANGLES + np.uint32(4))
    with pytest.raises(ValueError, match="normals: expected unit length, got 2 at 0"):
        burnish.Mesh(QUAD, TRIANGLES, normals=np.tile(np.float32([0, 0, 2]), (4, 1)))
    with pytest.raises(ValueError, match="positions: expected finite numbers, got a non-finite one at 0"):
        burnish.Mesh(np.full_like(QUAD, np.inf), TRIANGLES)


def test_camera_looks_at_its_target():
    camera = burnish.Camera.look_at((1, 2, 3), (4, 2, 3))
    np.testing.assert_allclose(camera.world_from_camera @ [0, 0, -3, 1], [4, 2, 3, 1], atol=1e-6)
    assert not camera.is_orthographic
    with pytest.raises(ValueError, match="vertical_fov: expected radians between 0 and pi, got 4"):
        burnish.Camera.look_at((0, 0, 1), (0, 0, 0), vertical_fov=4)
    with pytest.raises(ValueError, match="world_from_camera: expected a rotation and a translation"):
        burnish.Camera(np.diag([2.0, 1, 1, 1]))
    assert burnish.Camera.orthographic((0, 0, 1), (0, 0, 0), half_height=2).half_height == 2


def test_scene_places_objects():
    scene = burnish.Scene()
    move = np.eye(4)
    move[:3, 3] = 1, 2, 3
    index = scene.add(burnish.Mesh(QUAD, TRIANGLES), burnish.Material(), move, "quad")
    placed = scene.objects[index]
    np.testing.assert_array_equal(placed.world_from_object, move)
    assert scene.bounds() == ((1, 2, 3), (2, 3, 3)) == placed.bounds()
    placed.world_from_object = np.eye(4)
    assert scene.find_object("quad").bounds() == ((0, 0, 0), (1, 1, 0))
    with pytest.raises(ValueError, match='name: expected a new name, got "quad" again'):
        scene.add(burnish.Mesh.sphere(), burnish.Material(), name="quad")
    with pytest.raises(ValueError, match='object: expected one of "quad", got "x"'):
        scene.find_object("x")
    with pytest.raises(ValueError, match=r"transform: expected numbers of shape \(4, 4\)"):
        scene.add(burnish.Mesh.sphere(), burnish.Material(), np.eye(3))
    with pytest.raises(ValueError, match="world_from_object: expected finite numbers"):
        placed.world_from_object = np.full((4, 4), np.nan)


def test_objects_keep_their_scene_alive():
    placed = burnish.Scene.sphere(burnish.Material()).objects[0]
    gc.collect()
    assert placed.name == "sphere"


def test_scene_and_objects_hold_environments():
    scene = burnish.Scene.sphere(burnish.Material())
    environment = burnish.Environment.from_faces(np.ones((6, 4, 4, 3), np.float32))
    assert scene.environment is None
    scene.environment = environment
    scene.objects[0].reflects = environment
    assert scene.environment is environment
    assert scene.objects[0].reflects is environment
    scene.objects[0].reflects = None
    assert scene.objects[0].reflects is None


@pytest.mark.parametrize("make", ["sphere", "plane", "shader_ball"])
def test_default_camera_sees_built_in_scenes(make):
    scene = getattr(burnish.Scene, make)(burnish.Material())
    camera = scene.default_camera()
    camera_from_world = np.linalg.inv(camera.world_from_camera.astype(float))
    slope = np.tan(camera.vertical_fov / 2)
    for mesh, placed in zip(scene.meshes, scene.objects, strict=True):
        world = mesh.positions @ placed.world_from_object[:3, :3].T + placed.world_from_object[:3, 3]
        local = world @ camera_from_world[:3, :3].T + camera_from_world[:3, 3]
        assert (local[:, 2] < -camera.near_plane).all()
        assert (np.abs(local[:, :2]) < -local[:, 2:] * slope).all()


def test_spheres_need_columns():
    assert len(burnish.Scene.spheres([burnish.Material()] * 7, 3).objects) == 7
    with pytest.raises(ValueError, match="columns: expected a number >= 1, got 0"):
        burnish.Scene.spheres([burnish.Material()], 0)
    with pytest.raises(ValueError, match="materials: expected at least one, got none"):
        burnish.Scene.spheres([], 2)
