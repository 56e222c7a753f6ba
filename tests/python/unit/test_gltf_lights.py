"""KHR_lights_punctual: what a file says of lights, and what a scene has then."""

import numpy as np
import pytest

import burnish
from gltf_support import GltfFile


def load(tmp_path, lights, **node):
    file = GltfFile()
    nodes = [{"extensions": {"KHR_lights_punctual": {"light": k}}, **node} for k in range(len(lights))]
    nodes.append({"mesh": file.square()})
    file.document |= {
        "nodes": nodes,
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": lights}},
    }
    return burnish.Scene.from_file(file.write(tmp_path / "scene.gltf"))


def test_lights_are_read(tmp_path):
    """They shine along the node's -z, wherever that points, and its scale changes nothing."""
    lights = [
        {"type": "point", "intensity": 4, "color": [1, 0.5, 0.25], "range": 7},
        {"type": "directional", "intensity": 2},
        {"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
        {"type": "spot", "spot": {}},
    ]
    half = 0.5**0.5
    scene = load(tmp_path, lights, translation=[1, 2, 3], rotation=[0, half, 0, half], scale=[5, 5, 5])
    assert scene.warnings == [] and scene.ignored_extensions == []
    point, far, spot, plain = scene.lights
    assert point.position == (1, 2, 3) and point.intensity == (4, 2, 1) and point.range == 7
    assert far.irradiance == (2, 2, 2) and far.angle == 0
    for light in (far, spot):
        np.testing.assert_allclose(light.direction / np.linalg.norm(light.direction), (-1, 0, 0), atol=1e-6)
    assert spot.position == (1, 2, 3) and (spot.inner_angle, spot.outer_angle) == (0.25, 0.5)
    assert plain.range is None and plain.inner_angle == 0
    assert plain.outer_angle == pytest.approx(np.pi / 4)


@pytest.mark.parametrize(
    "light, text",
    [
        ({"type": "area"}, 'type: expected directional, point or spot, got "area"'),
        ({"type": "point", "range": -1}, "range: expected a finite number above"),
        ({"type": "point", "intensity": -1}, "intensity: expected finite numbers >= 0, got -1"),
        ({"type": "spot", "spot": {"outerConeAngle": 2}}, "outer_angle: expected radians"),
    ],
)
def test_lights_that_make_no_sense_are_left_out(tmp_path, light, text):
    scene = load(tmp_path, [light, {"type": "point"}])
    assert len(scene.lights) == 1
    (warning,) = scene.warnings
    assert warning.startswith("nodes[0]'s light: left out: ") and text in warning


@pytest.mark.parametrize(
    "lights, node, text",
    [
        ([{"type": "point"}], {"light": 1}, "light: expected an index below 1 lights, got 1"),
        ([{"type": "point"}], {}, "light: expected a value, got none"),
        ([{"intensity": 1}], {"light": 0}, "type: expected a value, got none"),
        ([{"type": "point", "intensity": "x"}], {"light": 0}, "intensity: expected a finite number"),
        ([{"type": "spot"}], {"light": 0}, "[Ss]pot"),
    ],
)
def test_broken_lights_are_refused(tmp_path, lights, node, text):
    with pytest.raises(burnish.FileError, match=text):
        load(tmp_path, lights, extensions={"KHR_lights_punctual": node})
