"""What an earlier picture left on the device is not brought there again; what changed is, and shows."""

import gc

import numpy as np
import pytest

import burnish
from burnish import environments
from textured_quad import write_quad

LOBES = [burnish.KurtLobe(0.2)]
NOTHING = {"meshes": 0, "textures": 0, "maps": 0}


def triangle(x):
    positions = np.array([[-1, -1, 0], [1, -1, 0], [x, 1, 0]], np.float32)
    return burnish.Mesh(positions, np.array([[0, 1, 2]], np.uint32))


def scene_of(*meshes):
    scene = burnish.Scene()
    for k, mesh in enumerate(meshes):
        scene.add(mesh, burnish.Material(lobes=LOBES), name=f"{k}")
    scene.environment = environments.spots(1, 16)
    return scene


CAMERA = burnish.Camera.look_at((0, 0, 5), (0, 0, 0))


def draw(scene, device):
    """The picture, which is that of a fresh device, and what was uploaded for it."""
    options = {"camera": CAMERA, "size": (24, 32), "sampler": burnish.Regular(5)}
    frame = burnish.render(scene, device=device, **options)
    fresh = burnish.render(scene, device=burnish.Device(), **options)
    np.testing.assert_array_equal(frame.color, fresh.color)
    return frame.color.copy(), frame.report.uploads


def test_an_unchanged_scene_uploads_nothing():
    scene, device = scene_of(triangle(0), triangle(0.5)), burnish.Device()
    assert draw(scene, device)[1] == {"meshes": 2, "textures": 0, "maps": 1}
    assert draw(scene, device)[1] == NOTHING


def test_places_and_materials_change_without_an_upload():
    scene, device = scene_of(triangle(0), triangle(0.5)), burnish.Device()
    pictures = [draw(scene, device)[0]]
    moved = np.eye(4)
    moved[0, 3] = 0.5
    scene.objects[0].world_from_object = moved
    color, uploads = draw(scene, device)
    assert uploads == NOTHING
    pictures.append(color)
    scene.set_material(1, burnish.Material(lobes=[burnish.GgxLobe(0.4)]))
    color, uploads = draw(scene, device)
    assert uploads == NOTHING
    pictures.append(color)
    assert len({one.tobytes() for one in pictures}) == 3


def test_a_new_mesh_shows_and_textures_stay(tmp_path, rng):
    pbr = {"baseColorTexture": {"index": 0}, "metallicFactor": 0.5, "roughnessFactor": 0.5}
    scene = write_quad(tmp_path / "quad.gltf", {"pbrMetallicRoughness": pbr}, [rng.random((4, 4, 3))])
    scene.environment = environments.spots(1, 16)
    device = burnish.Device()
    before, uploads = draw(scene, device)
    assert uploads == {"meshes": 1, "textures": 1, "maps": 1}
    nearer = np.eye(4)
    nearer[2, 3] = 1
    scene.add(triangle(0), burnish.Material(lobes=LOBES), nearer)
    after, uploads = draw(scene, device)
    assert uploads == {"meshes": 2, "textures": 0, "maps": 0}
    assert not np.array_equal(before, after)


def test_a_material_that_needs_tangents_has_them_made():
    """Whether a mesh derives its tangents is the material's matter, and their vertices are others."""
    mesh = burnish.Mesh.plane()
    bare = burnish.Mesh(mesh.positions[:, [0, 2, 1]].copy(), mesh.indices[:, ::-1].copy(), uv0=mesh.uv0)
    scene, device = scene_of(bare), burnish.Device()
    draw(scene, device)
    scene.set_material(0, burnish.Material(lobes=[burnish.KurtLobe((0.1, 0.4))]))
    assert draw(scene, device)[1]["meshes"] == 1
    assert draw(scene, device)[1] == NOTHING


def test_the_same_content_made_again_is_recognised():
    device = burnish.Device()
    scene = scene_of(triangle(0))
    draw(scene, device)
    again = scene_of(triangle(0))
    again.environment = scene.environment
    assert draw(again, device)[1] == NOTHING
    assert draw(scene, device)[1] == NOTHING


def test_meshes_in_the_memory_of_others_are_new():
    """Each scene dies before the next is made, whose mesh then may lie where the last one did."""
    device = burnish.Device()
    pictures = set()
    for k in range(8):
        pictures.add(draw(scene_of(triangle(k / 8)), device)[0].tobytes())
        gc.collect()
    assert len(pictures) == 8


def test_arrays_are_taken_as_they_were():
    """An array changed in place afterwards changes no mesh, given or got."""
    device = burnish.Device()
    positions = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    mesh = burnish.Mesh(positions, np.array([[0, 1, 2]], np.uint32))
    scene = scene_of(mesh)
    before = draw(scene, device)[0]
    positions[:] = 0
    scene.meshes[0].positions[:] = 0
    after, uploads = draw(scene, device)
    assert uploads == NOTHING
    np.testing.assert_array_equal(before, after)


def test_no_mesh_is_refused():
    with pytest.raises(TypeError):
        burnish.Scene().add(None, burnish.Material(lobes=LOBES))
