"""Arguments of `shade`, `render` and `capture` are checked before any device is asked for."""

from types import SimpleNamespace

import numpy as np
import pytest

import burnish
from burnish import rendering
from burnish.samplers import DEFAULT_SAMPLER, sampler_to_text

UP = np.array([[0, 0, 1]] * 4, np.float32)


@pytest.fixture
def env():
    return burnish.Environment.from_faces(np.ones((6, 4, 4, 3), np.float32))


@pytest.fixture
def material():
    return burnish.Material(lobes=[burnish.KurtLobe()])


@pytest.mark.parametrize(
    ("normals", "message"),
    [
        (UP.astype(np.float64), r"normals: expected C-contiguous float32 of shape \(n, 3\), got float64"),
        (UP[:, :2], r"normals: expected .* of shape \(n, 3\), got shape \(4, 2\)"),
        (UP[0], r"normals: expected .*, got shape \(3,\)"),
        (np.asfortranarray(UP), r"normals: expected .*, got non-contiguous float32 of shape \(4, 3\)"),
        (UP.tolist(), "normals: expected .*, got list"),
        (
            np.where(np.arange(4)[:, None] == 2, np.float32(np.nan), UP),
            "normals: expected finite .* in row 2",
        ),
    ],
)
def test_shade_refuses_arrays_it_would_have_to_convert(env, material, normals, message):
    with pytest.raises(ValueError, match=message):
        burnish.shade(env, material, burnish.Regular(), normals, UP, UP)


@pytest.mark.parametrize("position", ["tangents", "views"])
def test_shade_wants_as_many_tangents_and_views_as_normals(env, material, position):
    arrays = {"tangents": UP, "views": UP, position: UP[:3]}
    with pytest.raises(ValueError, match=rf"{position}: expected .* of shape \(4, 3\), got shape \(3, 3\)"):
        burnish.shade(env, material, burnish.Regular(), UP, **arrays)


def test_shade_refuses_unknown_filters(env, material):
    with pytest.raises(ValueError, match="filter: expected one of box, gauss4, gauss6, got 'gauss8'"):
        burnish.shade(env, material, burnish.Regular(), UP, UP, UP, filter="gauss8")


def test_shade_of_no_points_needs_no_device(env, material, monkeypatch):
    monkeypatch.setattr("burnish.rendering.default_device", lambda: pytest.fail("asked for a device"))
    nothing = np.zeros((0, 3), np.float32)
    assert burnish.shade(env, material, burnish.Regular(), nothing, nothing, nothing).shape == (0, 3)


@pytest.mark.parametrize("size", [(0, 10), (10, 20000), (10,), (1.5, 2), "ab", 7, (10, -1)])
def test_render_refuses_odd_sizes(material, size):
    with pytest.raises(ValueError, match=r"size: expected \(height, width\), integers in 1\.\.16384, got"):
        burnish.render(burnish.Scene.sphere(material), size=size)


@pytest.mark.parametrize("spp", [0, -1, 1.5, True, 65537, "4"])
def test_render_refuses_odd_spp(material, spp):
    with pytest.raises(ValueError, match=r"spp: expected an integer in 1\.\.65536, got"):
        burnish.render(burnish.Scene.sphere(material), spp=spp)


def test_capture_needs_a_point_or_an_object(material):
    scene = burnish.Scene.sphere(material)
    with pytest.raises(ValueError, match="capture: expected a point, an object, or both, got neither"):
        scene.capture()
    with pytest.raises(ValueError, match="point: expected three finite numbers"):
        scene.capture(point=(0, np.nan, 0))
    with pytest.raises(ValueError, match="object: expected a name or an index below 1, got 3"):
        scene.capture(object=3)
    with pytest.raises(ValueError, match="nobody"):
        scene.capture(object="nobody")


def test_capture_of_an_object_looks_out_from_its_centroid(material, monkeypatch):
    scene = burnish.Scene()
    half = np.diag([2.0, 2.0, 2.0, 1.0])
    half[:3, 3] = (1, 2, 3)
    # Two triangles of area 1 and 3: the centroid leans to the larger one, the box's middle does not.
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [-3, 0, 0]], np.float32)
    mesh = burnish.Mesh(positions, np.array([[0, 1, 2], [0, 2, 3]], np.uint32))
    scene.add(burnish.Mesh.sphere(), material, name="other")
    scene.add(mesh, material, half, "kite")
    seen = []
    monkeypatch.setattr("burnish._core.capture", lambda *arguments: seen.append(arguments))
    scene.capture(object="kite", device=object())
    _, _, point, face_size, index = seen[0]
    assert (face_size, index) == (256, 1)
    middle = (1.0 * np.array([1 / 3, 2 / 3, 0]) + 3.0 * np.array([-1, 2 / 3, 0])) / 4.0
    np.testing.assert_allclose(point, 2.0 * middle + (1, 2, 3), rtol=1e-6)


def test_the_default_device_is_opened_once(monkeypatch):
    from concurrent.futures import ThreadPoolExecutor

    from burnish import _device

    opened = []
    monkeypatch.setattr(_device, "_device", None)
    monkeypatch.setattr(_device, "Device", lambda: opened.append(1) or SimpleNamespace(is_lost=False))
    with ThreadPoolExecutor(8) as pool:
        found = {id(one) for one in pool.map(lambda _: _device.default_device(), range(64))}
    assert len(found) == len(opened) == 1


def test_render_takes_the_scenes_first_camera(material, monkeypatch):
    scene = burnish.Scene.sphere(material)
    for name in ("first", "second"):
        scene.add_camera(burnish.Camera(np.eye(4), name=name))

    class SeenError(Exception):
        pass

    def record(device, scene, camera, *others):
        raise SeenError(camera.name)

    monkeypatch.setattr("burnish._core.render", record)
    with pytest.raises(SeenError, match="first"):
        burnish.render(scene, device=object())
    with pytest.raises(SeenError, match="second"):
        burnish.render(scene, scene.cameras[1], device=object())


def test_matched_is_the_default_of_python_and_of_the_command_line():
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe()]))
    scene.environment = burnish.environments.uniform()
    default = sampler_to_text(burnish.Matched())
    assert default == "matched:14" == DEFAULT_SAMPLER
    assert rendering.plan(scene) == rendering.plan(scene, burnish.Matched())
    assert rendering.plan(scene) != rendering.plan(scene, burnish.Regular())
