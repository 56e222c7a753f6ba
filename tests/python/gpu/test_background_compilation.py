"""Pictures that do not wait for their pipeline: the same as those that do, and every mishap is told."""

import json
import threading

import numpy as np
import pytest

import burnish
from burnish import _core
from burnish.environments import spots
from engine_support import random_points
from process_support import finish, start

SIZE = (24, 32)
DEVICE_LOST, INVALID_SHADER = -4, -1000012000
# Constants and a buffer hold the same table; compilers fold and order its sums otherwise.
SAME = 2e-5
COMPILING = "the pipeline that has them as constants is being compiled, samples from a buffer"


def material(*roughnesses, **fields):
    return burnish.Material(lobes=[burnish.KurtLobe(roughness=m, **fields) for m in roughnesses])


def scene_of(*materials):
    scene = burnish.Scene.spheres(list(materials), columns=max(len(materials), 1))
    scene.environment = spots(face_size=32)
    return scene


def draw(device, *materials, sampler=None, **arguments):
    sampler = sampler or burnish.Regular()
    return burnish.render(scene_of(*materials), size=SIZE, sampler=sampler, device=device, **arguments)


def tables(frame):
    return [one["table"] for one in frame.report.classes]


def reasons(frame):
    return [one["reason"] for one in frame.report.classes]


def has_waited(frame):
    """Whether a pipeline was compiled while this picture waited."""
    return json.loads(frame.report.to_json())["compile_ms"] > 0


def assert_same(got, wanted):
    np.testing.assert_allclose(got, wanted, rtol=SAME, atol=SAME * np.abs(wanted).mean())


@pytest.fixture
def background(device):
    return burnish.Device(name=device.name, compile="background")


def test_a_device_waits_unless_told_otherwise(device, background):
    assert (device.compile, background.compile) == ("wait", "background")
    frame = draw(device, material(0.1234))
    assert tables(frame) == ["constant"]
    device.finish_compiling()
    with pytest.raises(ValueError, match="compile: expected wait, background or shared, got 'later'"):
        burnish.Device(name=device.name, compile="later")


@pytest.mark.parametrize(
    "sampler",
    [
        burnish.Regular(samples=20),
        burnish.Regular(samples=30, footprint="published", normalization="published"),
        burnish.Importance(samples=14),
    ],
    ids=str,
)
def test_the_first_picture_reads_a_buffer_and_later_ones_constants(device, background, sampler):
    materials = [material(0.2), material((0.3, 0.1), r0=0.04, alpha=0.5)]
    wanted = draw(device, *materials, sampler=sampler)
    assert tables(wanted) == ["constant", "constant"]
    first = draw(background, *materials, sampler=sampler)
    assert tables(first) == ["buffer", "buffer"]
    assert all(reason.endswith(COMPILING) for reason in reasons(first))
    assert_same(first.color, wanted.color)
    background.finish_compiling()
    later = draw(background, *materials, sampler=sampler)
    assert tables(later) == ["constant", "constant"]
    assert reasons(later) == reasons(wanted)
    assert has_waited(first) and not has_waited(later)
    np.testing.assert_array_equal(later.color, wanted.color)


def test_roughnesses_share_the_pipeline_that_reads_a_buffer(background):
    draw(background, material(0.2))
    second = draw(background, material(0.21))
    assert tables(second) == ["buffer"]
    assert not has_waited(second)
    brushed = [draw(background, material((float(m), 0.1))) for m in np.linspace(0.15, 0.6, 20)]
    assert {"14", "15", "16"} <= {frame.report.samples_used for frame in brushed}
    assert sum(map(has_waited, brushed)) <= 2


def test_display_output_has_a_pipeline_of_its_own(device, background):
    draw(background, material(0.2))
    background.finish_compiling()
    asked = {"output": "display", "display_exposure": 0.0}
    first = draw(background, material(0.2), **asked)
    assert tables(first) == ["buffer"]
    background.finish_compiling()
    later = draw(background, material(0.2), **asked)
    assert tables(later) == ["constant"] and not has_waited(later)
    wanted = draw(device, material(0.2), **asked).display.astype(int)
    assert np.abs(first.display - wanted).max() <= 1
    np.testing.assert_array_equal(later.display, wanted)


def test_only_what_would_be_constants_is_said_to_be_compiled(background):
    frame = draw(background, material(0.2), material(0.2, 0.4))
    assert tables(frame) == ["buffer", "buffer"]
    assert [reason.endswith(COMPILING) for reason in reasons(frame)] == [True, False]
    assert "several lobes" in reasons(frame)[1]
    background.finish_compiling()
    assert tables(draw(background, material(0.2), material(0.2, 0.4))) == ["constant", "buffer"]
    for sampler in (burnish.Regular(samples=200), burnish.Matched(), burnish.Reference(0.2)):
        assert COMPILING not in str(reasons(draw(background, material(0.2), sampler=sampler)))


def test_shared_pipelines_are_never_compiled_for_one_roughness(device, background):
    shared = burnish.Device(name=device.name, compile="shared")
    assert shared.compile == "shared"
    for roughness in (0.15, 0.25):
        frame = draw(shared, material(roughness))
        assert tables(frame) == ["buffer"] and "roughnesses share" in reasons(frame)[0]
        assert has_waited(frame) == (roughness == 0.15)
        np.testing.assert_array_equal(frame.color, draw(background, material(roughness)).color)
        shared.finish_compiling()
        assert tables(draw(shared, material(roughness))) == ["buffer"]


def test_points_do_the_same(device, background, rng):
    environment, points = spots(face_size=32), random_points(rng, 1000)

    def shade(device):
        return burnish.shade(environment, material(0.2), burnish.Regular(), *points, device=device)

    wanted, first = shade(device), shade(background)
    assert_same(first, wanted)
    assert not np.array_equal(first, wanted), "the first call must not have waited"
    background.finish_compiling()
    np.testing.assert_array_equal(shade(background), wanted)


def test_of_many_values_the_last_one_is_ready_and_few_others(background):
    values = np.linspace(0.1, 0.6, 40)
    assert all(tables(draw(background, material(float(m)))) == ["buffer"] for m in values)
    background.finish_compiling()
    assert tables(draw(background, material(float(values[-1])))) == ["constant"]


def test_what_does_not_compile_is_the_next_pictures_error_once(device, background):
    draw(background, material(0.2))
    background.finish_compiling()
    _core.inject_fault(background, "vkCreateComputePipelines", INVALID_SHADER)
    assert tables(draw(background, material(0.3))) == ["buffer"]
    background.finish_compiling()
    returned = rf"vkCreateComputePipelines returned VK_ERROR_INVALID_SHADER_NV \({INVALID_SHADER}\)"
    with pytest.raises(
        burnish.VulkanError, match=f"shade/shade_constant.comp: expected the driver to compile it, {returned}"
    ):
        draw(background, material(0.2), sampler=burnish.Matched())
    assert tables(draw(background, material(0.3))) == ["buffer"]
    background.finish_compiling()
    frame = draw(background, material(0.3))
    assert tables(frame) == ["constant"]
    np.testing.assert_array_equal(frame.color, draw(device, material(0.3)).color)


def test_a_device_lost_meanwhile_says_so(background):
    draw(background, material(0.2))
    _core.inject_fault(background, "vkQueueSubmit2", DEVICE_LOST)
    with pytest.raises(burnish.VulkanError, match="the device is lost"):
        draw(background, material(0.3))
    for call in (lambda: draw(background, material(0.3)), background.finish_compiling):
        with pytest.raises(burnish.VulkanError, match="expected a working one, got a lost one"):
            call()


def test_threads_draw_on_one_device_while_it_compiles(device, background):
    values = [0.1 + 0.05 * k for k in range(8)]
    wanted = {m: draw(device, material(m)).color for m in values}
    got = {m: [] for m in values}

    def repeat(m):
        for _ in range(10):
            got[m].append(draw(background, material(m)).color)

    threads = [threading.Thread(target=repeat, args=(m,)) for m in values]
    for thread in threads:
        thread.start()
    background.finish_compiling()
    for thread in threads:
        thread.join(timeout=200)
        assert not thread.is_alive(), "a thread hangs"
    for m in values:
        assert len(got[m]) == 10
        for color in got[m]:
            assert_same(color, wanted[m])


SETUP = """
    import os, signal, sys
    import burnish
    from burnish.environments import spots

    def draw(device, roughness):
        scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=roughness)]))
        scene.environment = spots(face_size=32)
        frame = burnish.render(scene, size=(24, 32), sampler=burnish.Regular(), device=device)
        return frame.report.classes[0]["table"]

    device = burnish.Device(name=sys.argv[1], compile="background")
    for k in range(20):
        assert draw(device, 0.2 + 0.01 * k) == "buffer"
"""

CLOSED = """
    device = None
    print("done")
"""

# The thread that compiles, and the locks that it holds, are not in the fork.
FORKED = """
    child = os.fork()
    if child == 0:
        signal.alarm(100)  # a hang ends as a failure
        for call in (lambda: draw(device, 0.3), device.finish_compiling):
            try:
                call()
                os._exit(1)
            except burnish.VulkanError as error:
                if "from before a fork" not in str(error):
                    os._exit(2)
        del call
        device = None
        own = burnish.Device(name=sys.argv[1], compile="background")
        assert draw(own, 0.3) == "buffer"
        own.finish_compiling()
        os._exit(0 if draw(own, 0.3) == "constant" else 3)
    status = os.waitpid(child, 0)[1]
    assert status == 0, status
    device.finish_compiling()
    assert draw(device, 0.2 + 0.01 * 19) == "constant"
    print("done")
"""


REST = """
    device.finish_compiling()
"""


@pytest.mark.parametrize("end", [CLOSED, FORKED, REST + FORKED], ids=["closed", "forked", "forked at rest"])
def test_a_device_may_be_closed_or_forked_while_its_thread_lives(device, end):
    assert finish(start(SETUP + end, device.name)) == "done"
