"""The same scene anywhere and of any size, seen by a camera that goes with it, makes the same picture."""

import numpy as np
import pytest

import burnish
from engine_support import smooth_environment_faces
from gltf_support import GltfFile
from image_compare import assert_pictures_match

SIZE = (60, 64)
EYE = np.array([0.9, 1.5, 3.5])
TURN = np.array([[0.8, 0, 0.6, 0], [0, 1, 0, 0], [-0.6, 0, 0.8, 0], [0, 0, 0, 1]])
PLACES = [(1e3, 0, 0), (-1e6, 3e5, 1e6), (1e9, -1e9, 1e9)]
SCALES = [1e-6, 1e-3, 1e3, 1e6]


@pytest.fixture(scope="module")
def environment():
    return burnish.Environment.from_faces(smooth_environment_faces(32))


def matrix_of(scale, place):
    matrix = np.diag([scale, scale, scale, 1.0])
    matrix[:3, 3] = place
    return matrix


def torus(environment, matrix):
    scene = burnish.Scene()
    lobe = burnish.KurtLobe(roughness=(0.5, 0.1), rotation=0.6, alpha=0.5, r0=(0.9, 0.5, 0.2))
    material = burnish.Material(diffuse=0.1, lobes=[lobe])
    scene.add(burnish.Mesh.torus(), material, matrix @ TURN)
    scene.add(burnish.Mesh.sphere(), material, matrix @ matrix_of(0.3, (0.2, 0.1, 0.9)))
    scene.environment = environment
    return scene


def camera_at(matrix, orthographic=False):
    scale, place = matrix[0, 0], matrix[:3, 3]
    eye, target = place + scale * EYE, place + scale * np.array([0.1, 0.0, 0.0])
    if orthographic:
        return burnish.Camera.orthographic(eye, target, half_height=1.4 * scale, far_plane=100 * scale)
    return burnish.Camera.look_at(eye, target, near_plane=0.01 * scale)


def render(device, scene, camera):
    return burnish.render(scene, camera, SIZE, burnish.Importance(), device=device)


def assert_same_picture(here, there, name, scale=1.0, edge_share=0.002):
    same = (here.alpha > 0) == (there.alpha > 0)
    assert (there.alpha > 0).mean() > 0.1
    assert np.mean(~same) <= edge_share
    assert_pictures_match(here.color, there.color, name, 2e-3, where=same)
    both = (here.alpha > 0) & (there.alpha > 0)
    np.testing.assert_allclose(here.depth[both] / scale, there.depth[both], rtol=2e-3)


@pytest.mark.parametrize("orthographic", [False, True], ids=["pinhole", "orthographic"])
@pytest.mark.parametrize("place", PLACES, ids=str)
def test_moved_scene_makes_the_same_picture(device, environment, place, orthographic):
    there = render(device, torus(environment, np.eye(4)), camera_at(np.eye(4), orthographic))
    matrix = matrix_of(1.0, place)
    here = render(device, torus(environment, matrix), camera_at(matrix, orthographic))
    assert_same_picture(here, there, "moved scene")


@pytest.mark.parametrize("orthographic", [False, True], ids=["pinhole", "orthographic"])
@pytest.mark.parametrize("scale", SCALES)
def test_scaled_scene_makes_the_same_picture(device, environment, scale, orthographic):
    there = render(device, torus(environment, np.eye(4)), camera_at(np.eye(4), orthographic))
    matrix = matrix_of(scale, (0, 0, 0))
    here = render(device, torus(environment, matrix), camera_at(matrix, orthographic))
    assert_same_picture(here, there, "scaled scene", scale)


@pytest.mark.parametrize(("scale", "place"), [(1.0, (1e6, 0, 1e6)), (1e-3, (1e3, 0, 0)), (1e3, (0, 1e9, 0))])
def test_default_camera_goes_with_its_scene(device, environment, scale, place):
    there = torus(environment, np.eye(4))
    here = torus(environment, matrix_of(scale, place))
    pictures = [render(device, scene, scene.default_camera()) for scene in (here, there)]
    assert_same_picture(*pictures, "default camera", scale)


def gltf_of(path, root):
    """A sphere over a square beneath one node, with a camera that is its child too."""
    file = GltfFile()
    sphere = burnish.Mesh.sphere()
    ball = file.mesh(
        {"POSITION": sphere.positions, "NORMAL": sphere.normals}, np.uint32(sphere.indices).reshape(-1)
    )
    file.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.01}})
    file.document["nodes"] = [
        {"children": [1, 2, 3], **root},
        {"mesh": ball, "translation": [0.3, 0, 0], "scale": [0.8, 0.8, 0.8]},
        {"mesh": file.square({"doubleSided": True}), "rotation": [0.5, 0.5, 0.5, 0.5]},
        {"camera": 0, "translation": [0, 0.5, 4]},
    ]
    file.document["scenes"] = [{"nodes": [0]}]
    return burnish.Scene.from_file(file.write(path))


@pytest.mark.parametrize("place", PLACES, ids=str)
def test_gltf_nodes_are_placed_in_double_precision(device, environment, place, tmp_path):
    pictures = []
    for name, root in (("here", {"translation": place}), ("there", {})):
        scene = gltf_of(tmp_path / f"{name}.gltf", root)
        scene.environment = environment
        assert scene.warnings == []
        pictures.append(render(device, scene, scene.cameras[0]))
    assert_same_picture(*pictures, "moved nodes")


def test_vertices_far_from_their_mesh_keep_the_digits_they_have(device, environment):
    """Moved by 4096 the sphere's corners are rounded to 2^-11; turning and moving them back adds no more."""
    place = np.array([4096.0, -4096.0, 4096.0])
    sphere = burnish.Mesh.sphere()
    rounded = np.float32(sphere.positions + place)
    scenes = []
    for positions, matrix in ((rounded, TURN @ matrix_of(1.0, -place)), (np.float32(rounded - place), TURN)):
        scene = burnish.Scene()
        mesh = burnish.Mesh(positions, sphere.indices, sphere.normals)
        scene.add(mesh, burnish.Material(diffuse=0.5, lobes=[burnish.KurtLobe(0.3)]), matrix)
        scene.environment = environment
        scenes.append(scene)
    here, there = (render(device, scene, camera_at(np.eye(4))) for scene in scenes)
    assert_same_picture(here, there, "far vertices")
    np.testing.assert_allclose(here.depth[here.alpha > 0], there.depth[here.alpha > 0], rtol=1e-6)


def test_surroundings_are_captured_far_away(device, environment):
    faces = []
    for place in ((0, 0, 0), (1e6, 0, -1e6)):
        scene = torus(environment, matrix_of(1.0, place))
        faces.append(scene.capture(point=np.add(place, (0, 0.5, 2)), face_size=16, device=device).faces)
    np.testing.assert_allclose(faces[1], faces[0], rtol=5e-3, atol=1e-3)


def test_matrices_are_given_back_as_they_were(environment):
    matrix = matrix_of(1.0, (1e6 + 1 / 3, 1e-9, -7e7 - 1 / 7))
    scene = torus(environment, matrix)
    scene.objects[0].world_from_object = matrix
    np.testing.assert_array_equal(scene.objects[0].world_from_object, matrix)
    camera = burnish.Camera(matrix)
    np.testing.assert_array_equal(camera.world_from_camera, matrix)
    low, high = scene.objects[0].bounds()
    np.testing.assert_allclose(np.add(low, high) / 2, matrix[:3, 3], rtol=0, atol=1e-6)


@pytest.mark.parametrize("orthographic", [False, True], ids=["pinhole", "orthographic"])
def test_a_camera_that_sees_no_object_says_so(device, environment, orthographic):
    scene = torus(environment, np.eye(4))
    make = burnish.Camera.orthographic if orthographic else burnish.Camera.look_at
    sentence = "nothing is drawn: no object lies in the camera's view"
    views = [
        ((0, 0, 5), (0, 0, 9)),
        ((20, 0, 3), (20, 0, 0)),
        ((0, 20, 3), (0, 20, 0)),
        ((0, 0, 5), (0, 0, 0)),
    ]
    for number, (eye, target) in enumerate(views):
        frame = render(device, scene, make(eye, target))
        sees = number == 3
        assert (frame.alpha.max() > 0) == sees
        assert (sentence in frame.report.warnings) == (not sees)
