"""The two lookups, the device's sampler and our own for CPU devices, read the same map."""

from dataclasses import replace

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.oracle.cube_map import pad_cube, sample_cube
from burnish.oracle.prefiltered import prefiltered_level
from burnish.rendering import plan as plan_of
from engine_support import directions, random_points, smooth_environment_faces, unit

# Relative to maps of order 1: float32 places a lookup within 1e-5 of a texel, and neighbouring texels of the
# smooth maps here differ by less than their value.
LIMIT = 2e-5
# Levels that a lookup makes are rounded to halves: where two lookups differ in the last digit, by one step.
STEP = 2.0**-11


@pytest.fixture(scope="module")
def software():
    return burnish.Device(lookup="software")


@pytest.fixture(scope="module")
def sampler_device(device):
    """The device's sampler, where its weights have more than the 8 bits of hardware."""
    if not device.is_software:
        pytest.skip("a GPU's bilinear weights have 8 bits")
    return burnish.Device(lookup="sampler")


def looked_up(environment, roughness, towards, device):
    """One lookup along each direction, at the level of a roughness: a prefiltered map seen straight on."""
    material = burnish.Material(lobes=[burnish.KurtLobe(roughness=roughness)])
    tangents = directions(np.roll(towards, 1, axis=-1) * [1, -1, 1])
    return burnish.shade(
        environment, material, burnish.Prefiltered(), towards, tangents, towards, device=device
    )


def all_over_the_cube(rng):
    """Directions at random, close to edges and corners, and exactly there."""
    corners = np.sign(rng.standard_normal((500, 3))) * (1 - rng.uniform(0, 0.02, (500, 3)))
    edges = corners.copy()
    edges[:, 2] *= rng.uniform(0, 1, 500)
    exact = np.stack(np.meshgrid(*[(-1, 0, 1)] * 3), axis=-1).reshape(-1, 3)
    exact = exact[np.abs(exact).sum(axis=-1) > 0]
    turned = np.concatenate([np.roll(edges, k, axis=-1) for k in range(3)])
    return directions(unit(np.concatenate([rng.standard_normal((2000, 3)), turned, corners, exact])))


@pytest.mark.parametrize("face_size", [1, 2, 8, 64])
@pytest.mark.parametrize("roughness", [0.001, 0.03, 0.1, 0.3, 1.0])
def test_software_lookup_equals_oracle(software, rng, face_size, roughness):
    environment = burnish.Environment.from_faces(smooth_environment_faces(face_size))
    cube = pad_cube([texels for _, texels in environment.prefiltered(device=software)])
    # All texels are halves but the means where three faces meet, which the engine keeps as halves too.
    cube = replace(cube, texels=cube.texels.astype(np.float16).astype(float))
    towards = all_over_the_cube(rng)
    got = looked_up(environment, roughness, towards, software)
    expected = sample_cube(cube, towards.astype(float), prefiltered_level(roughness, face_size))
    ratio = got / expected
    # Before the light stands the lobe's albedo, the same in all directions.
    assert np.abs(ratio / np.median(ratio) - 1).max() < LIMIT


@pytest.mark.parametrize(
    ("sampler", "limit"),
    [
        (burnish.Regular(14), LIMIT),
        (burnish.Importance(64), LIMIT),
        (burnish.Matched(5), STEP),
        (burnish.Prefiltered(), STEP),
        (burnish.Reference(0.05), LIMIT),
    ],
    ids=lambda one: type(one).__name__,
)
def test_both_lookups_give_the_same_picture(software, sampler_device, rng, sampler, limit):
    environment = burnish.Environment.from_faces(smooth_environment_faces(64))
    material = burnish.Material(lobes=[burnish.KurtLobe(roughness=(0.3, 0.1), r0=0.04, alpha=0.5)])
    points = random_points(rng, 2000)
    one, other = (
        burnish.shade(environment, material, sampler, *points, device=device)
        for device in (software, sampler_device)
    )
    np.testing.assert_allclose(one, other, rtol=limit, atol=limit * one.mean())


def test_several_maps_share_one_buffer(software, sampler_device):
    """Objects with maps of their own: every layer is found, and the background's."""
    maps = [environments.spots(seed, 32) for seed in (1, 2, 3)]
    scene = burnish.Scene.spheres([burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)])] * 3, columns=3)
    scene.environment = maps[0]
    for item, environment in zip(scene.objects[1:], maps[1:], strict=True):
        item.reflects = environment
    frames = [
        burnish.render(scene, size=(60, 160), sampler=burnish.Regular(14), device=device)
        for device in (software, sampler_device)
    ]
    difference = np.abs(frames[0].color - frames[1].color)
    assert np.quantile(difference / frames[1].color.mean(), 0.999) < 1e-3


def test_largest_maps_are_read_where_they_lie(software, sampler_device, rng):
    """A cube of faces of 2048 has more pairs than a float32 can count."""
    texels = rng.uniform(0.5, 2, (6, 2048, 2048, 1)).astype(np.float32)
    scene = burnish.Scene()
    scene.environment = burnish.Environment.from_faces(np.repeat(texels, 3, axis=-1))
    camera = burnish.Camera(np.eye(4))
    frames = [
        burnish.render(scene, camera, (96, 128), device=one).color for one in (software, sampler_device)
    ]
    # Float32 places a lookup within 2^-12 of a texel here.
    np.testing.assert_allclose(*frames, atol=2e-3)


def test_report_says_which_lookup_ran_and_why(software):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = environments.spots(1, 32)
    line = {one["name"]: one for one in burnish.render(scene, size=(8, 8), device=software).report.effects}
    assert line["software lookup"]["on"] and line["software lookup"]["reason"] == "asked for"
    planned = {one["name"]: one for one in plan_of(scene, is_software=True)["effects"]}
    assert planned["software lookup"]["on"] and "CPU" in planned["software lookup"]["reason"]
    planned = {one["name"]: one for one in plan_of(scene, is_software=False)["effects"]}
    assert not planned["software lookup"]["on"] and "hardware" in planned["software lookup"]["reason"]


@pytest.mark.parametrize("sampler", [burnish.Regular(5), burnish.Matched(5), burnish.Prefiltered()], ids=repr)
def test_small_texel_buffers_change_nothing_but_where_pairs_lie(software, monkeypatch, sampler):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = environments.spots(1, 16)
    monkeypatch.setenv("BURNISH_TEXEL_LIMIT", "1000")  # a map of faces of 16 has 2,716 pairs
    small = burnish.Device(lookup="software")
    assert small.limits["max_texel_buffer_elements"] == 1000
    frames = [burnish.render(scene, size=(24, 32), sampler=sampler, device=one) for one in (software, small)]
    np.testing.assert_array_equal(*(frame.color for frame in frames))
    line = {one["name"]: one for one in frames[1].report.effects}["software lookup"]
    assert line["on"] and line["reason"].endswith(
        "maps of 1 of 1 sizes are read from storage buffers: they are too large for texel buffers"
    )
    levels = [scene.environment.pyramid(device=one) for one in (software, small)]
    for expected, found in zip(*levels, strict=True):
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("text", ["0", "-1", "many", "1000x"])
def test_texel_limits_that_make_no_sense_are_refused(monkeypatch, text):
    monkeypatch.setenv("BURNISH_TEXEL_LIMIT", text)
    with pytest.raises(ValueError, match=f"BURNISH_TEXEL_LIMIT: expected a count .* got '{text}'"):
        burnish.Device()


def test_unknown_lookups_are_refused(monkeypatch):
    with pytest.raises(ValueError, match="expected auto, sampler or software, got 'nearest'"):
        burnish.Device(lookup="nearest")
    monkeypatch.setenv("BURNISH_LOOKUP", "fast")
    with pytest.raises(ValueError, match="got 'fast'"):
        burnish.Device()
