"""What lobes of varying roughness reflect of constant light: their exact albedo, brushed ones too."""

import numpy as np
import pytest

import burnish
from burnish.oracle.albedo import blend_albedo, directional_albedo
from engine_support import lookup_error
from textured_quad import write_quad

# Of tables over all roughnesses; G-buffers round slopes to 2^-11.
LIMIT = 5e-3
SIZE, HEIGHT, REACH = 64, 0.06, 15.0
SLOPES = [
    (1.0, 0.1), (1.0, 0.3), (1.0, 0.6), (0.6, 0.06), (0.55, 0.2), (0.5, 0.4),
    (0.3, 0.03), (0.25, 0.1), (0.2, 0.02), (0.1, 0.02), (0.05, 0.02), (0.035, 0.03),
]  # fmt: skip
ROUND = [0.02, 0.05, 0.1, 0.17, 0.3, 0.6, 0.8, 1.0]


def pixel_views():
    """Toward the eye above the square, from down to three degrees and all around, as the pixels see it."""
    x = REACH * (2 * np.arange(SIZE) + 1 - SIZE) / SIZE
    views = np.stack([*np.meshgrid(-x, x), np.ones((SIZE, SIZE))], axis=-1)
    return views / np.linalg.norm(views, axis=-1, keepdims=True)


def square(path, slopes, metallic):
    """A square whose roughness a white texture makes vary; black without metal: lobes show alone."""
    mx, my = slopes
    strength = np.sqrt((mx - my) / (1 - my)) if mx > my else 0.0
    pbr = {
        "baseColorFactor": [metallic] * 3 + [1],
        "metallicFactor": metallic,
        "roughnessFactor": my**0.5,
        "metallicRoughnessTexture": {"index": 0},
    }
    extension = {"KHR_materials_anisotropy": {"anisotropyStrength": float(strength)}}
    material = {"pbrMetallicRoughness": pbr, "extensions": extension if strength > 0 else {}}
    return write_quad(path / "quad.gltf", material, [np.ones((4, 4, 3))], list(material["extensions"]))


def assert_albedo(device, environment, path, slopes, metallic):
    scene = square(path, slopes, metallic)
    scene.environment = environment
    camera = burnish.Camera.look_at((0, 0, HEIGHT), (0, 0, 0), vertical_fov=2 * np.arctan(REACH))
    got = burnish.render(scene, camera, (SIZE, SIZE), burnish.Prefiltered(), device=device).color
    parts = directional_albedo(pixel_views(), slopes, 0.5)
    r0 = 0.04 if metallic == 0 else 1.0
    expected = blend_albedo(parts, r0) / np.maximum(parts[..., :1], 1.0)
    error = np.abs(got / expected - 1)
    worst = np.unravel_index(np.argmax(error[..., 0]), (SIZE, SIZE))
    limit = LIMIT + lookup_error(device, 1.0)
    assert error.max() <= limit, f"view {pixel_views()[worst]}: {got[worst][0]:.5f}, {expected[worst][0]:.5f}"


@pytest.mark.parametrize("metallic", [0.0, 1.0], ids=["dielectric", "metal"])
@pytest.mark.parametrize("slopes", SLOPES, ids=str)
def test_brushed_lobe_has_its_own_albedo(device, uniform, slopes, metallic, tmp_path):
    assert_albedo(device, uniform, tmp_path, slopes, metallic)


@pytest.mark.parametrize("metallic", [0.0, 1.0], ids=["dielectric", "metal"])
@pytest.mark.parametrize("slope", ROUND)
def test_round_lobe_has_its_own_albedo(device, uniform, slope, metallic, tmp_path):
    assert_albedo(device, uniform, tmp_path, (slope, slope), metallic)


@pytest.mark.parametrize(
    "sampler", [burnish.Matched(30), burnish.Regular(), burnish.Reference(0.005)], ids=str
)
def test_samplers_are_scaled_to_it(device, uniform, sampler, tmp_path):
    scene = square(tmp_path, (0.7, 0.1), 1.0)
    scene.environment = uniform
    camera = burnish.Camera.look_at((2, 1, 5), (0, 0, 0), vertical_fov=0.3)
    got = burnish.render(scene, camera, (16, 16), sampler, device=device).color[8, 8]
    view = np.array([2.0, 1.0, 5.0]) / 30**0.5
    parts = directional_albedo(view, (0.7, 0.1), 0.5)
    expected = parts[0] / max(parts[0], 1.0)
    assert np.abs(got / expected - 1).max() <= (0.01 if isinstance(sampler, burnish.Reference) else LIMIT)
