"""What changes no pixel is found when it is set and left out: the picture stays, the price goes."""

import numpy as np
import pytest

import burnish
from textured_quad import is_on, middle_color, quantized, write_quad

TEXEL = quantized(np.array([0.85, 0.7, 0.4, 0.6]))
FLAT = np.array([128, 127, 255]) / 255
PBR = {"baseColorFactor": [0.7, 0.5, 0.3, 1], "metallicFactor": 0.4, "roughnessFactor": 0.8}
EXTENSIONS = {
    "KHR_materials_specular": {"specularFactor": 0.7, "specularColorFactor": [1.0, 0.8, 0.5]},
    "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 0.4},
    "KHR_materials_clearcoat": {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.5},
}
# Slot, where it is, the texel that all of the texture has, and the line of the report.
KINDS = {
    "baseColorTexture": ("pbrMetallicRoughness", TEXEL, "base colour texture"),
    "metallicRoughnessTexture": ("pbrMetallicRoughness", TEXEL, "metallic-roughness texture"),
    "normalTexture": ("", FLAT, "normal mapping"),
    "occlusionTexture": ("", np.ones(3), "occlusion texture"),
    "emissiveTexture": ("", TEXEL, "emissive texture"),
    "specularTexture": ("KHR_materials_specular", TEXEL, "specular texture"),
    "specularColorTexture": ("KHR_materials_specular", TEXEL, "specular colour texture"),
    "anisotropyTexture": ("KHR_materials_anisotropy", TEXEL, "anisotropy texture"),
    "clearcoatTexture": ("KHR_materials_clearcoat", TEXEL, "clear coat texture"),
    "clearcoatRoughnessTexture": ("KHR_materials_clearcoat", TEXEL, "clear coat roughness texture"),
    "clearcoatNormalTexture": ("KHR_materials_clearcoat", FLAT, "clear coat normal mapping"),
}
VIEW = np.array([0.48, -0.36, 0.8])


def square(path, kind, texels, leave_out_idle, **more):
    home, _, _ = KINDS[kind]
    extensions = {name: dict(fields) for name, fields in EXTENSIONS.items()}
    # Beside metal a texture of specular makes all of the lobe stand for its dielectric part (maths 1).
    pbr = PBR | ({"metallicFactor": 0.0} if "specular" in kind else {})
    material = {
        "pbrMetallicRoughness": pbr,
        "emissiveFactor": [0.3, 0.2, 0.4],
        "extensions": extensions,
    }
    slots = material if not home else material.get(home) or extensions[home]
    slots[kind] = {"index": 0}
    return write_quad(path, material, [texels], list(extensions), leave_out_idle=leave_out_idle, **more)


@pytest.mark.parametrize("kind", KINDS)
def test_texture_of_one_value_becomes_a_factor(device, smooth64, kind, tmp_path):
    _, texel, line = KINDS[kind]
    texels = np.tile(texel, (4, 4, 1))
    kept = square(tmp_path / "kept.gltf", kind, texels, False)
    without = square(tmp_path / "without.gltf", kind, texels, True)
    assert without.materials[0].left_out == [f"{line} is of one value"]
    assert kept.materials[0].left_out == []
    sampler = burnish.Matched(14)
    expected, drawn = middle_color(device, kept, smooth64, sampler, VIEW)
    got, frame = middle_color(device, without, smooth64, sampler, VIEW)
    # By half precision, the tables over all roughnesses and placement at points.
    np.testing.assert_allclose(got, expected, rtol=2e-2)
    assert is_on(drawn, line) and not is_on(frame, line)
    parts = [entry for entry in frame.report.effects if entry["name"] == "part without effect"]
    assert [entry["reason"] for entry in parts] == [f"a material: left out, as {line} is of one value"]


@pytest.mark.parametrize("kind", KINDS)
def test_texture_of_two_values_stays(kind, tmp_path):
    texels = np.tile(KINDS[kind][1], (4, 4, 1))
    texels[3, 3] = 0.5
    scene = square(tmp_path / "quad.gltf", kind, texels, True)
    assert scene.materials[0].left_out == []


@pytest.mark.parametrize("kind", ["normalTexture", "clearcoatNormalTexture", "occlusionTexture"])
def test_one_value_that_no_factor_holds_stays(kind, tmp_path):
    scene = square(tmp_path / "quad.gltf", kind, np.tile(TEXEL[:3], (4, 4, 1)), True)
    assert scene.materials[0].left_out == []


@pytest.mark.parametrize(("color", "is_idle"), [((1, 1, 1), True), ((1, 1, 0.9), False)])
def test_white_vertex_colours_are_left_out(device, smooth64, color, is_idle, tmp_path):
    colors = [("COLOR_0", "VEC3", [color] * 4)]
    material = {"pbrMetallicRoughness": PBR}
    scene = write_quad(tmp_path / "quad.gltf", material, [], attributes=colors, leave_out_idle=True)
    assert scene.materials[0].left_out == (["vertex colours are white"] if is_idle else [])
    _, frame = middle_color(device, scene, smooth64, burnish.Prefiltered(), VIEW)
    assert is_on(frame, "vertex colour") is not is_idle


def test_lobes_that_reflect_nothing_are_left_out(device, smooth64):
    lobe = burnish.GgxLobe(0.2, r0=0.5)
    idle = [burnish.KurtLobe(0.1, weight=0.0), burnish.GgxLobe(0.3, r0=0.0, f90=0.0)]
    material = burnish.Material(0.2, [idle[0], lobe, idle[1]], layered=True)
    assert len(material.lobes) == 1 and material.covers == ((None, True),)
    assert material.left_out == ["lobe 3 reflects nothing", "lobe 1 reflects nothing"]
    scene = burnish.Scene.sphere(material)
    scene.environment = smooth64
    frame = burnish.render(scene, size=(8, 8), sampler=burnish.Matched(5), device=device)
    assert not is_on(frame, "lobe 2")
    # Along the surface it reflects.
    assert len(burnish.Material(lobes=[burnish.GgxLobe(0.3, r0=0.0)]).lobes) == 1
