"""Textures of a small glTF against the mapping evaluated in numpy, texel by texel."""

from dataclasses import replace

import numpy as np
import pytest

import burnish
from burnish.oracle.metallic_roughness import MetallicRoughness, map_metallic_roughness
from engine_support import unit
from textured_quad import (
    ALBEDO_LIMIT,
    CENTERS,
    LIMIT,
    PIXELS,
    TEXELS,
    assert_close,
    expected_colors,
    is_on,
    quantized,
    srgb_to_linear,
    texel_colors,
    write_quad,
)


def test_base_color_texture_is_decoded_and_upright(device, smooth64, rng, tmp_path):
    texels = quantized(rng.random((TEXELS, TEXELS, 3)))
    pbr = {
        "baseColorTexture": {"index": 0},
        "baseColorFactor": [0.5, 1.0, 0.8, 1.0],
        "metallicFactor": 0.0,
        "roughnessFactor": 0.6,
    }
    scene = write_quad(tmp_path / "quad.gltf", {"pbrMetallicRoughness": pbr}, [texels])
    got, frame = texel_colors(device, scene, smooth64, burnish.Importance())
    base = srgb_to_linear(texels) * [0.5, 1.0, 0.8]

    def material(row, column):
        return map_metallic_roughness(
            MetallicRoughness(base_color=base[row, column], metallic=0.0, roughness=0.6)
        )

    assert_close(device, got, expected_colors(device, smooth64, material))
    assert is_on(frame, "base colour texture") and not is_on(frame, "normal mapping")


@pytest.mark.parametrize("sampler", [burnish.Importance(), burnish.Prefiltered()], ids=repr)
def test_metallic_roughness_texture_drives_the_lobe(device, smooth64, sampler, rng, tmp_path):
    texels = quantized(rng.uniform(0.2, 1.0, (TEXELS, TEXELS, 3)))
    pbr = {"metallicRoughnessTexture": {"index": 0}, "roughnessFactor": 0.9, "metallicFactor": 0.7}
    pbr["baseColorFactor"] = [0.9, 0.6, 0.2, 1.0]
    scene = write_quad(tmp_path / "quad.gltf", {"pbrMetallicRoughness": pbr}, [texels])
    got, frame = texel_colors(device, scene, smooth64, sampler)

    def material(row, column):
        _, green, blue = texels[row, column]
        source = MetallicRoughness(base_color=(0.9, 0.6, 0.2), metallic=0.7 * blue, roughness=0.9 * green)
        return map_metallic_roughness(source)

    limit = ALBEDO_LIMIT if isinstance(sampler, burnish.Prefiltered) else LIMIT
    assert_close(device, got, expected_colors(device, smooth64, material, sampler=sampler), limit)
    assert is_on(frame, "metallic-roughness texture")


def test_normal_texture_bends_the_normal(device, smooth64, rng, tmp_path):
    slopes = rng.uniform(-0.6, 0.6, (TEXELS, TEXELS, 2))
    bent = unit(np.concatenate([slopes, np.ones((TEXELS, TEXELS, 1))], -1))
    texels = quantized(0.5 * bent + 0.5)
    material = {
        "pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.5},
        "normalTexture": {"index": 0, "scale": 0.8},
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels])
    got, frame = texel_colors(device, scene, smooth64, burnish.Importance())
    normals = unit((2 * texels - 1) * [0.8, 0.8, 1.0])
    np.testing.assert_allclose(frame.normal[np.ix_(CENTERS, CENTERS)], normals, atol=3e-4)
    same = map_metallic_roughness(MetallicRoughness(metallic=1.0, roughness=0.5))
    assert_close(device, got, expected_colors(device, smooth64, lambda row, column: same, normals))
    assert is_on(frame, "normal mapping")


def test_emissive_texture_and_strength_are_added(device, smooth64, rng, tmp_path):
    texels = quantized(rng.random((TEXELS, TEXELS, 3)))
    material = {
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.7},
        "emissiveTexture": {"index": 0},
        "emissiveFactor": [1.0, 0.5, 0.25],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 12.0}},
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels], ["KHR_materials_emissive_strength"])
    got, frame = texel_colors(device, scene, smooth64, burnish.Importance())
    base = map_metallic_roughness(MetallicRoughness(metallic=0.0, roughness=0.7))
    emitted = 12.0 * srgb_to_linear(texels) * [1.0, 0.5, 0.25]

    def glowing(row, column):
        return replace(base, emissive=emitted[row, column])

    assert_close(device, got, expected_colors(device, smooth64, glowing))
    assert is_on(frame, "emissive texture")


@pytest.mark.parametrize("sampler", [burnish.Importance(), burnish.Prefiltered()], ids=repr)
def test_clear_coat_adds_a_lobe(device, smooth64, sampler, rng, tmp_path):
    texels = quantized(rng.random((TEXELS, TEXELS, 3)))
    coat = {"clearcoatFactor": 0.8, "clearcoatTexture": {"index": 0}, "clearcoatRoughnessFactor": 0.4}
    material = {
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.7},
        "extensions": {"KHR_materials_clearcoat": coat},
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels], ["KHR_materials_clearcoat"])
    got, frame = texel_colors(device, scene, smooth64, sampler)

    def coated(row, column):
        source = MetallicRoughness(
            metallic=0.0, roughness=0.7, clearcoat=0.8 * texels[row, column, 0], clearcoat_roughness=0.4
        )
        return map_metallic_roughness(source)

    assert_close(device, got, expected_colors(device, smooth64, coated, sampler=sampler))
    assert is_on(frame, "clear coat texture") and is_on(frame, "lobe 2")


def test_alpha_mask_cuts_texels_out(device, smooth64, tmp_path):
    texels = np.ones((TEXELS, TEXELS, 4))
    texels[..., 3] = np.indices((TEXELS, TEXELS)).sum(0) % 2
    material = {
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "alphaMode": "MASK",
        "alphaCutoff": 0.5,
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels])
    scene.environment = smooth64
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, far_plane=10.0)
    frame = burnish.render(scene, camera, (PIXELS, PIXELS), device=device)
    expected = np.repeat(np.repeat(texels[..., 3], PIXELS // TEXELS, 0), PIXELS // TEXELS, 1)
    np.testing.assert_array_equal(frame.alpha, expected)
    assert is_on(frame, "alpha mask")


def test_textured_and_plain_pictures_agree_where_the_texture_is_flat(device, smooth64, tmp_path):
    """A white texture changes nothing but the way: the wide G-buffer gives what the narrow one does."""
    pbr = {"baseColorFactor": [0.9, 0.5, 0.2, 1.0], "metallicFactor": 0.6, "roughnessFactor": 0.5}
    plain = write_quad(tmp_path / "plain.gltf", {"pbrMetallicRoughness": pbr}, [])
    white = np.ones((TEXELS, TEXELS, 3))
    textured = {"pbrMetallicRoughness": pbr | {"baseColorTexture": {"index": 0}}}
    other = write_quad(tmp_path / "textured.gltf", textured, [white])
    for sampler in (burnish.Importance(), burnish.Prefiltered(), burnish.Reference(method="quadrature")):
        expected, _ = texel_colors(device, plain, smooth64, sampler)
        got, _ = texel_colors(device, other, smooth64, sampler)
        assert_close(device, got, expected)


@pytest.mark.parametrize("power", [-40, -20, 20, 40])
def test_emission_of_a_texture_scales_with_its_factor(tmp_path, device, rng, power):
    """The wide G-buffer holds it in half floats, over a power of two of the material's own."""
    texels = rng.uniform(0.01, 1, (TEXELS, TEXELS, 3))
    factor = [0.75, 0.5, 2.0**-6]

    def picture(strength):
        extensions = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
        emission = {"emissiveFactor": factor, "emissiveTexture": {"index": 0}, "extensions": extensions}
        scene = write_quad(tmp_path / "quad.gltf", emission, [texels], extensions)
        return texel_colors(device, scene, burnish.environments.uniform(0.0), burnish.Prefiltered())[0]

    expected = picture(1.0)
    assert (expected > 0).all()
    np.testing.assert_array_equal(np.ldexp(picture(2.0**power), -power), expected)
