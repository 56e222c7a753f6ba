"""Several processes and several threads on one device, and forks: each gets what it would get alone."""

import hashlib
import threading

import numpy as np
import pytest

import burnish
from burnish import builtin
from burnish.environments import spots
from process_support import finish, start

SIZE = (24, 32)

FRAMES = """
    import hashlib, sys
    import burnish
    from burnish.environments import spots

    device = burnish.Device(name=sys.argv[1])
    digest = hashlib.sha256()
    for seed in range(3):
        scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.1 + 0.05 * seed)]))
        scene.environment = spots(seed=seed, face_size=32)
        for sampler in (burnish.Regular(), burnish.Matched(), burnish.Reference(0.2)):
            frame = burnish.render(scene, size=(24, 32), sampler=sampler, device=device)
            digest.update(frame.color.tobytes())
    print(digest.hexdigest())
"""


def test_processes_at_the_same_time_draw_what_one_draws(device):
    alone = finish(start(FRAMES, device.name))
    together = [start(FRAMES, device.name) for _ in range(3)]
    assert [finish(process) for process in together] == [alone] * 3


FORKED = """
    import os, signal, sys
    import burnish
    from burnish import builtin

    scene = builtin.make_scene("sphere")
    scene.environment = builtin.make_environment("studio", 16)
    device = burnish.Device(name=sys.argv[1])
    default = burnish.render(scene, size=(24, 32)).color.tobytes()
    burnish.render(scene, size=(24, 32), device=device)
    child = os.fork()
    if child == 0:
        signal.alarm(100)  # a hang ends as a failure
        try:
            burnish.render(scene, size=(24, 32), device=device)
            sys.exit("the device of the parent was used")
        except burnish.VulkanError as error:
            assert "expected one that this process opened, got one from before a fork" in str(error), error
        del device
        assert burnish.render(scene, size=(24, 32)).color.tobytes() == default
        os._exit(0)  # as multiprocessing ends a fork: Mesa's exit handler waits for the parent's threads
    assert os.waitpid(child, 0)[1] == 0, "the fork failed"
    assert burnish.render(scene, size=(24, 32)).color.tobytes() == default
    burnish.render(scene, size=(24, 32), device=device)
    print("done")
"""


def test_a_fork_is_told_to_open_its_own_device_and_the_default_one_is_new(device):
    assert finish(start(FORKED, device.name)) == "done"


FORKED_AMID_WORK = """
    import os, signal, sys, threading
    import burnish
    from burnish import builtin

    scene = builtin.make_scene("sphere")
    scene.environment = builtin.make_environment("studio", 16)
    device = burnish.Device(name=sys.argv[1])
    has_begun = threading.Event()
    is_done = []

    def work(share, step):
        has_begun.set()
        assert not is_done

    def draw():
        try:
            burnish.render(scene, size=(100, 100), spp=65536, device=device, progress=work)
        except AssertionError:
            pass

    thread = threading.Thread(target=draw)
    thread.start()
    has_begun.wait()
    child = os.fork()
    if child == 0:
        signal.alarm(100)
        try:
            burnish.render(scene, size=(24, 32), device=device)
        except burnish.VulkanError as error:
            os._exit(0 if "from before a fork" in str(error) else 1)
        os._exit(2)
    status = os.waitpid(child, 0)[1]
    is_done.append(True)
    thread.join()
    assert status == 0, status
    print("done")
"""


def test_a_fork_amid_the_work_of_another_thread_does_not_hang(device):
    """The lock that the other thread holds is never let go in the fork."""
    assert finish(start(FORKED_AMID_WORK, device.name)) == "done"


def jobs(environment):
    """Calls of every kind, each with what tells its results apart."""
    scene = builtin.make_scene("sphere")
    scene.environment = environment
    random = np.random.default_rng(3)
    normals = random.standard_normal((50, 3)).astype(np.float32)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points = (normals, np.roll(normals, 1, axis=1).copy(), normals)
    lobe = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.3)])
    return {
        "render": lambda device: burnish.render(scene, size=SIZE, spp=2, device=device).color,
        "reference": lambda device: (
            burnish.render(scene, size=SIZE, sampler=burnish.Reference(0.2), device=device).color
        ),
        "shade": lambda device: burnish.shade(environment, lobe, burnish.Matched(), *points, device=device),
        "pyramid": lambda device: environment.pyramid(device=device)[2],
        "capture": lambda device: scene.capture(point=(0, 2, 0), face_size=8, device=device).faces,
        "too large": lambda device: burnish.render(scene, size=(3000, 3000), device=device).color,
        "wrong": lambda device: burnish.render(scene, size=SIZE, spp=0, device=device).color,
    }


def outcome(job, device):
    try:
        return hashlib.sha256(np.ascontiguousarray(job(device))).hexdigest()
    except (ValueError, burnish.VulkanError) as error:
        return type(error).__name__


def test_threads_on_one_device_get_what_each_gets_alone_whatever_befalls_the_others(device):
    """Some of the calls fail, and make the device give back what the others' next calls would use again."""
    shared = burnish.Device(name=device.name, memory_limit_bytes=64 << 20)
    work = jobs(spots(face_size=32))
    alone = {name: outcome(job, shared) for name, job in work.items()}
    assert (alone["too large"], alone["wrong"]) == ("VulkanError", "ValueError")
    assert len(set(alone.values())) == len(alone)
    got = {name: [] for name in work}

    def repeat(name, job):
        for _ in range(5):
            got[name].append(outcome(job, shared))

    threads = [threading.Thread(target=repeat, args=item) for item in work.items()]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=200)
        assert not thread.is_alive(), "a thread hangs"
    assert got == {name: [wanted] * 5 for name, wanted in alone.items()}


def test_threads_that_ask_at_once_get_one_default_device(monkeypatch):
    monkeypatch.setattr(burnish._device, "_device", None)
    gate = threading.Barrier(4)
    got = []

    def ask():
        gate.wait()
        got.append(burnish._device.default_device())

    threads = [threading.Thread(target=ask) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=100)
    assert len(got) == 4 and all(one is got[0] for one in got)


@pytest.mark.parametrize("limit", [None, 64 << 20])
def test_a_thread_that_loses_the_device_loses_it_for_all(device, limit):
    lost = burnish.Device(name=device.name, memory_limit_bytes=limit)
    work = jobs(spots(face_size=32))
    burnish._core.inject_fault(lost, "vkQueueSubmit2", -4, skip=20)
    got = []

    def repeat(job):
        for _ in range(20):
            got.append(outcome(job, lost))

    threads = [threading.Thread(target=repeat, args=(work[name],)) for name in ("render", "shade", "pyramid")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=200)
        assert not thread.is_alive(), "a thread hangs"
    assert lost.is_lost and len(got) == 60 and got[-1] == "VulkanError"
