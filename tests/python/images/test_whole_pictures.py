"""A whole frame against one that the oracle renders from the equations alone, its own pyramid included."""

import numpy as np
import pytest

import burnish
from burnish import images
from burnish.filters import FILTERS
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.render import render as oracle_render
from engine_support import oracle_camera, oracle_objects, smooth_environment_faces
from image_compare import OUTPUT, assert_pictures_match


@pytest.mark.parametrize("filter", FILTERS)
def test_shader_ball_equals_the_oracle_s_picture(device, filter):
    """Glossy ball on a satin ground: nothing of the engine but the mesh goes into the expected picture."""
    lobe = burnish.KurtLobe(roughness=0.3, r0=(0.95, 0.64, 0.54), alpha=0.5)
    ball = burnish.Material(lobes=[lobe])
    ground = burnish.Material(diffuse=(0.2, 0.2, 0.25), lobes=[burnish.KurtLobe(roughness=0.15, r0=0.04)])
    scene = burnish.Scene.shader_ball(ball, ground)
    faces = smooth_environment_faces(64)
    scene.environment = burnish.Environment.from_faces(faces)
    camera, size = burnish.Camera.look_at((1.5, 1.8, 4.0), (0, 0.2, 0)), (72, 96)
    sampler = burnish.Importance(30)
    frame = burnish.render(scene, camera, size, sampler, device=device, filter=filter)
    levels = build_pyramid(faces, filter, half=True)
    expected = oracle_render(oracle_objects(scene), oracle_camera(camera), size, levels, sampler)
    # Where one object ends before another, a pixel may show either.
    same = (frame.alpha == expected.alpha) & np.isclose(frame.depth, expected.depth, rtol=1e-3)
    assert np.mean(~same) <= 0.005
    name = f"shader ball {filter}"
    assert_pictures_match(frame.color, expected.color, name, 2e-3, 0.02, 0.002, where=same)


def test_failed_comparison_writes_what_it_compared():
    expected = np.ones((4, 6, 3), np.float32)
    actual = expected.copy()
    actual[1, 2] = 3.0
    with pytest.raises(AssertionError, match=r"RMSE 0\.408 exceeds 0\.1; pictures are in .*self_test"):
        assert_pictures_match(actual, expected, "self test", 0.1)
    folder = OUTPUT / "self_test"
    for part in ("actual", "expected", "difference"):
        assert (folder / f"{part}.exr").is_file() and (folder / f"{part}.png").is_file()
    np.testing.assert_array_equal(images.read_exr(folder / "difference.exr")[0][1, 2, :3], [2, 2, 2])


def test_comparison_sees_outliers_that_the_mean_hides_and_pixels_that_are_not_finite():
    expected = np.ones((50, 50, 3))
    actual = expected.copy()
    assert assert_pictures_match(actual, expected, "self test", 1e-9) == 0.0
    actual[3, 3] = 1.5
    with pytest.raises(AssertionError, match=r"1 of 2500 pixels are off by more than 0\.1 mean radiances"):
        assert_pictures_match(actual, expected, "self test", 0.1, 0.1)
    assert_pictures_match(actual, expected, "self test", 0.1, 0.1, outlier_share=0.001)
    actual[3, 3] = np.nan
    with pytest.raises(AssertionError, match="1 pixels are not finite"):
        assert_pictures_match(actual, expected, "self test", 0.1)
