"""What lobes of varying roughness reflect of constant light: their exact albedo, brushed ones too."""

import numpy as np
import pytest

import burnish
from burnish.oracle.albedo import blend_albedo
from burnish.oracle.lobe.ggx import GgxLobe
from burnish.oracle.lobe.kurt import KurtLobe
from burnish.oracle.lobe.models import model_of
from engine_support import lookup_error
from textured_quad import write_quad

# Of tables over all roughnesses; G-buffers round slopes to 2^-11.
LIMIT = 5e-3
SIZE, HEIGHT, REACH = 64, 0.06, 15.0
SLOPES = [
    (1.0, 0.1), (1.0, 0.3), (1.0, 0.6), (0.6, 0.06), (0.55, 0.2), (0.5, 0.4),
    (0.3, 0.03), (0.25, 0.1), (0.2, 0.02), (0.1, 0.02), (0.05, 0.02), (0.035, 0.03),
]  # fmt: skip
MODELS = {"kurt": lambda slopes: KurtLobe(slopes, alpha=0.5), "ggx": GgxLobe}
ROUND = [0.02, 0.05, 0.1, 0.17, 0.3, 0.6, 0.8, 1.0]


def pixel_views():
    """Toward the eye above the square, from down to three degrees and all around, as the pixels see it."""
    x = REACH * (2 * np.arange(SIZE) + 1 - SIZE) / SIZE
    views = np.stack([*np.meshgrid(-x, x), np.ones((SIZE, SIZE))], axis=-1)
    return views / np.linalg.norm(views, axis=-1, keepdims=True)


def square(path, slopes, metallic, model):
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
    return write_quad(
        path / "quad.gltf", material, [np.ones((4, 4, 3))], list(material["extensions"]), model=model
    )


def albedo_parts(views, slopes, model):
    lobe = MODELS[model](slopes)
    return model_of(lobe).albedo(views, lobe)


def assert_albedo(device, environment, path, slopes, metallic, model):
    scene = square(path, slopes, metallic, model)
    scene.environment = environment
    camera = burnish.Camera.look_at((0, 0, HEIGHT), (0, 0, 0), vertical_fov=2 * np.arctan(REACH))
    # The sum over the plane of GGX takes so long that it is made for every fourth pixel both ways.
    chosen = np.s_[::4, ::4] if model == "ggx" else np.s_[:, :]
    views = pixel_views()[chosen]
    got = burnish.render(scene, camera, (SIZE, SIZE), burnish.Prefiltered(), device=device).color[chosen]
    parts = albedo_parts(views, slopes, model)
    r0 = 0.04 if metallic == 0 else 1.0
    expected = blend_albedo(parts, r0) / np.maximum(parts[..., :1], 1.0)
    error = np.abs(got / expected - 1)
    worst = np.unravel_index(np.argmax(error[..., 0]), views.shape[:2])
    limit = LIMIT + lookup_error(device, 1.0)
    assert error.max() <= limit, f"view {views[worst]}: {got[worst][0]:.5f}, {expected[worst][0]:.5f}"


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("metallic", [0.0, 1.0], ids=["dielectric", "metal"])
@pytest.mark.parametrize("slopes", SLOPES, ids=str)
def test_brushed_lobe_has_its_own_albedo(device, uniform, slopes, metallic, model, tmp_path):
    assert_albedo(device, uniform, tmp_path, slopes, metallic, model)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("metallic", [0.0, 1.0], ids=["dielectric", "metal"])
@pytest.mark.parametrize("slope", ROUND)
def test_round_lobe_has_its_own_albedo(device, uniform, slope, metallic, model, tmp_path):
    assert_albedo(device, uniform, tmp_path, (slope, slope), metallic, model)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(
    "sampler", [burnish.Matched(30), burnish.Regular(), burnish.Reference(0.005)], ids=str
)
def test_samplers_are_scaled_to_it(device, uniform, sampler, model, tmp_path):
    scene = square(tmp_path, (0.7, 0.1), 1.0, model)
    scene.environment = uniform
    camera = burnish.Camera.look_at((2, 1, 5), (0, 0, 0), vertical_fov=0.3)
    got = burnish.render(scene, camera, (16, 16), sampler, device=device).color[8, 8]
    view = np.array([2.0, 1.0, 5.0]) / 30**0.5
    parts = albedo_parts(view[None], (0.7, 0.1), model)[0]
    expected = parts[0] / max(parts[0], 1.0)
    assert np.abs(got / expected - 1).max() <= (0.01 if isinstance(sampler, burnish.Reference) else LIMIT)
