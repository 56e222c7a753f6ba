"""Environments from arrays and from files."""

import pickle

import numpy as np
import OpenEXR
import pytest

import burnish
from burnish import Environment, FileError, cube_layout, environments, images
from burnish.environment_io import environment_from_file
from burnish.oracle.pyramid import half_exponent, hold_in_halves


def energy(faces):
    """Integral over the sphere, per channel."""
    return (faces * cube_layout.cube_solid_angles(faces.shape[1])[None, :, :, None]).sum(axis=(0, 1, 2))


def lat_long_energy(image):
    height, width = image.shape[:2]
    rows = np.sin(np.linspace(np.pi / 2, -np.pi / 2, height + 1))
    return (image * (2 * np.pi / width * -np.diff(rows))[:, None, None]).sum(axis=(0, 1))


def coloured_faces(size=8):
    """Six colours and a mark in one corner of each face, so that any flip, turn or swap shows."""
    faces = np.zeros((6, size, size, 3), np.float32)
    for face in range(6):
        faces[face] = [0.1 + 0.1 * face, 0.5, 1.0 - 0.1 * face]
        faces[face, 0, 1] = [2.0 + face, 0.0, 0.0]
    return faces


def test_unpickled_arrays_are_taken():
    # Their type is equal to float32, but not the same object.
    faces = np.full((6, 4, 4, 3), 0.5, np.float32)
    unpickled = pickle.loads(pickle.dumps(faces))
    np.testing.assert_array_equal(Environment.from_faces(unpickled).faces, faces)


def test_from_faces_keeps_them():
    faces = coloured_faces()
    environment = Environment.from_faces(faces, exposure=1.5, rotation=90)
    np.testing.assert_array_equal(environment.faces, faces)
    assert environment.face_size == 8
    assert environment.exposure == 1.5
    # 90 degrees about +y: what was along +z is seen along +x.
    np.testing.assert_allclose(environment.rotation @ [0, 0, 1], [1, 0, 0], atol=1e-7)
    assert environment.texel_report.count == 0
    assert str(environment.texel_report) == ""


@pytest.mark.parametrize(
    ("faces", "message"),
    [
        (
            np.ones((6, 2, 2, 3)),
            r"faces: expected C-contiguous float32 of shape \(6, n, n, 3\), got float64 of",
        ),
        (np.ones((6, 2, 2, 4), np.float32), r"got float32 of shape \(6, 2, 2, 4\)"),
        (np.ones((6, 2, 4, 3), np.float32)[:, :, ::2], r"got non-contiguous float32 of shape \(6, 2, 2, 3\)"),
        (np.ones((6, 2, 4, 3), np.float32), "faces: expected square faces, got 2 x 4"),
        (
            np.ones((6, 3, 3, 3), np.float32),
            r"face_size: expected a power of two .* got 3 \(nearest: 2 or 4\)",
        ),
        (np.ones((6, 0, 0, 3), np.float32), "face_size: expected a power of two in 1..2048, got 0"),
    ],
)
def test_from_faces_says_what_is_wrong(faces, message):
    with pytest.raises(ValueError, match=message):
        Environment.from_faces(faces)


@pytest.mark.parametrize(
    ("rotation", "message"),
    [
        (np.eye(4), r"rotation: expected None, degrees about y or a \(3, 3\) array"),
        ("up", r"rotation: expected None, degrees about y or a \(3, 3\) array, got 'up'"),
        (2 * np.eye(3), "rotation: expected orthonormal columns"),
        (np.full((3, 3), np.nan), "rotation: expected orthonormal columns"),
        (float("nan"), "rotation: expected finite degrees about y, got nan"),
    ],
)
def test_rotation_says_what_is_wrong(rotation, message):
    with pytest.raises(ValueError, match=message):
        environments.uniform().rotation = rotation


def test_exposure_says_what_is_wrong():
    with pytest.raises(ValueError, match=r"exposure: expected stops in -64..64, got inf"):
        environments.uniform().exposure = float("inf")


def test_faulty_texels_are_counted():
    faces = np.ones((6, 4, 4, 3), np.float32)
    faces[0, 0, 0] = np.nan
    faces[1, 0, 0, 1] = np.inf
    faces[2, 0, 0, 1] = -2.0
    faces[3, :2, 0] = 1e6
    environment = Environment.from_faces(faces)
    report = environment.texel_report
    assert (report.not_a_number, report.infinite, report.negative, report.above_half) == (1, 1, 1, 2)
    assert report.count == 3
    assert report.largest == 1e6
    assert "half range" not in str(report)
    assert environment.faces[3, 0, 0, 0] == 1e6


def test_lat_long_sun_keeps_its_energy():
    image = np.full((64, 128, 3), 0.1, np.float32)
    image[13, 0] = 40000.0
    expected = lat_long_energy(image)
    for size in (1, 16, 256):
        np.testing.assert_allclose(energy(Environment.from_lat_long(image, size).faces), expected, rtol=1e-5)


def test_sun_above_half_range_is_kept():
    image = np.zeros((128, 256, 3), np.float32)
    image[60, 60] = 1e6
    for face_size in (8, 512):
        environment = Environment.from_lat_long(image, face_size)
        assert environment.texel_report.count == 0
        np.testing.assert_allclose(energy(environment.faces), lat_long_energy(image), rtol=1e-5)
    assert environment.texel_report.above_half > 0


def test_halves_hold_maps_of_any_brightness(rng):
    """The exponent is the twin's, and changes with the map's by as much: texels keep their bits."""
    faces = np.float32(2.0 ** rng.uniform(-12, 12, (6, 8, 8, 3)))
    faces[0, 0, 0] = 0.0
    for spread in (1.0, 2.0**-8, 2.0**-60):  # of one face: held, too faint, and black beside the others
        faces[1] *= np.float32(spread)
        for power in (-90, -40, -20, -10, 0, 4, 10, 40, 90):
            scaled = np.ldexp(faces, power)
            found = Environment.from_faces(scaled).half_range
            assert found.exponent == half_exponent(scaled), (spread, power)
            assert (found.faint_texels > 0) == (spread == 2.0**-8)
            held = hold_in_halves(scaled)
            np.testing.assert_array_equal(np.ldexp(held, -power)[2:], hold_in_halves(faces)[2:])
    assert Environment.from_faces(np.zeros((6, 1, 1, 3), np.float32)).half_range.exponent == 0


def test_light_that_halves_lose_is_counted():
    faces = np.ones((6, 2, 2, 3), np.float32)
    faces[0] = 2.0**20  # halves hold multiples of 2^-20 beside it, over 2^5 of 2^-19
    faces[1] = np.float32(1.5 * 2.0**-19)
    found = Environment.from_faces(faces).half_range
    assert (found.exponent, found.faint_texels) == (5, 4)
    assert found.faint_sphere == pytest.approx(1 / 6)
    light = 2.0**20 + 4 + 1.5 * 2.0**-19
    assert found.lost_light == pytest.approx(0.5 * 2.0**-19 / light)
    assert str(found).startswith("4 texels, 16.6667 % of the sphere, are over 2^30 times darker")
    assert str(Environment.from_faces(np.ones((6, 1, 1, 3), np.float32)).half_range) == ""


@pytest.mark.parametrize("name", ["BrightRingsNanInf.exr", "bad.exr"])
def test_files_with_nan_and_inf_load_and_are_counted(shared_data, name):
    (path,) = (shared_data / "bad-input").rglob(name)
    image = np.ascontiguousarray(images.read_image(path)[..., :3])
    is_nan = np.isnan(image).any(axis=2)
    is_infinite = np.isinf(image).any(axis=2) & ~is_nan
    environment = Environment.from_lat_long(image, 64)
    report = environment.texel_report
    assert (report.not_a_number, report.infinite) == (is_nan.sum(), is_infinite.sum())
    assert is_nan.sum() + is_infinite.sum() > 0
    assert np.isfinite(environment.faces).all()


def write_layout(path, pixels, envmap=None):
    header = {"type": OpenEXR.scanlineimage}
    if envmap is not None:
        header["envmap"] = envmap
    with OpenEXR.File(header, {"RGB": np.ascontiguousarray(pixels)}) as file:
        file.write(str(path))
    return path


def horizontal_cross(faces):
    black = np.zeros_like(faces[0])
    rows = [
        [black, faces[2], black, black],
        [faces[1], faces[4], faces[0], faces[5]],
        [black, faces[3], black, black],
    ]
    return np.concatenate([np.concatenate(row, axis=1) for row in rows])


def vertical_cross(faces):
    black = np.zeros_like(faces[0])
    rows = [
        [black, faces[2], black],
        [faces[1], faces[4], faces[0]],
        [black, faces[3], black],
        [black, faces[5, ::-1, ::-1], black],
    ]
    return np.concatenate([np.concatenate(row, axis=1) for row in rows])


@pytest.mark.parametrize(
    "layout",
    [lambda f: np.concatenate(f), lambda f: np.concatenate(f, axis=1), horizontal_cross, vertical_cross],
    ids=["vertical strip", "horizontal strip", "horizontal cross", "vertical cross"],
)
def test_cube_layouts_give_the_faces_back(tmp_path, layout):
    faces = coloured_faces()
    environment = environment_from_file(write_layout(tmp_path / "cube.exr", layout(faces)))
    np.testing.assert_array_equal(environment.faces, faces)
    assert environment.name == "cube.exr"


def test_crosses_are_seamless_for_a_smooth_light(tmp_path):
    # Neighbours in a cross meet without a jump only if every face is placed and turned right.
    faces = (environments.cube_directions(32) * [0.3, 0.2, 0.4] + 1.0).astype(np.float32)
    cross = horizontal_cross(faces)
    for row, column in ((1, 0), (1, 1), (1, 2)):  # faces left to right
        left = cross[row * 32 : (row + 1) * 32, (column + 1) * 32 - 1]
        right = cross[row * 32 : (row + 1) * 32, (column + 1) * 32]
        assert np.abs(left - right).max() < 0.03
    assert np.abs(np.diff(cross[:, 32:64], axis=0)).max() < 0.03


def test_openexr_cube_faces_look_where_openexr_says(tmp_path):
    # ImfEnvmap: direction -> (column, row) of a face, as proportions of its size.
    rules = [
        (lambda x, y, z: (z, -y)),
        (lambda x, y, z: (-z, -y)),
        (lambda x, y, z: (x, -z)),
        (lambda x, y, z: (x, z)),
        (lambda x, y, z: (-x, -y)),
        (lambda x, y, z: (x, -y)),
    ]
    size = 16
    directions = environments.cube_directions(size)
    stored = np.zeros((6, size, size, 3), np.float32)
    for face, rule in enumerate(rules):
        major = np.abs(directions[face]).max(axis=-1)
        x, y = rule(*np.moveaxis(directions[face] / major[..., None], -1, 0))
        columns = np.rint((x + 1) / 2 * size - 0.5).astype(int)
        rows = np.rint((y + 1) / 2 * size - 0.5).astype(int)
        stored[face, rows, columns] = directions[face] + 2.0
    path = write_layout(tmp_path / "cube.exr", stored.reshape(6 * size, size, 3), OpenEXR.ENVMAP_CUBE)
    np.testing.assert_allclose(environment_from_file(path).faces, directions + 2.0, rtol=1e-6)


def test_face_size_of_files(tmp_path, rng):
    odd = rng.uniform(0.5, 1.5, (6, 24, 24, 3)).astype(np.float32)
    path = write_layout(tmp_path / "odd.exr", np.concatenate(odd))
    environment = environment_from_file(path)
    assert environment.face_size == 32
    assert environment.notes == ["vertical strip with faces of 24 texels resampled by area to 32."]
    np.testing.assert_allclose(energy(environment.faces), energy(odd), rtol=1e-6)
    assert environment_from_file(path, face_size=4).face_size == 4
    with pytest.raises(ValueError, match=r"face_size: expected a power of two in 1..2048, got 24"):
        environment_from_file(path, face_size=24)
    wide = write_layout(tmp_path / "wide.exr", np.ones((50, 100, 3), np.float32))
    assert environment_from_file(wide).face_size == 32
    np.testing.assert_allclose(environment_from_file(wide).faces, 1.0, rtol=1e-6)


@pytest.mark.parametrize("size", [1, 3, 8, 16, 64])
def test_resampled_faces_keep_constants_and_energy(rng, size):
    faces = rng.uniform(0.0, 5.0, (6, 16, 16, 3)).astype(np.float32)
    np.testing.assert_allclose(energy(cube_layout.resample_faces(faces, size)), energy(faces), rtol=1e-5)
    np.testing.assert_allclose(cube_layout.resample_faces(np.ones_like(faces), size), 1.0, rtol=1e-6)


def test_other_shapes_are_refused(tmp_path):
    path = write_layout(tmp_path / "square.exr", np.ones((20, 20, 3), np.float32))
    with pytest.raises(
        FileError, match=r"square\.exr: expected an environment of width:height 2:1 .*, got 20 x 20"
    ):
        environment_from_file(path)


def test_png_environments_load_with_a_warning(tmp_path):
    images.write_png(tmp_path / "sky.png", np.full((16, 32, 3), 0.5, np.float32))
    with pytest.warns(UserWarning, match=r"sky\.png: PNG holds no radiance above 1"):
        environment = Environment.from_file(tmp_path / "sky.png")
    np.testing.assert_allclose(environment.faces, 0.5029, atol=1e-3)
    assert any("PNG" in note for note in environment.notes)


def test_kerner_pair_shows_one_scene(shared_data):
    lat_long = Environment.from_file(shared_data / "environments" / "KernerEnvLatLong.exr").faces.astype(
        float
    )
    cube = Environment.from_file(shared_data / "environments" / "KernerEnvCube.exr").faces.astype(float)
    np.testing.assert_allclose(energy(lat_long), energy(cube), rtol=5e-3)  # measured: 0.2 %
    logs = [np.log(faces.mean(axis=3) + 1e-3) for faces in (lat_long, cube)]
    for face in range(6):
        # Measured 0.994 to 0.99999; a face flipped or swapped stays below 0.9.
        assert np.corrcoef(logs[0][face].ravel(), logs[1][face].ravel())[0, 1] > 0.99
    assert np.sqrt(((logs[0] - logs[1]) ** 2).mean()) < 0.065  # measured: 0.058, 6 % a texel


def test_orientation_map_puts_its_axis_crosses_on_the_face_centres(shared_data):
    # The picture draws dark axes from the middle of each face toward the positive ends of two others: on +Z
    # toward +Y and +X, on +X toward +Y and +Z, as its labels say.
    faces = Environment.from_file(
        shared_data / "environments" / "OrientationLatLong.exr", face_size=256
    ).faces
    dark = faces.mean(axis=3) < 0.6
    toward_positive_u = {
        0: False,
        1: True,
        2: True,
        3: True,
        4: True,
        5: False,
    }  # sign of u of the axis drawn
    for face, is_positive in toward_positive_u.items():
        band = dark[face, 124:133]
        share = [band[:, 138:160].any(axis=0).mean(), band[:, 96:118].any(axis=0).mean()]
        assert (share[0] > 0.9) == is_positive, (face, share)
        assert (share[1] > 0.9) != is_positive, (face, share)


@pytest.mark.parametrize("size", [1, 16, 128])
@pytest.mark.parametrize(
    "make", [environments.sky, environments.studio, environments.spots], ids=lambda f: f.__name__
)
def test_built_in_environments_are_clean_at_any_size(make, size):
    environment = make(face_size=size)
    assert environment.face_size == size
    assert environment.texel_report.count == 0
    assert environment.faces.max() > 0


def test_sky_sun_stands_where_asked_with_its_energy():
    dark = environments.sky((0.0, 0.3, -1.0), sun_radiance=0.0, face_size=256).faces.astype(float)
    lit = environments.sky((0.0, 0.3, -1.0), sun_radiance=20000.0, face_size=256).faces.astype(float)
    sun = (lit - dark)[..., 0] * cube_layout.cube_solid_angles(256)
    assert sun.sum() == pytest.approx(20000 * np.pi * np.radians(0.265) ** 2, rel=0.02)
    toward = (environments.cube_directions(256) * sun[..., None]).sum(axis=(0, 1, 2))
    np.testing.assert_allclose(
        toward / np.linalg.norm(toward), np.array([0, 0.3, -1]) / np.hypot(0.3, 1), atol=1e-3
    )


def test_spots_are_the_same_at_every_size_and_differ_by_seed():
    fine, coarse = environments.spots(3, 256).faces, environments.spots(3, 64).faces
    np.testing.assert_allclose(energy(fine), energy(coarse), rtol=0.03)
    assert 1500 < fine.max() < 5000
    assert not np.array_equal(coarse, environments.spots(4, 64).faces)
    with pytest.raises(ValueError, match=r"contrast: expected 0 < low <= high"):
        environments.spots(contrast=(3.0, 1.0))


def test_public_names_are_there():
    assert burnish.Environment is Environment
    assert Environment.from_file is not None
