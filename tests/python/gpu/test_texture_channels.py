"""Each texture's channels and factors: one texel of four different numbers, seen from above and steeply."""

from dataclasses import replace

import numpy as np
import pytest

import burnish
from burnish.oracle.metallic_roughness import MetallicRoughness, map_metallic_roughness
from burnish.oracle.shading import shade as oracle_shade
from engine_support import unit
from textured_quad import (
    LIMIT,
    assert_close,
    expected_colors,
    levels_of,
    middle_color,
    quantized,
    srgb_to_linear,
    texel_colors,
    write_quad,
)

UP, STEEP = np.array([0.0, 0.0, 1.0]), unit(np.array([0.6, -0.8, 0.1]))
TEXEL = quantized(np.array([0.85, 0.7, 0.4, 0.6]))
RED, GREEN, BLUE, ALPHA = TEXEL
SOURCE = MetallicRoughness((0.7, 0.5, 0.3), 0.5, 0.8, ior=1.8, specular=0.7, specular_color=(1.0, 0.8, 0.5))
EMISSIVE = np.array([0.3, 0.2, 0.4])
# What the texture changes: the source's fields, the share of diffuse light that is left, emitted light.
KINDS = {
    "": ({}, 1.0, 1.0),
    "baseColorTexture": ({"base_color": srgb_to_linear(TEXEL[:3]) * SOURCE.base_color}, 1.0, 1.0),
    "metallicRoughnessTexture": ({"metallic": 0.5 * BLUE, "roughness": 0.8 * GREEN}, 1.0, 1.0),
    "occlusionTexture": ({}, 1.0 + 0.8 * (RED - 1.0), 1.0),
    "emissiveTexture": ({}, 1.0, srgb_to_linear(TEXEL[:3])),
    "specularTexture": ({"specular": 0.7 * ALPHA}, 1.0, 1.0),
    "specularColorTexture": ({"specular_color": srgb_to_linear(TEXEL[:3]) * SOURCE.specular_color}, 1.0, 1.0),
}


def textured_square(path, kind, texel=TEXEL, specular_factor=0.7, attributes=(), model="ggx", **factors):
    specular = {"specularFactor": specular_factor, "specularColorFactor": list(SOURCE.specular_color)}
    pbr = {"baseColorFactor": [*SOURCE.base_color, 1], "metallicFactor": 0.5, "roughnessFactor": 0.8}
    material = {
        "pbrMetallicRoughness": pbr,
        "emissiveFactor": EMISSIVE.tolist(),
        "extensions": {"KHR_materials_specular": specular, "KHR_materials_ior": {"ior": 1.8}},
    }
    slot = {"index": 0} | ({"strength": 0.8} if kind == "occlusionTexture" else {})
    home = specular if "specular" in kind else pbr if kind[:1] in ("b", "m") else material
    if kind:
        home[kind] = slot
    pbr |= factors.pop("pbr", {})
    material["extensions"] |= factors
    extensions = ["KHR_materials_specular", "KHR_materials_ior"]
    images = [np.tile(texel, (4, 4, 1))] if kind else []
    return write_quad(path / "quad.gltf", material, images, extensions, attributes=attributes, model=model)


def assert_shows(device, environment, scene, view, material):
    sampler = burnish.Importance()
    got, frame = middle_color(device, scene, environment, sampler, view)
    expected = oracle_shade(levels_of(device, environment, sampler), material, sampler, UP, [1, 0, 0], view)
    np.testing.assert_allclose(got, expected, rtol=0, atol=LIMIT * expected.mean())
    return frame


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("view", [UP, STEEP], ids=["above", "steep"])
def test_texture_multiplies_its_factor(device, smooth64, kind, view, tmp_path):
    """Occlusion darkens diffuse light alone: lobes and emission keep theirs."""
    changes, occlusion, glow = KINDS[kind]
    scene = textured_square(tmp_path, kind)
    mapped = map_metallic_roughness(replace(SOURCE, **changes))
    expected = replace(mapped, diffuse=occlusion * mapped.diffuse, emissive=EMISSIVE * glow)
    if "specular" in kind:
        # Beside metal all of the lobe stands for its dielectric part, which the texture varies.
        expected = replace(expected, covers=((None, False),))
    assert_shows(device, smooth64, scene, view, expected)


@pytest.mark.parametrize("kind", ["", "baseColorTexture"], ids=["plain", "textured"])
def test_vertex_colour_multiplies_the_base(device, smooth64, kind, tmp_path):
    color = np.array([0.25, 0.5, 0.75])
    scene = textured_square(tmp_path, kind, attributes=[("COLOR_0", "VEC3", [color] * 4)])
    base = color * SOURCE.base_color * (srgb_to_linear(TEXEL[:3]) if kind else 1.0)
    mapped = map_metallic_roughness(replace(SOURCE, base_color=base))
    assert_shows(device, smooth64, scene, UP, replace(mapped, emissive=EMISSIVE))


@pytest.mark.parametrize("model", ["ggx", "kurt"])
@pytest.mark.parametrize("kind", ["specularTexture", "specularColorTexture"])
def test_texture_that_lowers_a_full_reflectance_brings_diffuse_light(device, smooth64, kind, model, tmp_path):
    """An ior of 0 stands for infinity: the factors alone reflect all, and leave nothing to the base."""
    mirror = {"ior": 0}
    scene = textured_square(
        tmp_path,
        kind,
        specular_factor=1.0,
        KHR_materials_ior=mirror,
        pbr={"metallicFactor": 0.0},
        model=model,
    )
    source = replace(SOURCE, metallic=0.0, ior=1e9, specular=1.0)
    assert map_metallic_roughness(source, model="kurt").diffuse.max() < 1e-6
    changes = {"specular": ALPHA} if kind == "specularTexture" else KINDS[kind][0]
    mapped = map_metallic_roughness(replace(source, **changes), model=model)
    expected = replace(mapped, emissive=EMISSIVE)
    frame = assert_shows(device, smooth64, scene, UP, expected)
    assert next(line["on"] for line in frame.report.effects if line["name"] == "diffuse")


@pytest.mark.parametrize("uv_set", [0, 1])
@pytest.mark.parametrize("through", ["texCoord", "transform"])
def test_texture_is_read_by_its_own_coordinates(device, smooth64, uv_set, through, rng, tmp_path):
    """The second set swaps u and v; an offset of a texel rolls the picture, a scale of 2 repeats it."""
    texels = quantized(rng.random((4, 4, 3)))
    transform = {"offset": [0.25, 0.5], "scale": [2, 1]}
    slot = {"index": 0, "texCoord": uv_set}
    if through == "transform":  # whose set stands before the other
        transform |= {"texCoord": uv_set}
        slot["texCoord"] = 1 - uv_set
    slot["extensions"] = {"KHR_texture_transform": transform}
    pbr = {"baseColorTexture": slot, "metallicFactor": 0.0, "roughnessFactor": 0.8}
    swapped = [("TEXCOORD_1", "VEC2", [[1, 0], [1, 1], [0, 1], [0, 0]])]
    extensions = ["KHR_texture_transform"]
    material = {"pbrMetallicRoughness": pbr}
    scene = write_quad(tmp_path / "quad.gltf", material, [texels], extensions, attributes=swapped)
    got, _ = texel_colors(device, scene, smooth64, burnish.Importance())
    rolled = texels[[2, 3, 0, 1]][:, [2, 0, 2, 0]]  # pixels lie in the first half of a texel along both
    seen = srgb_to_linear(rolled if uv_set == 0 else rolled.transpose(1, 0, 2))

    def material_at(row, column):
        source = MetallicRoughness(seen[row, column], metallic=0.0, roughness=0.8)
        return map_metallic_roughness(source)

    # Rows of the picture run along v, down: with u and v swapped, along u.
    assert_close(device, got, expected_colors(device, smooth64, material_at))


def test_emission_is_seen_through_a_black_base(device, smooth64, tmp_path):
    scene = textured_square(tmp_path, "occlusionTexture", np.zeros(4), pbr={"baseColorFactor": [0, 0, 0, 1]})
    mapped = map_metallic_roughness(replace(SOURCE, base_color=(0.0, 0.0, 0.0)))
    frame = assert_shows(device, smooth64, scene, UP, replace(mapped, emissive=EMISSIVE))
    assert not next(line["on"] for line in frame.report.effects if line["name"] == "diffuse")
