"""Targets are met in truth where a material is diffuse."""

import numpy as np
import pytest

import burnish
from burnish.advice.reduced_maps import halve_faces, reduce_environment
from burnish.oracle.irradiance import cosine_sum
from burnish.oracle.reference import shade_reference
from engine_support import unit
from lit_maps import lamp

PLASTIC = burnish.KurtLobe(roughness=0.3, r0=0.04)
MATERIALS = {
    "diffuse": burnish.Material(diffuse=(0.7, 0.7, 0.7)),
    "plastic": burnish.Material(diffuse=(0.8, 0.8, 0.8), lobes=[PLASTIC]),
}


def true_error(frame, environment, material):
    """Of a picture that an orthographic camera took from +z: sums in float64 at its own normals."""
    covered = np.asarray(frame.alpha) > 0
    normals = unit(np.asarray(frame.normal, np.float64)[covered])
    views = np.broadcast_to([0.0, 0.0, 1.0], normals.shape)
    truth = np.asarray(material.diffuse) * cosine_sum(environment.faces, normals)
    tangents = np.cross(normals, [0.3, 0.5, 0.8])
    for lobe in material.lobes:
        truth = truth + shade_reference(environment.faces, normals, tangents, views, lobe)
    got = np.asarray(frame.color, np.float64)[covered]
    return np.sqrt(np.sum((got - truth) ** 2) / np.sum(truth**2))


@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("toward", [(0.3, 0.8, 0.52), (0.25, 0.3, -0.9)], ids=["above", "behind"])
def test_a_target_is_met_in_truth_beside_a_small_lamp(device, material, toward):
    environment = lamp(toward, degrees=8, radiance=1000.0, background=0.1, face_size=32)
    scene = burnish.Scene.sphere(MATERIALS[material])
    scene.environment = environment
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.2)
    frame = burnish.render(scene, camera, size=(40, 40), target_error=0.02, device=device)
    error = true_error(frame, environment, MATERIALS[material])
    assert error <= 1.3 * 0.02
    assert error <= 1.3 * frame.report.prediction["predicted_error"] + 5e-4


def test_a_target_below_the_cube_s_error_is_said_to_be_missed(device):
    """A lamp behind lights a sliver of a diffuse sphere: there the cube is off by more than on all of it."""
    environment = lamp((0.25, 0.3, -0.9), degrees=4, radiance=1000.0, background=0.0, face_size=32)
    scene = burnish.Scene.sphere(MATERIALS["diffuse"])
    scene.environment = environment
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.2)
    advice = burnish.advise(scene, 0.001, (40, 40), camera, device=device)
    by_sampler = {one.sampler: one.predicted_error for one in advice.candidates}
    frame = burnish.render(scene, camera, size=(40, 40), sampler=burnish.Matched(2), device=device)
    error = true_error(frame, environment, MATERIALS["diffuse"])
    assert error > 0.001
    assert by_sampler["matched:2"] == pytest.approx(error, rel=0.3)


def test_halved_maps_keep_light_and_where_it_is(rng):
    d = burnish.environments.cube_directions(64).astype(np.float64)
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    solid = burnish.environments.cube_solid_angles(64)[..., None]
    faces = np.zeros((6, 64, 64, 3))
    faces[4, 20, 33] = 100.0  # one texel alone, off the middle of any larger one
    halved = halve_faces(halve_faces(faces))
    coarse = burnish.environments.cube_directions(16).astype(np.float64)
    coarse /= np.linalg.norm(coarse, axis=-1, keepdims=True)
    light = halved * burnish.environments.cube_solid_angles(16)[..., None]
    assert light.sum() == pytest.approx((faces * solid).sum(), rel=1e-9)
    middle = np.einsum("fijc,fijx->x", light, coarse)
    middle /= np.linalg.norm(middle)
    angle = np.arccos(np.clip(middle @ d[4, 20, 33], -1, 1))
    assert angle <= 0.02 * (2 / 16)  # a mean would be off by a third of such a texel


def test_reduced_maps_give_the_same_diffuse_light(rng):
    environment = lamp(degrees=1.0, radiance=30000.0, face_size=256)
    normals = unit(rng.standard_normal((300, 3)))
    fine, coarse = (cosine_sum(reduce_environment(environment, size).faces, normals) for size in (64, 32))
    exact = cosine_sum(environment.faces, normals)
    extrapolated = fine + (fine - coarse) / 3
    assert np.sqrt(np.mean((extrapolated - exact) ** 2) / np.mean(exact**2)) <= 1e-3
