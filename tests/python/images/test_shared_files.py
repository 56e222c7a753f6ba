"""Every scene and environment of the shared data renders: finite, lit, not flat, no validation message."""

from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish import environments

SHARED = Path(__file__).parents[4] / "shared" / "data"
SCENES = sorted(p for p in SHARED.glob("scenes/*/*") if p.suffix in {".glb", ".gltf"})
ENVIRONMENTS = sorted(p for p in SHARED.glob("environments/*") if p.suffix in {".hdr", ".exr"})

if not SCENES:
    pytest.skip("the shared data is not beside the repository", allow_module_level=True)


def _check(frame):
    assert np.isfinite(frame.color).all() and frame.report.non_finite == 0
    assert frame.color.min() >= 0
    assert frame.color.max() > 0
    assert frame.color.reshape(-1, 3).std(axis=0).max() > 1e-3, "the picture is flat"


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.parent.name)
def test_scene_renders(device, path):
    scene = burnish.Scene.from_file(path)
    scene.environment = environments.sky(face_size=64)
    frame = burnish.render(scene, size=(90, 120), device=device)
    _check(frame)
    assert frame.alpha.max() == 1, "no object is seen"
    lit = frame.color[frame.alpha > 0]
    assert (lit.sum(axis=-1) > 0).mean() > 0.9, "most of the object is black"
    assert np.isfinite(frame.depth[frame.alpha > 0]).all()


@pytest.mark.parametrize("path", ENVIRONMENTS, ids=lambda path: path.name)
def test_environment_lights_a_sphere(device, path):
    scene = burnish.Scene.sphere(burnish.Material(diffuse=0.3, lobes=[burnish.KurtLobe(roughness=0.1)]))
    scene.environment = burnish.Environment.from_file(path, face_size=128)
    _check(burnish.render(scene, size=(90, 120), device=device))
