"""A mirrored world makes a mirrored picture: normals, tangents and rotations turn with the objects."""

import numpy as np
import pytest

import burnish
from engine_support import smooth_environment_faces
from image_compare import assert_pictures_match

# Faces of the map seen in a mirror across the plane x = 0.
MIRRORED_FACES = [1, 0, 2, 3, 4, 5]
MIRROR = np.diag([-1.0, 1.0, 1.0, 1.0])


def mirrored_map(faces):
    """+X and -X change places, and each face its left and right."""
    return np.ascontiguousarray(faces[MIRRORED_FACES][:, :, ::-1])


def brushed_scene(environment, matrix, is_double_sided):
    scene = burnish.Scene()
    lobe = burnish.KurtLobe(roughness=(0.5, 0.1), rotation=0.6, alpha=0.5, r0=(0.9, 0.5, 0.2))
    material = burnish.Material(diffuse=0.1, lobes=[lobe], double_sided=is_double_sided)
    torus = np.eye(4)
    torus[:3, :3] = [[0.8, 0, 0.6], [0, 1, 0], [-0.6, 0, 0.8]]
    scene.add(burnish.Mesh.torus(), material, matrix @ torus)
    scene.environment = environment
    return scene


@pytest.mark.parametrize("is_double_sided", [False, True])
@pytest.mark.parametrize(
    "sampler", [burnish.Importance(), burnish.Regular(normalization="published")], ids=str
)
def test_mirrored_scene_makes_a_mirrored_picture(device, sampler, is_double_sided):
    faces = smooth_environment_faces(32)
    eye = (0.9, 1.5, 3.5)
    size = (60, 64)
    plain = brushed_scene(burnish.Environment.from_faces(faces), np.eye(4), is_double_sided)
    there = burnish.render(plain, burnish.Camera.look_at(eye, (0, 0, 0)), size, sampler, device=device)
    reflected = brushed_scene(burnish.Environment.from_faces(mirrored_map(faces)), MIRROR, is_double_sided)
    camera = burnish.Camera.look_at((-eye[0], *eye[1:]), (0, 0, 0))
    here = burnish.render(reflected, camera, size, sampler, device=device)
    same = (there.alpha > 0) == (here.alpha[:, ::-1] > 0)
    assert np.mean(~same) <= 0.002
    assert_pictures_match(here.color[:, ::-1], there.color, "mirrored scene", 2e-3, where=same)
