"""Pictures from paths, bytes and open files; parts and layers by request; threads."""

import contextlib
import io
import os
import sys
import threading
import warnings

import numpy as np
import pytest
from field_values import PROPER, RGB, SAMPLES

import picture_support as made
from burnish import Environment, FileError, images

FILES = {"exr": made.exr(PROPER), "hdr": made.hdr(RGB), "png": made.png(SAMPLES)}


@pytest.mark.parametrize("kind", FILES)
@pytest.mark.parametrize("wrap", [bytes, bytearray, memoryview, io.BytesIO], ids=lambda wrap: wrap.__name__)
def test_bytes_give_what_the_file_gives(tmp_path, kind, wrap):
    path = tmp_path / f"sky.{kind}"
    path.write_bytes(FILES[kind])
    expected = images.read_image(path)
    np.testing.assert_array_equal(images.read_image(wrap(FILES[kind])), expected)
    with path.open("rb") as stream:
        np.testing.assert_array_equal(images.read_image(stream), expected)
        assert not stream.closed


def test_an_open_file_is_read_from_where_it_stands():
    stream = io.BytesIO(b"before" + FILES["exr"])
    stream.seek(6)
    np.testing.assert_array_equal(images.read_image(stream), RGB)


def test_environments_are_named_after_what_they_come_from(tmp_path):
    path = tmp_path / "sky.hdr"
    path.write_bytes(FILES["hdr"])
    with path.open("rb") as stream:
        assert Environment.from_file(stream).name == "sky.hdr"
    assert Environment.from_file(str(path)).name == "sky.hdr"
    assert Environment.from_file(FILES["hdr"]).name == "picture in memory"
    np.testing.assert_array_equal(
        Environment.from_file(FILES["hdr"]).faces, Environment.from_file(path).faces
    )


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (None, "path: expected a path, bytes, or a file opened in binary mode, got NoneType"),
        (3, "got int"),
        (np.zeros(3), "got ndarray"),
        (io.StringIO("text"), "got StringIO that reads text"),
    ],
)
def test_what_is_no_source_is_the_callers_mistake(given, message):
    for read in (images.read_image, images.read_exr, Environment.from_file):
        with pytest.raises(ValueError, match=message):
            read(given)


def test_errors_of_bytes_say_that_there_is_no_path():
    with pytest.raises(
        FileError, match="picture in memory: expected an OpenEXR, Radiance, PNG or JPEG picture"
    ):
        images.read_image(b"nothing of the kind")
    with pytest.raises(FileError, match=r"picture in memory: .*got an empty file"):
        images.read_image(b"")


THREE = made.exr_parts(
    ({"name": "depth"}, {"Z": RGB[..., 0]}),
    ({"name": "beauty"}, PROPER),
    ({"name": "light"}, {f"key.{name}": plane + 1 for name, plane in PROPER.items()}),
)


@pytest.mark.parametrize(
    ("part", "added"), [(None, 0), ("beauty", 0), (1, 0), ("1", 0), ("light", 1), (2, 1)]
)
def test_a_part_is_taken_by_name_or_index(part, added):
    picture = images.read_picture(THREE, part=part)
    np.testing.assert_array_equal(picture.pixels, RGB + added)
    assert any("left out are parts" in note and "depth" in note for note in picture.notes)
    assert any("'depth'" in note for note in Environment.from_file(THREE, part=part).notes)


def test_parts_and_layers_that_are_not_there_are_the_callers_mistake():
    with pytest.raises(ValueError, match=r"part: expected one of 0 'depth' \(Z\), 1 'beauty' .*, got 'fog'"):
        images.read_image(THREE, part="fog")
    with pytest.raises(ValueError, match=r"part: expected one of .*, got 3"):
        images.read_image(THREE, part=3)
    with pytest.raises(ValueError, match=r"layer: expected one of 'key' in part 2 .*, got 'fill'"):
        images.read_image(THREE, part=2, layer="fill")
    with pytest.raises(FileError, match=r"expected channels R, G, B or Y, .* got Z in part 0 'depth'"):
        images.read_image(THREE, part=0)
    for kind in ("hdr", "png"):
        with pytest.raises(
            ValueError, match=r"layer: expected None for a .* file, which has one picture, got 'a'"
        ):
            images.read_image(FILES[kind], layer="a")


def test_a_layer_is_taken_by_name_wherever_it_is():
    np.testing.assert_array_equal(images.read_image(THREE, layer="key"), RGB + 1)
    both = made.exr({**PROPER, **{f"a.b.{name}": plane + 2 for name, plane in PROPER.items()}})
    np.testing.assert_array_equal(images.read_image(both), RGB)
    np.testing.assert_array_equal(images.read_image(both, layer=""), RGB)
    np.testing.assert_array_equal(images.read_image(both, layer="a.b"), RGB + 2)
    assert "channels left out are a.b.B, a.b.G, a.b.R." in images.read_picture(both).notes[0]
    named = made.exr({f"{n}.{c}": p + k for k, n in enumerate(("ao", "Combined")) for c, p in PROPER.items()})
    np.testing.assert_array_equal(images.read_image(named), RGB + 1)


def test_a_flat_part_beside_a_deep_one_is_read():
    both = made.exr_parts(made.deep_part(4, 8), ({"name": "flat"}, PROPER))
    np.testing.assert_array_equal(images.read_image(both), RGB)
    message = r"got deep data .* in part 0 'deep' \(deep\); parts are 0 'deep'.*, 1 'flat'"
    with pytest.raises(FileError, match=message):
        images.read_image(both, part="deep")


def test_alpha_is_left_out_of_environments_and_noted():
    file = made.exr({**PROPER, "A": RGB[..., 0]})
    assert "alpha is left out: the colours are read as they stand." in Environment.from_file(file).notes
    opaque = made.exr({**PROPER, "A": np.ones_like(RGB[..., 0])})
    assert not any("alpha" in note for note in Environment.from_file(opaque).notes)


def test_what_an_environment_ignores_is_noted_and_warned_of():
    with pytest.warns(UserWarning, match=r"picture in memory: PIXASPECT 2 is not applied"):
        environment = Environment.from_file(made.hdr(RGB, "PIXASPECT=2"))
    assert environment.notes[-1] == "PIXASPECT 2 is not applied: pixels are square."


def test_tiled_parts_and_offset_windows_are_taken_too():
    import OpenEXR

    tiles = OpenEXR.TileDescription()
    tiles.xSize = tiles.ySize = 3
    window = (np.array([-2, 5], np.int32), np.array([5, 8], np.int32))
    windows = {"dataWindow": window, "displayWindow": window}
    file = made.exr_parts(
        ({"name": "first"} | windows, {"Z": RGB[..., 0]}),
        ({"name": "second", "type": OpenEXR.tiledimage, "tiles": tiles} | windows, PROPER),
    )
    np.testing.assert_array_equal(images.read_image(file), RGB)


def test_a_part_with_damaged_chunks_is_refused_and_others_are_read():
    broken = bytearray(THREE)
    name = b"chunkCount\0int\0\4\0\0\0"
    count = broken.index(name, broken.index(name) + 1) + len(name)
    broken[count : count + 4] = b"\xff\xff\xff\x7f"
    with pytest.raises(FileError, match="expected a table of 2147483647 chunks, got the end of the file"):
        images.read_image(bytes(broken), part="beauty")
    with pytest.raises(FileError, match="expected all its samples, some are damaged or missing"):
        images.read_image(THREE[:-20], part="light")
    np.testing.assert_array_equal(images.read_image(THREE[:-20], part="beauty"), RGB)


def test_damaged_samples_are_an_error_and_print_nothing(capsys, rng):
    samples = rng.integers(0, 3, (32, 64)).astype(np.float32)  # few values: what is deflated, not stored
    data = bytearray(made.exr({name: samples for name in "RGB"}))
    data[-200:-100] = bytes(100)
    with pytest.raises(FileError, match="expected all its samples, some are damaged or missing"):
        images.read_image(bytes(data))
    assert capsys.readouterr().out == ""


def test_nothing_that_all_threads_share_is_changed_for_a_moment(tmp_path, monkeypatch):
    def fail(*arguments):
        raise AssertionError("other threads would see this")

    monkeypatch.setattr(os, "umask", fail)
    monkeypatch.setattr(warnings.catch_warnings, "__enter__", fail)
    monkeypatch.setattr(contextlib.redirect_stdout, "__enter__", fail)
    for data in FILES.values():
        images.read_image(data)
    images.write_exr(tmp_path / "a.exr", RGB)
    images.write_png(tmp_path / "a.png", RGB)


def test_threads_that_read_leave_standard_output_alone():
    before = sys.stdout
    damaged = bytearray(FILES["exr"])
    damaged[-9:] = bytes(9)
    failures = []

    def work():
        try:
            for _ in range(50):
                images.read_image(FILES["exr"])
                with pytest.raises(FileError):
                    images.read_image(bytes(damaged))
                assert sys.stdout is before
        except BaseException as error:
            failures.append(error)

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert not failures
    assert sys.stdout is before
