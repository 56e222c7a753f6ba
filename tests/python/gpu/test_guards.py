"""Nothing that is not finite leaves a frame: the report says how many became black, where, in which pass."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import burnish

# Of the lobe: with the light of `bright` it is more than float32 holds, alone it is not.
OVERFLOWS = 1e36
SAMPLERS = [
    burnish.Regular(5),
    burnish.Importance(5),
    burnish.Matched(5),
    burnish.Prefiltered(),
    burnish.Reference(method="quadrature"),
]


@pytest.fixture
def bright():
    return burnish.Environment.from_faces(np.full((6, 16, 16, 3), 2e3, np.float32))


def overflowing():
    return burnish.Material(lobes=[burnish.KurtLobe(roughness=0.1, weight=OVERFLOWS)])


def pass_of(sampler):
    return "reference" if isinstance(sampler, burnish.Reference) else "shade"


@pytest.mark.parametrize("sampler", SAMPLERS, ids=repr)
def test_guard_counts_points_and_names_the_first(bright, sampler, device):
    faces = bright.faces.copy()
    faces[5] = 0  # -z: nothing is stopped where points look there
    normals = np.float32([[0, 0, -1]] * 2 + [[0, 0, 1]] * 3)
    tangents = np.float32([[1, 0, 0]] * 5)
    environment = burnish.Environment.from_faces(faces)
    arguments = (environment, overflowing(), sampler, normals, tangents, normals)
    text = f"pass {pass_of(sampler)}: 3 values were not finite and became black, the first at point 2"
    with pytest.warns(RuntimeWarning, match=text):
        radiance = burnish.shade(*arguments, device=device)
    assert np.isfinite(radiance).all() and not radiance[2:].any()
    with pytest.raises(FloatingPointError, match=text):
        burnish.shade(*arguments, device=device, strict=True)


@pytest.mark.parametrize("sampler", SAMPLERS, ids=repr)
def test_guard_counts_pixels_and_names_the_first(bright, sampler, device):
    scene = burnish.Scene.sphere(overflowing())
    scene.environment = bright
    frame = burnish.render(scene, size=(20, 24), sampler=sampler, device=device)
    covered = frame.alpha > 0
    assert np.isfinite(frame.color).all() and not frame.color[covered].any()
    [stopped] = frame.report.stopped
    assert stopped["pass"] == pass_of(sampler) and tuple(stopped["first"]) == tuple(np.argwhere(covered)[0])
    assert stopped["count"] == frame.report.non_finite == covered.sum()
    assert any("the first at row" in warning for warning in frame.report.warnings)
    with pytest.raises(FloatingPointError, match=f"pass {pass_of(sampler)}: {covered.sum()} values"):
        burnish.render(scene, size=(20, 24), sampler=sampler, device=device, strict=True)


@pytest.mark.parametrize("spp", [1, 4])
def test_guard_counts_in_display_output(bright, device, spp):
    scene = burnish.Scene.sphere(overflowing())
    scene.environment = bright
    arguments = {"size": (20, 24), "sampler": burnish.Regular(5), "device": device, "spp": spp}
    linear = burnish.render(scene, **arguments)
    frame = burnish.render(scene, output="display", **arguments)
    assert frame.report.stopped == linear.report.stopped
    assert not frame.display[10, 12, :3].any() and frame.display[10, 12, 3] == 255


def test_finite_values_whose_sum_overflows_are_not_stopped(bright, device):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.1, weight=1e35)]))
    scene.environment = bright
    frame = burnish.render(scene, size=(20, 24), sampler=burnish.Matched(5), device=device, strict=True)
    middle = frame.color[10, 12, :3].astype(np.float64)
    assert 1.5e38 < middle.min() and middle.sum() > np.finfo(np.float32).max
    assert frame.report.stopped == []
    assert any("drawn twice" in warning for warning in frame.report.warnings)


def test_finite_pictures_stop_nothing_in_strict_mode(bright, device):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = bright
    frame = burnish.render(scene, size=(16, 16), sampler=burnish.Regular(5), device=device, strict=True)
    assert frame.report.stopped == [] and frame.report.non_finite == 0


@pytest.fixture
def overflowing_background(tmp_path, monkeypatch):
    """A device whose background overflows, which no map can make it do."""
    compiler = shutil.which("glslangValidator")
    if compiler is None:
        pytest.skip("glslangValidator is not installed")
    glsl = Path(__file__).parents[3] / "glsl"
    source = (glsl / "shade/background.comp.glsl").read_text()
    assert source.count("map.radiance_scale") == 1
    (tmp_path / "naive.comp").write_text(source.replace("map.radiance_scale", "1e38 * 1e38"))
    output = tmp_path / "shade_background_comp.spv"
    command = [compiler, "-V", "--quiet", "--target-env", "vulkan1.3", f"-I{glsl}", "-o", output]
    subprocess.run([*command, tmp_path / "naive.comp"], check=True)
    monkeypatch.setenv("BURNISH_SPIRV_DIR", str(tmp_path))
    return burnish.Device()


def test_every_pass_that_stopped_something_is_counted_and_named(bright, overflowing_background):
    scene = burnish.Scene.sphere(overflowing())
    scene.environment = bright
    arguments = {"size": (20, 24), "sampler": burnish.Regular(5), "device": overflowing_background}
    frame = burnish.render(scene, **arguments)
    covered = frame.alpha > 0
    assert not frame.color.any()
    shade, background = frame.report.stopped
    assert (shade["pass"], shade["count"]) == ("shade", covered.sum())
    assert (background["pass"], background["count"]) == ("background", (~covered).sum())
    assert tuple(background["first"]) == tuple(np.argwhere(~covered)[0])
    text = rf"pass shade: {covered.sum()} values .*; pass background: {(~covered).sum()} values"
    with pytest.raises(FloatingPointError, match=text):
        burnish.render(scene, strict=True, **arguments)


def test_guard_stops_and_counts_in_each_of_many_pictures(bright, device):
    scene = burnish.Scene.sphere(overflowing())
    scene.environment = bright
    one, four = (
        burnish.render(scene, size=(20, 24), sampler=burnish.Regular(5), spp=spp, device=device)
        for spp in (1, 4)
    )
    assert np.isfinite(four.color).all() and not four.color[10, 12].any()
    [stopped] = four.report.stopped
    assert 3 * one.report.non_finite < stopped["count"] < 5 * one.report.non_finite
