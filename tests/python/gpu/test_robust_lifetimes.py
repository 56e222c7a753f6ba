"""Objects of the library may be dropped in any order, and used by several threads."""

import gc
import itertools
import threading

import numpy as np
import pytest

import burnish
from burnish.environments import spots

SIZE = (24, 32)


def make_scene(environment, roughness=0.2):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=roughness)]))
    scene.environment = environment
    return scene


@pytest.mark.parametrize(
    "order", itertools.permutations(["device", "environment", "scene", "frame"]), ids="-".join
)
def test_objects_may_be_dropped_in_any_order(device, order):
    held = {"device": burnish.Device(name=device.name), "environment": spots(face_size=16)}
    held["scene"] = make_scene(held["environment"])
    held["frame"] = burnish.render(held["scene"], size=SIZE, device=held["device"])
    levels = held["environment"].pyramid(device=held["device"])
    faces = held["environment"].faces
    meshes = held["scene"].meshes
    for name in order:
        del held[name]
        gc.collect()
    assert np.isfinite(faces).all() and np.isfinite(levels[-1]).all() and meshes[0].triangle_count > 0


def test_parts_outlive_the_scene_they_came_from(device, spots64):
    scene = make_scene(spots64)
    one, camera, material = scene.objects[0], scene.default_camera(), scene.materials[0]
    del scene
    gc.collect()
    assert one.name == "sphere" and camera.vertical_fov > 0 and len(material.lobes) == 1
    one.world_from_object = np.diag([2.0, 2.0, 2.0, 1.0])
    assert one.bounds()[1][0] == pytest.approx(2.0, rel=1e-3)


def test_frames_keep_their_pixels_while_others_are_drawn(device, spots64):
    """On a CPU device a frame is the memory it was drawn into; depth and normals are read when asked for."""
    scenes = [make_scene(spots64, roughness) for roughness in (0.1, 0.4)]
    scenes[1].objects[0].world_from_object = np.diag([0.5, 0.5, 0.5, 1.0])
    camera = scenes[0].default_camera()

    def draw(scene):
        return burnish.render(scene, camera=camera, size=SIZE, device=device)

    kept, color = draw(scenes[0]), draw(scenes[0]).color.copy()
    others = [draw(scene) for scene in 3 * scenes]
    np.testing.assert_array_equal(kept.color, color)
    np.testing.assert_array_equal(kept.depth, others[2].depth)
    assert np.isinf(kept.depth).sum() < np.isinf(others[1].depth).sum()
    view = kept.color
    del kept, others
    gc.collect()
    draw(scenes[1])
    np.testing.assert_array_equal(view, color)


def test_frames_survive_a_changed_and_a_deleted_environment(device):
    scene = make_scene(spots(seed=1, face_size=32))
    first = burnish.render(scene, size=SIZE, device=device)
    scene.environment = spots(seed=2, face_size=32)
    gc.collect()
    second = burnish.render(scene, size=SIZE, device=device)
    assert np.abs(first.color - second.color).max() > 0.1
    scene.environment = spots(seed=1, face_size=32)
    gc.collect()
    np.testing.assert_array_equal(burnish.render(scene, size=SIZE, device=device).color, first.color)


def test_changes_of_an_environment_in_place_are_seen(device):
    scene = make_scene(spots(face_size=32))
    plain = burnish.render(scene, size=SIZE, device=device).color
    scene.environment.exposure = 1.0
    np.testing.assert_allclose(burnish.render(scene, size=SIZE, device=device).color, 2 * plain, rtol=1e-5)
    scene.environment.exposure = 0.0
    scene.environment.rotation = np.diag([-1.0, 1.0, -1.0])
    turned = burnish.render(scene, size=SIZE, device=device).color
    assert np.abs(turned - plain).max() > 0.1
    scene.environment.rotation = None
    np.testing.assert_array_equal(burnish.render(scene, size=SIZE, device=device).color, plain)


def test_changes_of_a_scene_in_place_are_seen(device, spots64):
    scene = make_scene(spots64)
    before = burnish.render(scene, size=SIZE, device=device)
    scene.set_material(0, burnish.Material(diffuse=0.5))
    painted = burnish.render(scene, size=SIZE, device=device)
    assert np.abs(painted.color - before.color).max() > 0.01
    scene.objects[0].world_from_object = np.diag([0.5, 0.5, 0.5, 1.0])
    smaller = burnish.render(scene, burnish.Camera.look_at((0, 0, 4), (0, 0, 0)), SIZE, device=device)
    assert 0 < smaller.alpha.sum() < before.alpha.sum()


def render_repeatedly(device, roughness, results, count=6):
    """In a thread: frames of one scene, each compared by the caller."""
    try:
        environment = spots(face_size=32)
        scene = make_scene(environment, roughness)
        for _ in range(count):
            results.append(burnish.render(scene, size=SIZE, device=device).color)
            results.append(environment.pyramid(device=device)[1])
    except Exception as error:
        results.append(error)


@pytest.mark.parametrize("share", [True, False], ids=["one device", "two devices"])
def test_two_threads_render_what_one_does(device, share):
    devices = [burnish.Device(name=device.name) for _ in range(1 if share else 2)]
    expected = []
    for roughness in (0.1, 0.3):
        results = []
        render_repeatedly(device, roughness, results, count=1)
        expected.append(results)
    got = [[], []]
    threads = [
        threading.Thread(target=render_repeatedly, args=(devices[k % len(devices)], (0.1, 0.3)[k], got[k]))
        for k in range(2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=120)
        assert not thread.is_alive(), "a thread hangs"
    for one, wanted in zip(got, expected, strict=True):
        assert len(one) == 12
        for k, result in enumerate(one):
            assert not isinstance(result, Exception), result
            np.testing.assert_array_equal(result, wanted[k % 2])


def test_rendering_lets_other_threads_run(device, spots64):
    """The interpreter is free while the device works."""
    scene = make_scene(spots64, 0.4)
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.002):
            ticks.append(1)

    other = threading.Thread(target=tick)
    other.start()
    burnish.render(scene, size=(200, 200), spp=20, device=device)
    done.set()
    other.join()
    assert len(ticks) > 5
