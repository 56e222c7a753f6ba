import json

import numpy as np
import OpenEXR
import pytest
from PIL import Image

import burnish
from burnish.frame import Frame
from burnish.report import Report


@pytest.fixture
def frame(rng):
    alpha = np.zeros((6, 8), np.float32)
    alpha[1:5, 2:7] = 1.0
    return Frame(
        color=rng.random((6, 8, 3), np.float32) * 4,
        alpha=alpha,
        depth=np.where(alpha > 0, rng.random((6, 8), np.float32), np.inf).astype(np.float32),
        normal=rng.random((6, 8, 3), np.float32),
        report=Report({"passes": [{"name": "shade", "milliseconds": 1.5}]}),
    )


def copy_with(frame, color):
    return Frame(color.astype(np.float32), frame.alpha, frame.depth, frame.normal, frame.report)


def test_exr_holds_every_channel_and_the_report(frame, tmp_path):
    path = tmp_path / "frame.exr"
    frame.save(path)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = {name: channel.pixels for name, channel in file.channels().items()}
        report = json.loads(file.header()["burnish"])
    assert set(channels) == {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"}
    for i, name in enumerate("RGB"):
        np.testing.assert_array_equal(channels[name], frame.color[..., i])
    np.testing.assert_array_equal(channels["A"], frame.alpha)
    np.testing.assert_array_equal(channels["Z"], frame.depth)
    np.testing.assert_array_equal(channels["N.Y"], frame.normal[..., 1])
    assert report == json.loads(frame.report.to_json())


def test_exr_reads_back_as_a_picture(frame, tmp_path):
    path = tmp_path / "frame.exr"
    frame.save(path)
    np.testing.assert_array_equal(burnish.images.read_image(path)[..., :3], frame.color)


def test_png_is_exposed_and_encoded(frame, tmp_path):
    grey = copy_with(frame, np.full((6, 8, 3), 0.25))
    grey.save(tmp_path / "a.png")
    grey.save(tmp_path / "b.PNG", exposure=2.0)
    assert np.asarray(Image.open(tmp_path / "a.png"))[0, 0].tolist() == [137, 137, 137]
    assert np.asarray(Image.open(tmp_path / "b.PNG"))[0, 0].tolist() == [255, 255, 255]


@pytest.mark.parametrize("name", ["frame.jpg", "frame", "frame.npy"])
def test_other_names_are_refused(frame, tmp_path, name):
    with pytest.raises(ValueError, match=r"path: expected a name ending in \.exr or \.png, got .*frame"):
        frame.save(tmp_path / name)


@pytest.mark.parametrize("name", ["absent/frame.exr", "absent/frame.png"])
def test_a_folder_that_is_absent_is_a_file_error(frame, tmp_path, name):
    with pytest.raises(burnish.FileError, match="absent"):
        frame.save(tmp_path / name)


def test_error_is_the_relative_rmse_where_objects_are(frame):
    assert frame.error(frame) == 0.0
    assert copy_with(frame, frame.color * 1.1).error(frame) == pytest.approx(0.1, rel=1e-5)
    outside = frame.color.copy()
    outside[0, 0] += 100.0
    assert copy_with(frame, outside).error(frame) == 0.0
    one = frame.color.copy()
    one[2, 3, 1] += 1.0
    expected = 1.0 / np.sqrt(np.sum(frame.color[frame.alpha > 0].astype(float) ** 2))
    assert copy_with(frame, one).error(frame) == pytest.approx(expected, rel=1e-5)


def test_error_without_objects_is_not_a_number(frame):
    empty = Frame(frame.color, frame.alpha * 0, frame.depth, frame.normal, frame.report)
    assert np.isnan(frame.error(empty))


def test_error_refuses_another_size(frame):
    small = Frame(frame.color[:4], frame.alpha[:4], frame.depth[:4], frame.normal[:4], frame.report)
    with pytest.raises(ValueError, match=r"reference: expected a frame of shape \(6, 8\), got \(4, 8\)"):
        frame.error(small)


def seen_by(frame, camera, spp=1):
    report = Report({"spp": spp})
    return Frame(frame.color, frame.alpha, frame.depth, frame.normal, report, camera=camera)


CAMERA = burnish.Camera.look_at((0, 1, 4), (0, 0, 0), vertical_fov=0.7)


@pytest.mark.parametrize(
    "camera",
    [
        burnish.Camera.look_at((0, 1, 4.001), (0, 0, 0), vertical_fov=0.7),
        burnish.Camera.look_at((0, 1, 4), (0, 0, 0), vertical_fov=0.701),
        burnish.Camera.orthographic((0, 1, 4), (0, 0, 0), half_height=1.0),
    ],
    ids=["moved", "zoomed", "orthographic"],
)
def test_error_refuses_another_camera(frame, camera):
    with pytest.raises(ValueError, match=r"reference: expected a frame seen by Camera\(.*, got another view"):
        seen_by(frame, CAMERA).error(seen_by(frame, camera))


def test_error_compares_no_camera_that_is_not_known_and_no_near_plane(frame):
    nearer = burnish.Camera.look_at((0, 1, 4), (0, 0, 0), vertical_fov=0.7, near_plane=0.5)
    for one, other in ((CAMERA, CAMERA), (CAMERA, nearer), (CAMERA, None), (None, CAMERA)):
        assert seen_by(frame, one).error(seen_by(frame, other)) == 0.0


def test_error_warns_of_another_number_of_pictures(frame):
    with pytest.warns(RuntimeWarning, match=r"reference: expected a frame of spp 4, got one of spp 64"):
        assert seen_by(frame, CAMERA, 4).error(seen_by(frame, CAMERA, 64)) == 0.0


def test_frame_says_what_it_is(frame):
    assert repr(frame) == "Frame(8x6, 1.5 ms)"
