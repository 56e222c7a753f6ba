"""The clear coat's own normal, its textures, and coats over bases that reflect nothing."""

import numpy as np
import pytest

import burnish
from burnish.oracle.frame import facing_normal
from burnish.oracle.matched import Matched
from burnish.oracle.metallic_roughness import Material, MetallicRoughness, map_metallic_roughness
from burnish.oracle.shading import lobe_through
from burnish.oracle.shading import shade as oracle_shade
from burnish.oracle.tangent_space import mapped_normal
from engine_support import unit
from textured_quad import ALBEDO_LIMIT, LIMIT, is_on, levels_of, middle_color, quantized, write_quad

EXTENSIONS = ["KHR_materials_clearcoat", "KHR_materials_specular"]
UP = np.array([0.0, 0.0, 1.0])
FLAT = np.array([0.5, 0.5, 1.0])
BASE_BUMP = quantized(np.array([0.8, 0.6, 0.85]))
COAT_BUMP = quantized(np.array([0.4, 0.75, 0.9]))
BASE = MetallicRoughness((0.8, 0.5, 0.3), metallic=1.0, roughness=0.6)
COAT = {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.5}
STEEP = unit(np.array([0.55, -0.75, 0.3]))
SAMPLERS = [
    burnish.Importance(),
    burnish.Regular(),
    burnish.Matched(10),
    burnish.Prefiltered(),
    burnish.Reference(method="quadrature"),
]


def coated_square(path, textures, coat=(), **material):
    """A metal under a coat; `textures` are whole pictures of one texel."""
    pbr = {"baseColorFactor": [*BASE.base_color, 1], "metallicFactor": 1.0, "roughnessFactor": 0.6}
    extensions = {"KHR_materials_clearcoat": COAT | dict(coat)} | material.pop("extensions", {})
    material = {"pbrMetallicRoughness": pbr, "doubleSided": True, "extensions": extensions} | material
    return write_quad(path / "quad.gltf", material, [np.tile(t, (4, 4, 1)) for t in textures], EXTENSIONS)


def coat_lobe(weight, perceptual):
    return map_metallic_roughness(
        MetallicRoughness(metallic=0.0, specular=0.0, clearcoat=weight, clearcoat_roughness=perceptual)
    ).lobes[0]


def expected_color(device, environment, sampler, view, layers):
    """Layers of (material, normal) pairs, from the lowest up."""
    levels = levels_of(device, environment, sampler)
    if isinstance(sampler, burnish.Matched):
        # Of textured materials, samples are placed at every point.
        sampler = Matched(sampler.samples, placement="wide point")
    total = np.zeros(3)
    for material, normal in layers:
        tangent = [normal[2], 0.0, -normal[0]]  # round lobes lie in the frame along growing longitude
        if material is not layers[0][0]:
            frame = (np.asarray(v, float) for v in (normal, tangent, view))
            total = total * lobe_through(*frame, material.lobes[0], None)
        total = total + oracle_shade(levels, material, sampler, normal, tangent, view)
    return total


def assert_shows(device, environment, scene, sampler, view, layers):
    got, frame = middle_color(device, scene, environment, sampler, view)
    expected = expected_color(device, environment, sampler, view, layers)
    limit = LIMIT if isinstance(sampler, burnish.Importance) else ALBEDO_LIMIT
    np.testing.assert_allclose(got, expected, rtol=0, atol=limit * expected.mean())
    return frame


BASE_LAYER = map_metallic_roughness(BASE)
COAT_LAYER = Material(lobes=[coat_lobe(0.8, 0.5)])


@pytest.mark.parametrize("sampler", SAMPLERS, ids=str)
@pytest.mark.parametrize("side", [1.0, -1.0], ids=["front", "back"])
def test_coat_keeps_the_meshs_normal_over_a_normal_map(device, smooth64, sampler, side, tmp_path):
    scene = coated_square(tmp_path, [BASE_BUMP], normalTexture={"index": 0})
    bent = side * mapped_normal(UP, [1, 0, 0, 1], BASE_BUMP)
    layers = [(BASE_LAYER, bent), (COAT_LAYER, side * UP)]
    frame = assert_shows(device, smooth64, scene, sampler, side * UP, layers)
    assert is_on(frame, "clear coat normal") and not is_on(frame, "clear coat normal mapping")
    np.testing.assert_allclose(frame.normal[4, 4], bent, atol=4e-4)


@pytest.mark.parametrize("sampler", SAMPLERS, ids=str)
@pytest.mark.parametrize("side", [1.0, -1.0], ids=["front", "back"])
def test_coats_normal_map_bends_the_coat_alone(device, smooth64, sampler, side, tmp_path):
    coat = {"clearcoatNormalTexture": {"index": 0, "scale": 0.6}}
    scene = coated_square(tmp_path, [COAT_BUMP], coat)
    assert scene.warnings == []
    bent = side * mapped_normal(UP, [1, 0, 0, 1], COAT_BUMP, 0.6)
    layers = [(BASE_LAYER, side * UP), (COAT_LAYER, bent)]
    frame = assert_shows(device, smooth64, scene, sampler, side * UP, layers)
    assert is_on(frame, "clear coat normal") and is_on(frame, "clear coat normal mapping")
    np.testing.assert_allclose(frame.normal[4, 4], side * UP, atol=1e-4)


def test_base_and_coat_have_a_normal_map_each(device, smooth64, tmp_path):
    coat = {"clearcoatNormalTexture": {"index": 1}}
    scene = coated_square(tmp_path, [BASE_BUMP, COAT_BUMP], coat, normalTexture={"index": 0, "scale": 0.5})
    frame = [1, 0, 0, 1]
    layers = [
        (BASE_LAYER, mapped_normal(UP, frame, BASE_BUMP, 0.5)),
        (COAT_LAYER, mapped_normal(UP, frame, COAT_BUMP)),
    ]
    assert_shows(device, smooth64, scene, burnish.Importance(), UP, layers)


def test_coat_without_normal_maps_shares_the_bases_normal(device, smooth64, tmp_path):
    scene = coated_square(tmp_path, [FLAT], {"clearcoatTexture": {"index": 0}})
    _, frame = middle_color(device, scene, smooth64, burnish.Importance(), UP)
    assert not is_on(frame, "clear coat normal")


def test_coat_turned_away_just_faces_the_eye(device, smooth64, tmp_path):
    """As the base's normals do: never black, never behind the surface."""
    texel = quantized(np.array([0.9, 0.5, 0.55]))
    scene = coated_square(tmp_path, [texel], {"clearcoatNormalTexture": {"index": 0}})
    view = unit(np.array([-0.9, 0.0, 0.45]))
    normal = mapped_normal(UP, [1, 0, 0, 1], texel)
    assert normal @ view < -0.1
    layers = [(BASE_LAYER, UP), (COAT_LAYER, facing_normal(normal, view))]
    assert_shows(device, smooth64, scene, burnish.Importance(), view, layers)


@pytest.mark.parametrize("sampler", SAMPLERS, ids=str)
@pytest.mark.parametrize("view", [UP, STEEP], ids=["above", "steep"])
def test_coat_shows_over_a_base_without_specular(device, smooth64, sampler, view, tmp_path):
    """A base that reflects nothing has no lobe; the coat does not take its place in the G-buffer."""
    pbr = {"baseColorFactor": [0.3, 0.5, 0.7, 1], "metallicFactor": 0.0}
    extensions = {"KHR_materials_specular": {"specularFactor": 0.0}}
    texture = {"occlusionTexture": {"index": 0}}
    scene = coated_square(tmp_path, [np.ones(3)], pbrMetallicRoughness=pbr, extensions=extensions, **texture)
    layer = Material(np.array([0.3, 0.5, 0.7]), COAT_LAYER.lobes, covers=((None, True),))
    frame = assert_shows(device, smooth64, scene, sampler, view, [(layer, UP)])
    assert is_on(frame, "lobe") and not is_on(frame, "lobe 2")


@pytest.mark.parametrize("view", [UP, STEEP], ids=["above", "steep"])
def test_coats_textures_scale_all_of_it(device, smooth64, view, tmp_path):
    """Weight from red, at grazing as well; roughness from green."""
    texel = quantized(np.array([0.4, 0.7, 0.1]))
    textures = {"clearcoatTexture": {"index": 0}, "clearcoatRoughnessTexture": {"index": 0}}
    scene = coated_square(tmp_path, [texel], textures)
    coat = Material(lobes=[coat_lobe(0.8 * texel[0], 0.5 * texel[1])])
    layers = [(BASE_LAYER, UP), (coat, UP)]
    for sampler in (burnish.Importance(), burnish.Prefiltered()):
        assert_shows(device, smooth64, scene, sampler, view, layers)
    bare = Material(lobes=[coat_lobe(0.8, 0.5 * texel[1])])
    args = (device, smooth64, burnish.Importance(), view)
    without, full = expected_color(*args, layers[:1]), expected_color(*args, [layers[0], (bare, UP)])
    assert np.all(full - without > 4 * LIMIT * full.mean())  # the coat is no trifle in what was compared
