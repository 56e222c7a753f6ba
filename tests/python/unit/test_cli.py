"""The command line: arguments, messages, exit codes."""

import json
import subprocess
import sys

import numpy as np
import pytest

import burnish
import picture_support as made
from burnish import cli
from burnish.cli import make_parser
from burnish.cli.arguments import parse_size
from burnish.cli.inputs import prepare_scene
from burnish.samplers import sampler_from_text as parse_sampler
from burnish.scenes import find_camera
from textured_quad import write_quad


def run(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "burnish", *map(str, arguments)], capture_output=True, text=True, timeout=240
    )


@pytest.mark.parametrize(("text", "size"), [("540x960", (540, 960)), ("1X2", (1, 2))])
def test_sizes_are_height_then_width(text, size):
    assert parse_size(text) == size


def test_samplers_are_read():
    regular = parse_sampler("regular:30")
    assert isinstance(regular, burnish.Regular) and regular.samples == 30
    published = parse_sampler("regular:19:published")
    assert (published.footprint, published.normalization) == ("published", "published")
    importance = parse_sampler("importance:30:fibonacci")
    assert isinstance(importance, burnish.Importance)
    assert (importance.samples, importance.points) == (30, "fibonacci")
    reference = parse_sampler("reference:0.01")
    assert isinstance(reference, burnish.Reference) and reference.standard_error == pytest.approx(0.01)
    assert parse_sampler("matched:14:diffuse=harmonics").diffuse == "harmonics"
    assert parse_sampler("matched:14").diffuse == "cube"
    assert parse_sampler("regular").samples == parse_sampler("importance").samples == 14


@pytest.mark.parametrize(
    "text",
    ["", "regulr:14", "regular:many", "regular:14:exactly", "importance:5:sobol", "reference:x", "a:b:c:d"],
)
def test_other_samplers_are_refused(text):
    with pytest.raises(ValueError, match=r"^sampler: expected matched"):
        parse_sampler(text)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "the following arguments are required: COMMAND"),
        (["paint"], "invalid choice: 'paint'"),
        (["render", "sphere", "--size", "big"], "expected HEIGHTxWIDTH such as 1080x1920, got 'big'"),
        (["render", "sphere", "--size", "0x5"], "expected HEIGHTxWIDTH"),
        (["render", "sphere", "--filter", "none"], "invalid choice: 'none'"),
        (
            ["render", "nothing"],
            "SCENE: expected a file or one of sphere, spheres, plane, shaderball, got 'nothing'",
        ),
        (["render", "absent.glb"], "absent.glb"),
        (
            ["render", "sphere", "--env", "fog"],
            "--env: expected a file or one of studio, sky, spots, uniform",
        ),
        (["render", "sphere", "--env", "absent.hdr"], "absent.hdr"),
        (
            ["render", "sphere", "--env", "sky", "--env-layer", "key"],
            "--env-part, --env-layer: expected a file as --env beside them, got 'sky'",
        ),
        (["render", "sphere", "--sampler", "magic:3"], "--sampler: expected matched"),
        (
            ["render", "sphere", "--target-error", "0"],
            "expected an error such as 0.02 or 2%, in 0.0001..1, got '0'",
        ),
        (
            ["render", "sphere", "--target-error", "2%", "--sampler", "regular"],
            "expected no --sampler beside it",
        ),
        (["render", "sphere", "--verify"], "--verify: expected a --target-error beside it"),
        (["advise", "sphere", "--report", "absent/a.json"], "expected an existing folder, got absent"),
        (["render", "sphere", "-o", "picture.jpg"], "--output: expected a name ending in .exr or .png"),
        (["render", "sphere", "-o", "absent/a.png"], "expected an existing folder, got absent"),
        (["render", "sphere", "--camera", "7"], "--camera: expected one of"),
        (["render", "sphere", "--face-size", "100"], "100"),
        (["render", "sphere", "--device", "no such device"], "no such device"),
        (["explain", "sphere", "--spp", "0"], "spp: expected an integer in 1..65536, got 0"),
    ],
)
def test_errors_are_one_line_and_exit_code_2(capfd, tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    try:
        code = cli.main(arguments)
    except SystemExit as stop:
        code = stop.code
    out, err = capfd.readouterr()
    assert code == 2
    assert message in err
    assert err.count("\n") == 1 and err.startswith("burnish")
    assert out == ""


@pytest.mark.parametrize("command", ["render", "explain", "advise", "study", "doctor"])
def test_help_has_examples_that_parse(capsys, command):
    with pytest.raises(SystemExit, match="0"):
        make_parser().parse_args([command, "--help"])
    text = capsys.readouterr().out
    examples = [line.split()[1:] for line in text.splitlines() if line.strip().startswith("burnish ")]
    assert examples
    for example in examples:
        assert make_parser().parse_args(example).command == command


def test_version_is_printed():
    result = run("--version")
    assert (result.returncode, result.stdout.strip()) == (0, f"burnish {burnish.__version__}")


def test_a_part_and_a_layer_of_an_environment_are_taken(tmp_path):
    plane = np.ones((4, 8), np.float32)
    layers = {f"{layer}.{color}": plane * (1 + i) for i, layer in enumerate("ab") for color in "RGB"}
    path = tmp_path / "parts.exr"
    path.write_bytes(made.exr_parts(({"name": "one"}, {"Y": plane}), ({"name": "two"}, layers)))
    arguments = ["explain", "sphere", "--env", str(path), "--env-part", "two", "--env-layer", "b"]
    options = make_parser().parse_args(arguments)
    np.testing.assert_allclose(prepare_scene(options).environment.faces, 2.0, rtol=1e-6)


def test_cameras_are_found_by_name_and_index():
    scene = burnish.Scene.sphere(burnish.Material())
    for name in ("front", "1"):
        scene.add_camera(burnish.Camera(np.eye(4), name=name))
    assert find_camera(scene, None) is None
    assert find_camera(scene, "front").name == "front"
    assert find_camera(scene, "0").name == "front"
    assert find_camera(scene, "1").name == "1"
    with pytest.raises(ValueError, match=r"--camera: expected one of 0 \(front\), 1 \(1\), got 'back'"):
        find_camera(scene, "back")


def test_render_writes_what_is_asked_for(tmp_path):
    outputs = [tmp_path / "a.exr", tmp_path / "a.png", tmp_path / "report.json"]
    picture = "render sphere --env studio --face-size 32 --size 36x64 --spp 2 --rotate-env 90 --exposure 1"
    result = run(*picture.split(), "--compare", "-o", outputs[0], "-o", outputs[1], "--report", outputs[2])
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""
    assert "total" in result.stdout and "error against the reference: 0." in result.stdout
    assert burnish.images.read_image(outputs[0]).shape[:2] == (36, 64)
    assert burnish.images.read_image(outputs[1]).shape[:2] == (36, 64)
    report = json.loads(outputs[2].read_text())
    assert report["size"] == [36, 64] and report["spp"] == 2


def test_background_can_be_left_out(tmp_path):
    path = tmp_path / "a.exr"
    result = run(
        "render", "sphere", "--face-size", "16", "--size", "20x40", "-o", path, "--no-background", "-q"
    )
    assert (result.returncode, result.stdout) == (0, "")
    assert (burnish.images.read_image(path)[0, 0, :3] == 0).all()


@pytest.mark.parametrize(("model", "title"), [("ggx", "on:"), ("kurt", "off:")])
def test_model_of_a_files_materials_is_chosen(model, title, tmp_path):
    write_quad(tmp_path / "quad.gltf", {"pbrMetallicRoughness": {"metallicFactor": 0.0}}, [])
    result = run("explain", tmp_path / "quad.gltf", "--face-size", "16", "--model", model)
    assert result.returncode == 0, result.stderr
    blocks = {block.splitlines()[0]: block for block in result.stdout.split("\n\n")}
    assert "layers" in blocks[title]


@pytest.mark.parametrize("scene", ["sphere", "spheres", "plane", "shaderball"])
def test_explain_gives_a_reason_for_every_line(scene):
    result = run("explain", scene, "--face-size", "16")
    assert result.returncode == 0, result.stderr
    blocks = {block.splitlines()[0]: block.splitlines()[1:] for block in result.stdout.split("\n\n")}
    assert {"passes:", "on:", "off:"} <= set(blocks)
    for title in ("passes:", "on:", "off:"):
        for line in blocks[title]:
            assert len(line.split(maxsplit=1)) == 2 or "  " in line.strip(), line
