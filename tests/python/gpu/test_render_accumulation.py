"""Jittered pictures accumulated: edges become coverage, brightness stays, and runs give the same bits."""

import numpy as np
import pytest

import burnish
from burnish.environments import spots, uniform
from burnish.oracle.render import render as oracle_render
from engine_support import oracle_camera, oracle_objects

RADIUS_PX = 1.5


def window_cumulative(x):
    """Share of the filter left of x pixels: a Blackman-Harris window of radius 1.5 pixels."""
    t = np.clip((np.asarray(x) / RADIUS_PX + 1) / 2, 0, 1)
    a0, a1, a2, a3 = 0.35875, 0.48829, 0.14128, 0.01168
    turn = 2 * np.pi * t
    sines = a1 * np.sin(turn) - a2 / 2 * np.sin(2 * turn) + a3 / 3 * np.sin(3 * turn)
    return t - sines / (2 * np.pi * a0)


def square(left, right, bottom, top, emissive=1.0):
    """A rectangle in the plane z = 0 that emits, alone in the dark."""
    corners = np.float32([[left, bottom, 0], [right, bottom, 0], [right, top, 0], [left, top, 0]])
    mesh = burnish.Mesh(corners, np.uint32([[0, 1, 2], [0, 2, 3]]), np.float32([[0, 0, 1]] * 4))
    scene = burnish.Scene()
    scene.add(mesh, burnish.Material(emissive=emissive))
    return scene


CAMERA = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=8.0, far_plane=10.0)
SIZE = (16, 16)  # one unit is one pixel; pixel k spans k - 8 .. k - 7


@pytest.mark.parametrize("edge", [0.0, 0.25, 0.5, 0.9])
@pytest.mark.parametrize("spp", [64, 256])
def test_edge_pixels_show_the_filter_s_share_of_the_covered_side(device, edge, spp):
    frame = burnish.render(square(-20, edge, -20, 20, 3.0), CAMERA, SIZE, spp=spp, device=device)
    centers = np.arange(16) - 7.5
    expected = np.broadcast_to(window_cumulative(edge - centers), SIZE)
    # The jitter's discrepancy falls about as 1/spp.
    np.testing.assert_allclose(frame.alpha, expected, atol=2.0 / spp)
    np.testing.assert_allclose(frame.color, 3 * np.repeat(expected[..., None], 3, -1), atol=6.0 / spp)


def test_references_are_accumulated_too(device):
    scene = square(-20, 0.25, -20, 20, 3.0)
    expected = burnish.render(scene, CAMERA, SIZE, spp=64, device=device)
    frame = burnish.render(scene, CAMERA, SIZE, burnish.Reference(), spp=64, device=device)
    np.testing.assert_allclose(frame.color, expected.color, rtol=1e-5)
    np.testing.assert_allclose(frame.alpha, expected.alpha, rtol=1e-5)


def test_horizontal_edges_are_filtered_as_vertical_ones(device):
    frame = burnish.render(square(-20, 20, -20, 0.25), CAMERA, SIZE, spp=256, device=device)
    rows = 7.5 - np.arange(16)
    expected = np.broadcast_to(window_cumulative(0.25 - rows)[:, None], SIZE)
    np.testing.assert_allclose(frame.alpha, expected, atol=0.01)


def test_accumulation_keeps_the_mean_brightness(device):
    """The filter's weights sum to 1: what it takes from one pixel it gives to its neighbours."""
    frame = burnish.render(square(-3.3, 2.9, -2.6, 3.7, (1, 2, 3)), CAMERA, SIZE, spp=256, device=device)
    area = (2.9 + 3.3) * (3.7 + 2.6)
    np.testing.assert_allclose(frame.color.sum(axis=(0, 1)), area * np.array([1, 2, 3]), rtol=3e-3)
    np.testing.assert_allclose(frame.alpha.sum(), area, rtol=3e-3)


@pytest.mark.parametrize("spp", [2, 3, 64, 1000])
def test_accumulation_of_a_constant_is_the_constant(device, spp):
    scene = burnish.Scene.sphere(burnish.Material(emissive=0.7))
    scene.environment = uniform(0.7)
    frame = burnish.render(scene, size=(12, 12), spp=spp, device=device)
    np.testing.assert_allclose(frame.color, np.float16(0.7), rtol=5e-4)
    assert frame.report.spp == spp and frame.alpha.max() <= 1.0 + 1e-5


@pytest.mark.parametrize("spp", [1, 2, 3, 4, 5, 6, 7, 8, 16, 33])
def test_more_pictures_do_not_shift_the_picture(device, spp):
    scene = burnish.Scene.sphere(burnish.Material(emissive=1.0))
    camera = burnish.Camera.orthographic((0, 0, 5), (0, 0, 0), half_height=1.25)
    alpha = burnish.render(scene, camera, (64, 96), spp=spp, device=device).alpha.astype(np.float64)
    y, x = np.mgrid[0:64, 0:96] + 0.5
    # A sphere's mesh is the same seen upside down and from behind; 200 pixels along its rim are off by .3 at
    # most, independently.
    assert abs((alpha * x).sum() / alpha.sum() - 48) < 0.01
    assert abs((alpha * y).sum() / alpha.sum() - 32) < 0.01


SAMPLERS = {
    "regular": burnish.Regular(8),
    "importance": burnish.Importance(8),
    "matched": burnish.Matched(5),
    "prefiltered": burnish.Prefiltered(),
    "reference": burnish.Reference(method="quadrature"),
}


@pytest.mark.parametrize("name", SAMPLERS)
def test_more_pictures_bring_every_sampler_closer_to_the_truth(device, name):
    """Against many pictures of its own at the same pixels; edges, a small highlight and the map behind."""
    lobes = [burnish.KurtLobe(roughness=0.25), burnish.KurtLobe(roughness=(0.3, 0.12), r0=0.5)]
    scene = burnish.Scene.spheres([burnish.Material(lobes=[lobe]) for lobe in lobes], columns=2)
    scene.environment = spots(4, 16)

    def draw(spp):
        return burnish.render(scene, size=(24, 40), sampler=SAMPLERS[name], spp=spp, device=device)

    truth = draw(256)
    with pytest.warns(RuntimeWarning, match=r"reference: expected a frame of spp \d+, got one of spp 256"):
        errors = [draw(spp).error(truth) for spp in (1, 4, 16)]
    # A point set without gaps halves the error from 1 to 4 and more than halves it from 4 to 16.
    assert errors[1] <= 0.5 * errors[0] and errors[2] <= 0.5 * errors[1], errors


def test_pictures_accumulate_as_the_oracle_s(device, spots64):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.3)]))
    scene.environment = spots64
    sampler, size = burnish.Regular(8), (24, 32)
    frame = burnish.render(scene, size=size, sampler=sampler, spp=5, device=device)
    expected = oracle_render(
        oracle_objects(scene),
        oracle_camera(scene.default_camera()),
        size,
        spots64.pyramid(device=device),
        sampler,
        spp=5,
    )
    # A ray in five that meets a triangle's edge may go either way, along the rim alone.
    differs = np.abs(frame.alpha - expected.alpha) > 1e-4
    assert differs.sum() <= 2
    np.testing.assert_allclose(frame.color[~differs], expected.color[~differs], rtol=2e-2, atol=2e-3)
    np.testing.assert_allclose(frame.depth[~differs], expected.depth[~differs], rtol=1e-4)


def test_one_picture_is_not_jittered(device, spots64):
    """At spp 1 rays go through pixel centres."""
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe()]))
    scene.environment = spots64
    one = burnish.render(scene, size=(33, 33), device=device)
    assert set(np.unique(one.alpha)) == {0.0, 1.0}
    np.testing.assert_array_equal(one.alpha, one.alpha[:, ::-1])


@pytest.mark.parametrize(
    "sampler",
    [burnish.Regular(), burnish.Importance(), burnish.Reference(0.05)],
    ids=["regular", "importance", "reference"],
)
def test_same_frame_has_the_same_bits(device, spots64, sampler):
    def frame(on):
        scene = burnish.Scene.shader_ball(
            burnish.Material(lobes=[burnish.KurtLobe(roughness=(0.3, 0.1), r0=0.9, alpha=0.5)])
        )
        scene.environment = spots64
        return burnish.render(scene, size=(40, 64), sampler=sampler, spp=2, device=on)

    first = frame(device)
    for on in (device, burnish.Device(name=device.name)):
        again = frame(on)
        for part in ("color", "alpha", "depth", "normal"):
            np.testing.assert_array_equal(getattr(again, part), getattr(first, part), err_msg=part)


def test_progress_is_told_and_can_stop_a_frame(device, spots64):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe()]))
    scene.environment = spots64
    told = []
    burnish.render(scene, size=(8, 8), spp=5, device=device, progress=lambda share, text: told.append(share))
    assert told == sorted(told) and told[-1] == 1.0 and len(told) == 5

    def stop(share, text):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        burnish.render(scene, size=(8, 8), spp=5, device=device, progress=stop)
    frame = burnish.render(scene, size=(8, 8), device=device)
    assert np.isfinite(frame.color).all()
