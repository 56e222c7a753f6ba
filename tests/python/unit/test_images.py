"""Pictures in and out."""

import json
import os
import struct

import numpy as np
import OpenEXR
import pytest
from PIL import Image

import picture_support as made
from burnish import FileError, images
from burnish.images.exr_header import CUBE, LATLONG


@pytest.fixture
def picture(rng):
    return rng.uniform(0.0, 4.0, (37, 53, 4)).astype(np.float32)


def write_raw(path, header, channels):
    with OpenEXR.File(header, channels) as file:
        file.write(str(path))
    return path


def test_exr_round_trip_is_exact(tmp_path, picture):
    path = tmp_path / "frame.exr"
    images.write_exr(path, picture)
    np.testing.assert_array_equal(images.read_image(path), picture)


def test_exr_half_rounds_and_stays_finite(tmp_path):
    path = tmp_path / "frame.exr"
    images.write_exr(path, np.array([[[0.1, 1e6, np.inf]]], np.float32), half=True)
    np.testing.assert_array_equal(
        images.read_image(path)[0, 0], np.float32([np.float16(0.1), 65504.0, np.inf])
    )


def test_exr_metadata_becomes_attributes(tmp_path, picture):
    path = tmp_path / "frame.exr"
    images.write_exr(
        path, {"RGB": picture[..., :3], "depth": picture[..., 3]}, {"burnish": {"spp": 4}, "note": "text"}
    )
    with OpenEXR.File(str(path), separate_channels=True) as file:
        header = dict(file.header())  # closing the file empties its own
        assert set(file.channels()) == {"R", "G", "B", "depth"}
    assert json.loads(header["burnish"]) == {"spp": 4}
    assert header["note"] == "text"
    with pytest.raises(
        ValueError, match="metadata: expected names that OpenEXR does not use itself, got 'channels'"
    ):
        images.write_exr(path, picture, {"channels": "x"})


def test_writing_leaves_no_other_file_and_the_usual_permissions(tmp_path, picture):
    images.write_exr(tmp_path / "a.exr", picture)
    images.write_png(tmp_path / "a.png", picture)
    assert sorted(os.listdir(tmp_path)) == ["a.exr", "a.png"]
    (tmp_path / "plain").touch()
    assert (tmp_path / "a.exr").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_a_failed_write_keeps_the_old_file(tmp_path, picture, monkeypatch):
    path = tmp_path / "a.png"
    images.write_png(path, picture)
    before = path.read_bytes()

    def fail(self, *args, **kwargs):
        raise OSError("disk full")

    monkeypatch.setattr(Image.Image, "save", fail)
    with pytest.raises(OSError, match="disk full"):
        images.write_png(path, picture)
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["a.png"]


def test_writing_into_a_missing_folder_says_so(tmp_path, picture):
    with pytest.raises(FileError, match=r"cannot write into .*nowhere"):
        images.write_exr(tmp_path / "nowhere" / "a.exr", picture)


@pytest.mark.parametrize("compression", ["NO", "RLE", "ZIPS", "ZIP", "PIZ"])
@pytest.mark.parametrize("dtype", [np.float16, np.float32])
def test_exr_of_every_lossless_compression_is_read(tmp_path, picture, compression, dtype):
    pixels = picture[..., :3].astype(dtype)
    header = {"compression": getattr(OpenEXR, f"{compression}_COMPRESSION"), "type": OpenEXR.scanlineimage}
    path = write_raw(tmp_path / "a.exr", header, {"RGB": pixels})
    np.testing.assert_array_equal(images.read_image(path), pixels.astype(np.float32))


def test_tiled_mip_mapped_exr_gives_level_0(shared_data):
    pixels = images.read_image(shared_data / "environments" / "KernerEnvLatLong.exr")
    assert pixels.shape == (512, 1024, 4)
    luminance = pixels[..., :3] @ np.array([0.2126, 0.7152, 0.0722])
    assert luminance.max() == pytest.approx(1678, rel=1e-3)  # of the data's index
    assert luminance.mean() == pytest.approx(0.1519, rel=1e-3)


def test_missing_colours_are_zero_and_luminance_is_grey(tmp_path, picture):
    header = {"type": OpenEXR.scanlineimage}
    with pytest.warns(UserWarning, match=r"r\.exr: channels G, B are missing and read as 0"):
        red_only = images.read_image(write_raw(tmp_path / "r.exr", header, {"R": picture[..., 0].copy()}))
    np.testing.assert_array_equal(red_only, np.stack([picture[..., 0], *2 * [0 * picture[..., 0]]], axis=2))
    grey = images.read_image(write_raw(tmp_path / "y.exr", header, {"Y": picture[..., 0].copy()}))
    np.testing.assert_array_equal(grey, np.repeat(picture[..., :1], 3, axis=2))


def test_a_single_layer_is_read_and_unknown_channels_are_named(tmp_path, picture):
    header = {"type": OpenEXR.scanlineimage}
    layer = {f"beauty.{c}": picture[..., i].copy() for i, c in enumerate("RGB")}
    np.testing.assert_array_equal(
        images.read_image(write_raw(tmp_path / "l.exr", header, layer)), picture[..., :3]
    )
    path = write_raw(tmp_path / "z.exr", header, {"Z": picture[..., 0].copy(), "id": picture[..., 1].copy()})
    with pytest.raises(FileError, match="expected channels R, G, B or Y, or one layer of them, got Z, id"):
        images.read_image(path)


def test_luminance_chroma_is_refused(tmp_path, picture):
    header = {"type": OpenEXR.scanlineimage}
    channels = {name: picture[..., i].copy() for i, name in enumerate(("Y", "RY", "BY"))}
    with pytest.raises(FileError, match=r"got luminance-chroma channels \(Y, RY, BY\)"):
        images.read_image(write_raw(tmp_path / "yc.exr", header, channels))


def test_display_window_crops_and_pads(tmp_path, picture):
    header = {
        "type": OpenEXR.scanlineimage,
        "dataWindow": (np.array([0, 0], np.int32), np.array([52, 36], np.int32)),
        "displayWindow": (np.array([-3, 5], np.int32), np.array([39, 49], np.int32)),
    }
    shown = images.read_image(write_raw(tmp_path / "w.exr", header, {"RGBA": picture}))
    assert shown.shape == (45, 43, 4)
    np.testing.assert_array_equal(shown[:32, 3:], picture[5:, :40])
    assert not shown[32:].any()
    assert not shown[:, :3].any()


def test_shared_display_window_file_is_cropped(shared_data):
    assert images.read_image(shared_data / "bad-input/openexr/DisplayWindow/t05.exr").shape == (260, 340, 3)


def test_multi_part_gives_the_first_part(tmp_path, picture):
    parts = [
        OpenEXR.Part({"type": OpenEXR.scanlineimage}, {"RGBA": picture}, name="first"),
        OpenEXR.Part(
            {"type": OpenEXR.scanlineimage}, {"RGB": np.zeros_like(picture[..., :3])}, name="second"
        ),
    ]
    with OpenEXR.File(parts) as file:
        file.write(str(tmp_path / "m.exr"))
    np.testing.assert_array_equal(images.read_image(tmp_path / "m.exr"), picture)


def test_envmap_attribute_is_read(shared_data):
    environments = shared_data / "environments"
    assert images.read_picture(environments / "KernerEnvLatLong.exr").envmap == LATLONG
    assert images.read_picture(environments / "KernerEnvCube.exr").envmap == CUBE


def test_the_first_bytes_decide_not_the_name(tmp_path, picture):
    path = tmp_path / "frame.jpg"
    images.write_exr(tmp_path / "frame.exr", picture)
    (tmp_path / "frame.exr").rename(path)
    np.testing.assert_array_equal(images.read_image(path), picture)
    (tmp_path / "text.exr").write_text("no picture")
    with pytest.raises(FileError, match="expected an OpenEXR, Radiance, PNG or JPEG picture, got 6e 6f"):
        images.read_image(tmp_path / "text.exr")
    (tmp_path / "empty.exr").touch()
    with pytest.raises(FileError, match="got an empty file"):
        images.read_image(tmp_path / "empty.exr")
    with pytest.raises(FileError, match="expected a file, found none"):
        images.read_image(tmp_path / "absent.exr")
    with pytest.raises(FileError, match="expected a file, got something else"):
        images.read_image(tmp_path)


def test_every_truncation_of_an_exr_is_a_file_error(tmp_path, rng):
    images.write_exr(tmp_path / "a.exr", rng.uniform(size=(40, 30, 3)).astype(np.float32))
    data = (tmp_path / "a.exr").read_bytes()
    for size in [*range(8, 500, 7), *range(500, len(data), 997)]:
        path = tmp_path / "cut.exr"
        path.write_bytes(data[:size])
        with pytest.raises(FileError, match=r"cut\.exr: .*(expected|got)"):
            images.read_image(path)


@pytest.mark.parametrize("name", ["rooitou_park_1k.hdr", "studio_small_03_1k.hdr"])
def test_hdr_values_are_those_of_the_index(shared_data, name):
    pixels = images.read_image(shared_data / "environments" / name)
    assert pixels.shape == (512, 1024, 3)
    expected = {"rooitou_park_1k.hdr": (6.912e4, 0.5237), "studio_small_03_1k.hdr": (3568, 1.848)}[name]
    luminance = pixels @ np.array([0.2126, 0.7152, 0.0722])
    assert pixels.max() == pytest.approx(expected[0], rel=1e-3)
    assert luminance.mean() == pytest.approx(expected[1], rel=1e-3)


def test_srgb_curve_and_its_inverse():
    linear = np.float32([0.0, 0.001, 0.0031308, 0.18, 0.5, 1.0])
    # IEC 61966-2-1: 0.18 -> 0.461356, 0.5 -> 0.735357
    np.testing.assert_allclose(images.srgb_encode(linear)[3:], [0.461356, 0.735357, 1.0], atol=1e-5)
    np.testing.assert_allclose(images.srgb_decode(images.srgb_encode(linear)), linear, atol=1e-6)


def test_display_image_handles_what_a_frame_may_hold():
    linear = np.float32([[[np.nan, np.inf, -np.inf], [0.25, 1e30, -1.0]]])
    np.testing.assert_array_equal(images.display_image(linear, 1.0), [[[0, 255, 0], [188, 255, 0]]])
    rgba = np.float32([[[1.0, 1.0, 1.0, 0.5]]])
    assert images.display_image(rgba, -10.0)[0, 0, 3] == 128  # coverage knows no exposure
    with pytest.raises(ValueError, match=r"linear: expected shape .*, got \(2, 2, 2\)"):
        images.display_image(np.zeros((2, 2, 2)))


def test_png_round_trip_within_half_a_step(tmp_path, rng):
    linear = rng.uniform(0.0, 1.0, (16, 16, 4)).astype(np.float32)
    images.write_png(tmp_path / "a.png", linear)
    read = images.read_image(tmp_path / "a.png")
    assert read.shape == (16, 16, 4)
    difference = images.srgb_encode(read[..., :3]) - images.srgb_encode(linear[..., :3])
    assert np.abs(difference).max() <= 0.5 / 255 + 1e-6
    assert np.abs(read[..., 3] - linear[..., 3]).max() <= 0.5 / 255 + 1e-6


def test_grey_and_palette_pngs_become_rgb(tmp_path):
    Image.new("L", (3, 2), 188).save(tmp_path / "l.png")
    Image.new("RGB", (3, 2), (188, 0, 255)).convert("P").save(tmp_path / "p.png")
    Image.fromarray(np.full((2, 3), 65535, np.uint16)).save(tmp_path / "i16.png")
    np.testing.assert_allclose(images.read_image(tmp_path / "l.png"), np.full((2, 3, 3), 0.5029), atol=1e-3)
    assert images.read_image(tmp_path / "p.png").shape == (2, 3, 3)
    np.testing.assert_allclose(images.read_image(tmp_path / "i16.png"), np.ones((2, 3, 3)))


@pytest.mark.parametrize("channels", [None, 2, 3, 4])
@pytest.mark.parametrize("is_interlaced", [False, True])
def test_pngs_of_16_bits_are_read_whole(rng, channels, is_interlaced):
    shape = (9, 11) if channels is None else (9, 11, channels)
    samples = rng.integers(0, 65536, shape, np.uint16)
    read = images.read_image(made.png(samples, is_interlaced=is_interlaced))
    planes = samples.reshape(9, 11, -1)
    colors = planes[..., :3] if (channels or 1) > 2 else np.repeat(planes[..., :1], 3, axis=2)
    # Single precision holds both the share and the power of it.
    np.testing.assert_allclose(read[..., :3], images.srgb_decode(colors / 65535.0), rtol=1e-6)
    assert read.shape[2] == (4 if channels in (2, 4) else 3)
    if channels in (2, 4):
        np.testing.assert_allclose(read[..., 3], planes[..., -1] / 65535.0, rtol=1e-7)


def test_a_transparent_colour_of_16_bits_becomes_alpha():
    samples = np.array([[[1, 2, 3], [257, 2, 3]]], np.uint16)
    read = images.read_image(made.png(samples, (b"tRNS", struct.pack(">3H", 257, 2, 3))))
    np.testing.assert_array_equal(read[..., 3], [[1, 0]])


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_a_damaged_png_is_refused(rng, dtype):
    data = made.png(rng.integers(0, 255, (30, 40, 3), dtype))
    wrong = bytearray(data)
    wrong[len(data) // 2] ^= 1
    with pytest.raises(FileError, match=r"PNG: chunk 'IDAT': expected the checksum 0x[0-9a-f]+, got another"):
        images.read_image(bytes(wrong))
    with pytest.raises(FileError, match=r"PNG: chunk 'IDAT': expected [0-9]+ bytes, got the end of the file"):
        images.read_image(data[: len(data) // 2])
    short = made.png(rng.integers(0, 255, (30, 40, 3), dtype), rows=29)
    with pytest.raises(FileError, match=r"PNG: expected (3630|7230) bytes of samples, got (3509|6989)"):
        images.read_image(short)
