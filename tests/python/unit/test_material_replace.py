"""A material with some of its parts replaced."""

import numpy as np
import pytest

import burnish
from gltf_support import GltfFile

LOBES = [burnish.GgxLobe(0.3, r0=0.04), burnish.PhongLobe(50.0, weight=0.2)]


def test_what_is_not_given_stays():
    base = burnish.Material(0.5, LOBES, emissive=0.1, name="paint", double_sided=True, layered=True)
    red = base.replace(diffuse=(0.8, 0.1, 0.1))
    np.testing.assert_allclose(red.diffuse, (0.8, 0.1, 0.1))
    np.testing.assert_allclose(red.emissive, 0.1)
    assert (red.name, red.double_sided, red.layered) == ("paint", True, True)
    assert list(map(repr, red.lobes)) == list(map(repr, LOBES)) and red.covers == base.covers
    assert base.diffuse == (0.5, 0.5, 0.5)
    dark = base.replace(emissive=0.0, name="dark", double_sided=False)
    assert (dark.emissive, dark.name, dark.double_sided) == ((0, 0, 0), "dark", False)


def test_layers_follow_the_lobes():
    base = burnish.Material(0.5, LOBES, layered=True)
    assert len(base.replace(lobes=LOBES[:1]).covers) == 1
    assert base.replace(layered=False).covers is None
    assert len(base.replace(layered=False).replace(layered=True).covers) == 2
    assert base.replace(lobes=[burnish.GgxLobe(0.3, weight=0.0)]).left_out


def test_numbers_out_of_range_are_refused():
    with pytest.raises(ValueError, match=r"diffuse: expected 0..1, got 2"):
        burnish.Material(0.5).replace(diffuse=2.0)


def test_textures_keep_what_they_say(tmp_path):
    """Factors of glTF may be replaced, textures not."""
    plain = burnish.Material.metallic_roughness(0.5)
    assert not plain.replace(diffuse=0.2).is_metallic_roughness
    assert plain.replace(name="plain").is_metallic_roughness
    file = GltfFile()
    texture = file.texture(np.linspace(0, 1, 48).reshape(4, 4, 3))
    mesh = file.square({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}}})
    file.document |= {"nodes": [{"mesh": mesh}]}
    material = burnish.Scene.from_file(file.write(tmp_path / "scene.gltf")).materials[0]
    assert material.replace(emissive=1.0).is_metallic_roughness
    with pytest.raises(ValueError, match="expected none for a material whose textures"):
        material.replace(diffuse=0.1)
