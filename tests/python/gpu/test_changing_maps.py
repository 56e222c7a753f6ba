"""Maps that change from frame to frame: what an earlier one leaves behind is never seen."""

import numpy as np
import pytest

import burnish
from burnish import environments
from engine_support import smooth_environment_faces


def scene_under(environment):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = environment
    return scene


def maps(rng):
    """Of one size but the third; the black one shows what an earlier one left."""
    yield environments.spots(1, 32)
    yield burnish.Environment.from_faces(rng.uniform(0, 2, (6, 32, 32, 3)).astype(np.float32))
    yield burnish.Environment.from_faces(smooth_environment_faces(16))
    yield environments.spots(2, 32)
    yield burnish.Environment.from_faces(np.zeros((6, 32, 32, 3), np.float32))
    yield environments.spots(3, 32)


@pytest.mark.parametrize("lookup", ["software", "sampler"])
@pytest.mark.parametrize(
    "sampler",
    [burnish.Matched(5), burnish.Prefiltered(), burnish.Regular(14)],
    ids=lambda one: type(one).__name__,
)
def test_a_sequence_of_maps_shows_each_as_a_fresh_device_does(lookup, sampler):
    shared = burnish.Device(lookup=lookup)
    # The generator lets each map go before it makes the next one, whose room it then is.
    in_turn = [
        burnish.render(scene_under(one), size=(40, 60), sampler=sampler, device=shared).color.copy()
        for one in maps(np.random.default_rng(5))
    ]
    alone = [
        burnish.render(
            scene_under(one), size=(40, 60), sampler=sampler, device=burnish.Device(lookup=lookup)
        ).color.copy()
        for one in maps(np.random.default_rng(5))
    ]
    assert len({picture.tobytes() for picture in alone}) == len(alone)
    for k, (got, expected) in enumerate(zip(in_turn, alone, strict=True)):
        np.testing.assert_array_equal(got, expected, err_msg=f"map {k}")


def test_several_maps_after_one_another_are_those_of_a_fresh_device():
    """Two maps of a set share their room, which the next set takes."""

    def render(seed, device):
        scene = scene_under(environments.spots(seed, 32))
        scene.show_background = True
        scene.objects[0].reflects = environments.spots(seed + 100, 32)
        return burnish.render(scene, size=(40, 60), sampler=burnish.Matched(5), device=device).color.copy()

    shared = burnish.Device(lookup="software")
    for seed in range(3):
        np.testing.assert_array_equal(
            render(seed, shared), render(seed, burnish.Device(lookup="software")), err_msg=f"seed {seed}"
        )


def scene_of_maps(maps):
    scene = burnish.Scene.spheres([burnish.Material(lobes=[burnish.KurtLobe(0.2)])] * len(maps), columns=3)
    for one, light in zip(scene.objects, maps, strict=True):
        one.reflects = light
    return scene


@pytest.mark.parametrize("lookup", ["sampler", "software"])
@pytest.mark.parametrize("sampler", [burnish.Matched(8), burnish.Regular(8), burnish.Prefiltered()])
def test_one_changed_map_of_many_is_made_alone_and_shows(lookup, sampler):
    """What the others hold stays: the picture is the one that a device makes of all maps at once."""
    device = burnish.Device(lookup=lookup)
    maps = [burnish.environments.spots(face_size=16, seed=seed) for seed in range(6)]
    scene = scene_of_maps(maps)
    burnish.render(scene, size=(40, 60), sampler=sampler, device=device)
    for place, seed in ((2, 20), (5, 50)):
        maps[place] = burnish.environments.spots(face_size=16, seed=seed)
        scene.objects[place].reflects = maps[place]
    changed = burnish.render(scene, size=(40, 60), sampler=sampler, device=device)
    fresh = burnish.render(
        scene_of_maps(maps), size=(40, 60), sampler=sampler, device=burnish.Device(lookup=lookup)
    )
    np.testing.assert_array_equal(changed.color, fresh.color)
    assert {"upload", "pyramid"} <= {one["name"] for one in changed.report.passes}


def test_a_map_that_is_wanted_elsewhere_is_not_overwritten(device):
    maps = [burnish.environments.spots(face_size=16, seed=seed) for seed in range(3)]
    scene = scene_of_maps(maps)
    before = burnish.render(scene, size=(40, 60), device=device).color.copy()
    scene.objects[1].reflects = burnish.environments.spots(face_size=16, seed=30)
    assert not np.array_equal(burnish.render(scene, size=(40, 60), device=device).color, before)
    scene.objects[1].reflects = maps[1]
    np.testing.assert_array_equal(burnish.render(scene, size=(40, 60), device=device).color, before)


def spots(seed):
    return burnish.environments.spots(face_size=16, seed=seed)


def draw_maps(maps, device, sampler):
    """The picture of as many spheres, and how many maps were made for it."""
    frame = burnish.render(scene_of_maps(maps), size=(40, 60), sampler=sampler, device=device)
    return frame.color.copy(), frame.report.uploads["maps"]


@pytest.mark.parametrize("lookup", ["sampler", "software"])
@pytest.mark.parametrize("sampler", [burnish.Matched(8), burnish.Regular(8), burnish.Prefiltered()])
def test_maps_that_come_and_go_cost_only_what_is_new(lookup, sampler):
    """One by one to more than twice as many, then fewer, others in their place, and another order."""
    device = burnish.Device(lookup=lookup)
    maps = [spots(seed) for seed in range(3)]
    assert draw_maps(maps, device, sampler)[1] == 3
    for seed in range(3, 8):
        maps.append(spots(seed))
        color, made = draw_maps(maps, device, sampler)
        assert made == 1
        np.testing.assert_array_equal(color, draw_maps(maps, burnish.Device(lookup=lookup), sampler)[0])
    del maps[2:4]
    assert draw_maps(maps, device, sampler)[1] == 0
    maps[1:1] = [spots(20), spots(21), spots(22)]
    color, made = draw_maps(maps, device, sampler)
    assert made == 3
    np.testing.assert_array_equal(color, draw_maps(maps, burnish.Device(lookup=lookup), sampler)[0])
    maps.reverse()
    color, made = draw_maps(maps, device, sampler)
    assert made == 0
    np.testing.assert_array_equal(color, draw_maps(maps, burnish.Device(lookup=lookup), sampler)[0])


def test_maps_that_take_turns_are_made_once():
    device = burnish.Device()
    maps = [spots(seed) for seed in range(6)]
    made = [draw_maps(maps[k : k + 3], device, burnish.Regular(8))[1] for k in (0, 1, 2, 3, 0, 3)]
    assert made == [3, 1, 1, 1, 0, 0]


def test_texels_beyond_a_buffer_are_read_otherwise_when_one_more_map_comes(monkeypatch):
    """The seventh map is one too many for a texel buffer: all go to a storage buffer."""
    monkeypatch.setenv("BURNISH_TEXEL_LIMIT", "18000")  # a map of faces of 16 has 2,716 pairs
    device = burnish.Device(lookup="software")
    maps = [spots(seed) for seed in range(5)]
    made = [draw_maps(maps, device, burnish.Regular(8))[1]]
    for seed in range(5, 8):
        maps.append(spots(seed))
        color, count = draw_maps(maps, device, burnish.Regular(8))
        made.append(count)
        fresh = draw_maps(maps, burnish.Device(lookup="software"), burnish.Regular(8))[0]
        np.testing.assert_array_equal(color, fresh)
    assert made == [5, 1, 7, 1]
