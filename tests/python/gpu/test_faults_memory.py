"""Memory that does not suffice: one error that says for what and how much, and then the device works on."""

import numpy as np
import pytest

import burnish
from burnish.environments import spots, uniform

MIB = 1 << 20
SIZE = (24, 32)
OUT_OF_DEVICE_MEMORY = -2


def make_scene(environment=None):
    scene = burnish.Scene.sphere(burnish.Material(diffuse=0.2, lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = environment or spots(face_size=16)
    return scene


def limited(device, mebibytes):
    return burnish.Device(name=device.name, memory_limit_bytes=int(mebibytes * MIB))


@pytest.fixture(scope="module")
def expected(device):
    return burnish.render(make_scene(), size=SIZE, device=device).color.copy()


def assert_works(small, expected):
    frame = burnish.render(make_scene(), size=SIZE, device=small)
    np.testing.assert_array_equal(frame.color, expected)
    np.testing.assert_array_equal(frame.depth > 0, True)


def refusal(what, amount, limit):
    """The message, but for what was taken already."""
    return (
        rf"^{what}: expected {amount} MiB more memory on .*, got VK_ERROR_OUT_OF_DEVICE_MEMORY "
        rf"with [\d.]+ MiB of the allowed {limit}\.0+ MiB taken$"
    )


def test_a_frame_too_large_says_how_much_it_lacked(device, expected):
    small = limited(device, 48)
    for _ in range(2):
        with pytest.raises(
            burnish.VulkanError, match=refusal("a frame of 2000 x 2000 pixels", r"[\d.]+", 48)
        ):
            burnish.render(make_scene(), size=(2000, 2000), device=small)
        assert_works(small, expected)


def test_a_map_too_large_says_so(device, expected):
    small = limited(device, 24)
    environment = uniform(1.0, face_size=1024)
    what = "1 map with faces of 1024 x 1024 texels"
    with pytest.raises(burnish.VulkanError, match=refusal(f"a frame of 24 x 32 pixels: {what}", "64.0", 24)):
        burnish.render(make_scene(environment), size=SIZE, device=small)
    with pytest.raises(burnish.VulkanError, match=refusal(what, "64.0", 24)):
        environment.pyramid(device=small)
    assert_works(small, expected)


def test_points_too_many_say_so(device, expected, spots64):
    small = limited(device, 24)
    up = np.tile(np.float32([0, 0, 1]), (1_000_000, 1))
    along = np.tile(np.float32([1, 0, 0]), (1_000_000, 1))
    arguments = (spots64, make_scene().materials[0], burnish.Regular(5), up, along, up)
    with pytest.raises(burnish.VulkanError, match=refusal("1000000 points to shade", r"[\d.]+", 24)):
        burnish.shade(*arguments, device=small)
    assert_works(small, expected)


def test_a_mesh_too_large_says_so(device, expected):
    small = limited(device, 8)
    grid = np.float32(np.stack(np.meshgrid(np.arange(500), np.arange(500)), -1).reshape(-1, 2))
    positions = np.hstack([grid, np.zeros((len(grid), 1), np.float32)])
    corners = np.arange(len(grid) - 501, dtype=np.uint32)
    scene = burnish.Scene()
    scene.add(
        burnish.Mesh(positions, np.stack([corners, corners + 1, corners + 500], -1)), burnish.Material()
    )
    what = "a frame of 24 x 32 pixels: a scene of 1 meshes and 0 textures"
    with pytest.raises(burnish.VulkanError, match=refusal(what, r"[\d.]+", 8)):
        burnish.render(scene, size=SIZE, device=small)
    assert_works(small, expected)


def test_what_no_buffer_can_hold_is_refused_at_once(device, expected):
    """Nothing is taken: the largest picture has more pixels than one buffer of a CPU device can hold."""
    largest = device.limits["max_allocation_bytes"]
    if largest >= 16384 * 16384 * 16:
        pytest.skip("this device has room for the largest picture")
    with pytest.raises(burnish.VulkanError, match=r"a frame of 16384 x 16384 pixels: expected .* MiB"):
        burnish.render(make_scene(), size=(16384, 16384), device=limited(device, 1024))
    assert_works(device, expected)


def test_maps_of_earlier_frames_make_room(device):
    """All of them are held, and together they would not fit; each alone does."""
    scenes = [make_scene(spots(seed=seed, face_size=128)) for seed in range(8)]
    wanted = [burnish.render(scene, size=SIZE, device=device).color.copy() for scene in scenes]
    small = limited(device, 16)
    for _ in range(2):
        for scene, color in zip(scenes, wanted, strict=True):
            np.testing.assert_array_equal(burnish.render(scene, size=SIZE, device=small).color, color)
    assert small.memory_statistics()["bytes_reserved"] <= 16 * MIB


@pytest.mark.slow
def test_every_limit_gives_the_right_picture_or_an_error(device, expected):
    scene, size = make_scene(spots(face_size=64)), (200, 300)
    wanted = burnish.render(scene, size=size, device=device).color.copy()
    outcomes = []
    # The small picture that must still be drawn takes 1.01 MiB, a tenth of it for diffuse light.
    for half_mebibytes in range(3, 25, 2):
        small = limited(device, half_mebibytes / 2)
        try:
            for _ in range(2):
                np.testing.assert_array_equal(burnish.render(scene, size=size, device=small).color, wanted)
            outcomes.append(True)
        except burnish.VulkanError as error:
            assert "MiB more memory on" in str(error)
            outcomes.append(False)
        assert small.memory_statistics()["bytes_reserved"] <= half_mebibytes * MIB // 2
        assert_works(small, expected)
    assert not outcomes[0] and outcomes[-1]


@pytest.mark.slow
@pytest.mark.parametrize("call", ["vkAllocateMemory", "vkQueueSubmit2"])
def test_a_refusal_that_passes_goes_unnoticed(device, expected, call):
    """What is kept for later frames is given back, and the work is done once more."""
    for skip in range(4 if call == "vkAllocateMemory" else 9):
        fresh = burnish.Device(name=device.name)
        burnish._core.inject_fault(fresh, call, OUT_OF_DEVICE_MEMORY, skip, 2)
        assert_works_after_two_refusals(fresh, expected)


def assert_works_after_two_refusals(fresh, expected):
    try:
        assert_works(fresh, expected)
    except burnish.VulkanError as error:
        # The second refusal met the second attempt.
        assert "VK_ERROR_OUT_OF_DEVICE_MEMORY" in str(error)
        assert_works(fresh, expected)


@pytest.mark.parametrize("limit", [0, -1, MIB - 1])
def test_limits_that_make_no_sense_are_refused(limit):
    with pytest.raises(
        ValueError, match=f"memory_limit_bytes: expected None or at least 1048576, got {limit}"
    ):
        burnish.Device(memory_limit_bytes=limit)
