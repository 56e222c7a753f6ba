"""The public names and signatures that code outside this repository relies on."""

import inspect

import numpy as np
import pytest

import burnish


def defaults(function):
    return {
        name: parameter.default
        for name, parameter in inspect.signature(function).parameters.items()
        if parameter.default is not inspect.Parameter.empty
    }


def names(function):
    return [name for name in inspect.signature(function).parameters if name != "self"]


def test_all_public_names_exist():
    for name in burnish.__all__:
        assert getattr(burnish, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = burnish.nonsense


def test_render_takes_the_documented_arguments():
    assert names(burnish.render) == [
        "scene",
        "camera",
        "size",
        "sampler",
        "device",
        "spp",
        "filter",
        "progress",
        "target_error",
        "verify",
        "error_estimate",
        "strict",
        "output",
        "display_exposure",
    ]
    assert defaults(burnish.render)["size"] == (540, 960)
    assert defaults(burnish.render)["filter"] == "gauss6"
    assert defaults(burnish.render)["spp"] == 1
    assert defaults(burnish.render)["target_error"] is None


def test_advise_takes_the_documented_arguments():
    assert names(burnish.advise)[:3] == ["scene", "target_error", "size"]
    assert defaults(burnish.advise)["target_error"] == pytest.approx(0.02)


def test_shade_takes_the_documented_arguments():
    expected = ["env", "material", "sampler", "normals", "tangents", "views", "filter", "device", "strict"]
    assert names(burnish.shade) == [*expected, "report", "positions", "scene"]
    assert defaults(burnish.shade) == {
        "filter": "gauss6",
        "device": None,
        "strict": False,
        "report": False,
        "positions": None,
        "scene": None,
    }


def test_capture_takes_the_documented_arguments():
    assert names(burnish.Scene.capture) == ["point", "object", "face_size", "device"]
    assert defaults(burnish.Scene.capture)["face_size"] == 256


def test_samplers_have_the_documented_defaults():
    regular = burnish.Regular()
    assert (regular.samples, regular.footprint, regular.normalization) == (14, "exact", "furnace")
    assert regular.threshold == pytest.approx(0.2)
    assert regular.mip_bias == 0.0
    importance = burnish.Importance()
    assert (importance.samples, importance.points, importance.mip_bias) == (14, "hammersley", 0.0)
    assert burnish.Reference().standard_error == pytest.approx(0.002)
    burnish.Regular(14, threshold=0.1, footprint="published", normalization="projected", mip_bias=1.0)
    burnish.Importance(samples=30, points="fibonacci", mip_bias=-0.5)


def test_studies_take_the_documented_arguments():
    assert names(burnish.study.accuracy)[:3] == ["scene_or_points", "samplers", "reference"]
    assert defaults(burnish.study.accuracy)["reference"] is None
    for name in ("pareto", "plot", "save_html", "save_json", "save_csv", "load_json"):
        assert callable(getattr(burnish.study.Study, name))
    assert [names(getattr(burnish.study.Study, name))[0] for name in ("plot", "save_html", "save_json")] == [
        "path"
    ] * 3
    assert burnish.study.Study([]).rows == []


def test_lobes_and_materials_are_made_as_documented():
    lobe = burnish.KurtLobe(roughness=(0.2, 0.075), r0=1.0, alpha=0.0, weight=(1, 1, 1), rotation=0.0)
    assert lobe.roughness == pytest.approx((0.2, 0.075))
    material = burnish.Material(diffuse=(0, 0, 0), lobes=[lobe])
    assert len(material.lobes) == 1


def test_environments_are_made_as_documented(rng):
    faces = rng.random((6, 4, 4, 3), np.float32)
    env = burnish.Environment.from_faces(faces)
    np.testing.assert_array_equal(env.faces, faces)
    assert burnish.Environment.from_lat_long(np.ones((8, 16, 3), np.float32), face_size=4).face_size == 4
    expected = ["path", "face_size", "exposure", "rotation", "part", "layer"]
    assert names(burnish.Environment.from_file) == expected
    for read in (burnish.images.read_image, burnish.images.read_picture, burnish.images.read_exr):
        assert names(read) == ["path", "part", "layer"]
    assert defaults(burnish.Environment.pyramid)["filter"] == "gauss6"


def test_the_pattern_has_the_published_count():
    assert burnish.sample_pattern(0.1, spacing="s1", circles=3, threshold=0.1).shape == (19, 3)
    assert burnish.sample_pattern((0.1, 0.1), "s2", 3, 0.1).shape == (30, 3)


def test_errors_have_the_documented_bases():
    assert issubclass(burnish.VulkanError, RuntimeError)
    assert issubclass(burnish.FileError, OSError)


def test_a_frame_has_the_documented_shapes(device):
    scene = burnish.Scene.sphere(burnish.Material(diffuse=(0.5, 0.5, 0.5), lobes=[burnish.KurtLobe()]))
    scene.environment = burnish.Environment.from_faces(np.ones((6, 8, 8, 3), np.float32))
    frame = burnish.render(scene, camera=None, size=(24, 40), sampler=burnish.Regular(), device=device, spp=1)
    assert frame.color.shape == (24, 40, 3) and frame.color.dtype == np.float32
    assert frame.alpha.shape == frame.depth.shape == (24, 40)
    assert frame.normal.shape == (24, 40, 3)
    assert 0.0 < frame.alpha.mean() < 1.0
    assert frame.report.passes and all(entry["milliseconds"] >= 0 for entry in frame.report.passes)
    assert frame.report.effects and all(entry["reason"] for entry in frame.report.effects)
    assert frame.report.non_finite == 0
    assert frame.report.samples_used


def test_a_device_says_what_it_is(device):
    assert device.name and device.driver
    assert isinstance(device.is_software, bool)
    assert device.limits["max_image_dimension_2d"] >= 4096
