"""A device that is lost and shaders that do not compile: said clearly, and the engine works after it."""

import numpy as np
import pytest

import burnish
from burnish import _core, _device
from burnish.environments import spots

SIZE = (24, 32)
DEVICE_LOST, INVALID_SHADER = -4, -1000012000


@pytest.fixture(scope="module")
def scene():
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = spots(face_size=16)
    return scene


@pytest.fixture(scope="module")
def expected(device, scene):
    return burnish.render(scene, size=SIZE, device=device).color.copy()


def render(scene, device, **arguments):
    return burnish.render(scene, size=SIZE, device=device, **arguments).color


def test_a_lost_device_says_so_and_a_new_one_works(device, scene, expected):
    lost = burnish.Device(name=device.name)
    before = burnish.render(scene, size=SIZE, device=lost)
    assert not lost.is_lost
    _core.inject_fault(lost, "vkQueueSubmit2", DEVICE_LOST)
    with pytest.raises(burnish.VulkanError, match=r"the device is lost, make a new burnish\.Device"):
        render(scene, lost)
    assert lost.is_lost
    again = r"device: expected a working one, got a lost one; make a new burnish\.Device"
    calls = [
        lambda lost: render(scene, lost),
        lambda lost: scene.environment.pyramid(device=lost),
        lambda lost: scene.capture(point=(0, 2, 0), face_size=8, device=lost),
        lambda lost: before.depth,
    ]
    for call in 2 * calls:
        with pytest.raises(burnish.VulkanError, match=again):
            call(lost)
    np.testing.assert_array_equal(before.color, expected)  # what was drawn before is still there
    del lost
    np.testing.assert_array_equal(render(scene, burnish.Device(name=device.name)), expected)


def test_a_device_may_be_lost_at_any_submit(device, scene, expected):
    outcomes = []
    while not outcomes or not outcomes[-1]:
        fresh = burnish.Device(name=device.name)
        _core.inject_fault(fresh, "vkQueueSubmit2", DEVICE_LOST, skip=len(outcomes))
        try:
            np.testing.assert_array_equal(render(scene, fresh, spp=1), expected)
        except burnish.VulkanError as error:
            assert "make a new burnish.Device" in str(error)
        outcomes.append(not fresh.is_lost)
    assert len(outcomes) > 2


def test_a_lost_default_device_is_replaced(device, scene, expected, monkeypatch):
    lost = burnish.Device(name=device.name)
    monkeypatch.setattr(_device, "_device", lost)
    _core.inject_fault(lost, "vkQueueSubmit2", DEVICE_LOST)
    with pytest.raises(burnish.VulkanError, match="the device is lost"):
        burnish.render(scene, size=SIZE)
    np.testing.assert_array_equal(burnish.render(scene, size=SIZE).color, expected)
    assert _device.default_device() is not lost


@pytest.mark.slow
@pytest.mark.parametrize("call", ["vkCreateComputePipelines", "vkCreateGraphicsPipelines"])
def test_a_shader_that_does_not_compile_is_named(device, scene, expected, call):
    """Every pipeline of a frame in turn."""
    named = set()
    for skip in range(100):
        fresh = burnish.Device(name=device.name)
        _core.inject_fault(fresh, call, INVALID_SHADER, skip)
        try:
            render(scene, fresh)
            break
        except burnish.VulkanError as error:
            what, rest = str(error).split(": ", 1)
            returned = f"returned VK_ERROR_INVALID_SHADER_NV ({INVALID_SHADER})"
            assert rest == f"expected the driver to compile it, {call} {returned}"
            named.add(what)
        np.testing.assert_array_equal(render(scene, fresh), expected)
    if call == "vkCreateGraphicsPipelines":
        assert named == {"surface/surface.vert + surface/surface.frag"}
    else:
        assert {
            "shade/classify_tiles.comp",
            "shade/background.comp",
            "shade/shade_matched_by_view.comp",
        } <= named
