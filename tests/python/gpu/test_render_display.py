"""Display output: the device stores the 8 bits that `display_image` makes of linear radiance."""

import numpy as np
import pytest
from PIL import Image

import burnish
from burnish.images import display_image
from burnish.rendering import plan as plan_of

BRIGHT = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)], emissive=(0.0, 0.002, 0.3))
# A code differs only where the encoded value lies within the shader's rounding of half a code.
SHARE_OTHERWISE = 2e-3


@pytest.fixture
def scene(spots64):
    scene = burnish.Scene.sphere(BRIGHT)
    scene.environment = spots64
    return scene


def shown(frame, exposure=0.0):
    return display_image(np.concatenate([frame.color, frame.alpha[..., None]], axis=2), exposure)


def assert_same_codes(actual, expected):
    assert actual.dtype == np.uint8 and actual.shape == expected.shape
    difference = np.abs(actual.astype(int) - expected)
    assert difference.max() <= 1 and np.mean(difference > 0) <= SHARE_OTHERWISE


@pytest.mark.parametrize("spp", [1, 3])
@pytest.mark.parametrize("background", [True, False])
@pytest.mark.parametrize("exposure", [0.0, -2.5, 64.0])
def test_display_output_is_the_display_image(device, scene, spp, background, exposure):
    scene.show_background = background
    options = {"size": (72, 96), "spp": spp, "device": device}
    linear = burnish.render(scene, **options)
    for _ in range(2):  # the second is drawn into what the first left behind
        frame = burnish.render(scene, **options, output="display", display_exposure=exposure)
        assert_same_codes(frame.display, shown(linear, exposure))
        np.testing.assert_array_equal(frame.depth, linear.depth)
        np.testing.assert_array_equal(frame.normal, linear.normal)
        assert len(np.unique(shown(linear, exposure))) >= (2 if exposure == 64.0 else 30)
        del frame


@pytest.mark.parametrize("sampler", [burnish.Matched(5), burnish.Prefiltered(), burnish.Reference(0.05)])
def test_display_output_of_every_kernel(device, scene, sampler):
    options = {"size": (24, 32), "sampler": sampler, "device": device}
    frame = burnish.render(scene, **options, output="display")
    assert_same_codes(frame.display, shown(burnish.render(scene, **options)))


def test_display_output_of_several_pipelines(device, spots64):
    materials = [burnish.Material(lobes=[burnish.KurtLobe()] * k, diffuse=0.3) for k in (0, 1, 2)]
    scene = burnish.Scene.spheres(materials, columns=3)
    scene.environment = spots64
    options = {"size": (24, 72), "device": device}
    frame = burnish.render(scene, **options, output="display")
    assert_same_codes(frame.display, shown(burnish.render(scene, **options)))


def test_display_pixels_outlive_their_frame_and_later_frames(device, scene):
    options = {"size": (24, 32), "device": device, "output": "display"}
    pixels = burnish.render(scene, **options).display
    kept = pixels.copy()
    for exposure in (1.0, 2.0, 3.0):
        burnish.render(scene, **options, display_exposure=exposure)
    np.testing.assert_array_equal(pixels, kept)


def test_frame_of_display_output_says_what_it_lacks(device, scene, tmp_path):
    frame = burnish.render(scene, size=(24, 32), device=device, output="display")
    for name in ("color", "alpha"):
        with pytest.raises(ValueError, match=f'{name}: expected a frame rendered with output="linear"'):
            getattr(frame, name)
    with pytest.raises(ValueError, match='color: expected a frame rendered with output="linear"'):
        frame.save(tmp_path / "x.exr")
    with pytest.raises(ValueError, match="exposure: expected 0 for a frame of display output, got 1"):
        frame.save(tmp_path / "x.png", exposure=1)
    assert repr(frame).startswith("Frame(32x24")
    frame.save(tmp_path / "x.png")
    np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / "x.png")), frame.display[..., :3])
    linear = burnish.render(scene, size=(24, 32), device=device)
    with pytest.raises(ValueError, match='display: expected a frame rendered with output="display"'):
        _ = linear.display


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"output": "8 bit"}, "output: expected one of linear, display, got '8 bit'"),
        ({"output": "display", "display_exposure": 65}, r"display_exposure: .* in -64..64, got 65"),
        ({"output": "display", "display_exposure": float("nan")}, "display_exposure: .*, got nan"),
        ({"output": "display", "display_exposure": "1 stop"}, "display_exposure: .*, got '1 stop'"),
        ({"display_exposure": 1.0}, "display_exposure: expected 0 beside linear output, got 1.0"),
        ({"output": "display", "error_estimate": True}, "error_estimate: expected False beside display"),
    ],
)
def test_display_options_out_of_range_are_refused(device, scene, options, text):
    with pytest.raises(ValueError, match=text):
        burnish.render(scene, device=device, **options)


def test_plan_says_where_display_output_is_made(device, scene):
    def line(**options):
        return next(one for one in plan_of(scene, **options)["effects"] if one["name"] == "display output")

    assert not line()["on"] and line()["reason"] == "linear radiance is asked for"
    assert line(output="display")["on"] and "fused into the store" in line(output="display")["reason"]
    assert "after accumulation" in line(output="display", spp=2)["reason"]
    report = burnish.render(scene, size=(8, 8), device=device, output="display").report
    assert line(output="display") in report.effects
