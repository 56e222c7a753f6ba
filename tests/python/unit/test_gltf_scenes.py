"""What a file may say and what a scene says back: ranges, instances, extensions, nothing to draw."""

import numpy as np
import pytest

import burnish
from burnish.rendering import plan
from gltf_support import SQUARE, SQUARE_INDICES, GltfFile

LEGAL = {
    "alphaCutoff above 1": {"alphaMode": "MASK", "alphaCutoff": 1.5},
    "alphaCutoff far above 1": {"alphaMode": "MASK", "alphaCutoff": 1e30},
    "alphaCutoff 0": {"alphaMode": "MASK", "alphaCutoff": 0},
    "ior 0": {"extensions": {"KHR_materials_ior": {"ior": 0}}},
    "ior 1": {"extensions": {"KHR_materials_ior": {"ior": 1}}},
    "ior above 1000": {"extensions": {"KHR_materials_ior": {"ior": 5000}}},
    "ior that is all floats have": {"extensions": {"KHR_materials_ior": {"ior": 3e38}}},
    "specular colour above 1": {
        "extensions": {"KHR_materials_specular": {"specularColorFactor": [0, 7, 1e30]}}
    },
    "emissive strength": {
        "emissiveFactor": [1, 0, 1],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1e30}},
    },
    "anisotropy turned often": {
        "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1, "anisotropyRotation": -1e4}}
    },
    "all at their ends": {
        "pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 1], "metallicFactor": 1, "roughnessFactor": 0},
        "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 1}},
    },
}


def load(tmp_path, material=None, **document):
    file = GltfFile()
    file.document |= {"nodes": [{"mesh": file.square(material)}]} | document
    return burnish.Scene.from_file(file.write(tmp_path / "scene.gltf"))


@pytest.mark.parametrize("material", LEGAL.values(), ids=LEGAL.keys())
def test_every_value_that_gltf_allows_is_read_as_it_is(tmp_path, material):
    scene = load(tmp_path, material)
    assert scene.warnings == []
    if "alphaCutoff" in material:
        assert scene.materials[0].alpha_cutoff == np.float32(material["alphaCutoff"])


def test_reflectance_of_great_refractive_indices(tmp_path):
    """r0 = ((ior - 1)/(ior + 1))^2, not that of a smaller index."""
    for ior in (1.0, 1.33, 5000.0, 3e38):
        lobe = (
            load(
                tmp_path,
                {"pbrMetallicRoughness": {"metallicFactor": 0}}
                | {"extensions": {"KHR_materials_ior": {"ior": ior}}},
            )
            .materials[0]
            .lobes[0]
        )
        np.testing.assert_allclose(lobe.r0, ((ior - 1) / (ior + 1)) ** 2, rtol=1e-6)


@pytest.mark.parametrize(
    ("material", "text"),
    [
        ({"alphaMode": "MASK", "alphaCutoff": -0.5}, ".alphaCutoff: expected 0.."),
        (
            {"pbrMetallicRoughness": {"roughnessFactor": 1.5}},
            ".roughnessFactor: expected 0..1, got 1.5: taken as 1",
        ),
        ({"extensions": {"KHR_materials_ior": {"ior": 0.5}}}, ".ior: expected 1.."),
        (
            {"extensions": {"KHR_materials_specular": {"specularFactor": 2}}},
            ".specularFactor: expected 0..1, got 2",
        ),
    ],
)
def test_values_that_gltf_forbids_warn(tmp_path, material, text):
    assert any(text in sentence for sentence in load(tmp_path, material).warnings)


CHANGING = [
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_node_visibility",
]


@pytest.mark.parametrize("name", CHANGING)
def test_extensions_that_change_the_picture_say_what_is_drawn_instead(tmp_path, name):
    scene = load(tmp_path, extensionsUsed=[name])
    (sentence,) = scene.warnings
    assert sentence.startswith(f"{name}: ") and "not known" not in sentence
    assert scene.ignored_extensions == [name]


def test_unknown_extensions_are_named_and_harmless_ones_are_not(tmp_path):
    scene = load(
        tmp_path, extensionsUsed=["FB_ngon_encoding", "KHR_materials_unlit", "KHR_xmp_json_ld", "VENDOR_glow"]
    )
    assert scene.warnings == ["VENDOR_glow: not known here, drawn as if it were not there"]
    assert scene.ignored_extensions == ["FB_ngon_encoding", "KHR_xmp_json_ld", "VENDOR_glow"]


@pytest.mark.parametrize(
    "document",
    [
        {"nodes": [{}]},
        {"nodes": [{"mesh": 0}, {}], "scenes": [{"nodes": [1]}]},
        {"nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}]},
    ],
    ids=["no mesh", "a mesh in another scene", "points"],
)
def test_a_file_that_shows_nothing_says_so(tmp_path, document):
    scene = load(tmp_path, **document)
    assert "nothing is drawn: no node of the scene has a mesh with triangles" in scene.warnings
    assert "nothing is drawn: the scene has no objects" in plan(scene)["warnings"]


def test_a_scene_below_its_cutoff_says_so(tmp_path):
    scene = load(tmp_path, {"alphaMode": "MASK", "alphaCutoff": 1.5})
    assert any(text.startswith("nothing is drawn: every object") for text in plan(scene)["warnings"])
    assert not any("nothing is drawn" in text for text in plan(load(tmp_path))["warnings"])


def instanced(**attributes):
    file = GltfFile()
    places = {name: file.accessor(values) for name, values in attributes.items()}
    node = {"mesh": file.square(), "translation": [0, 0, 1], "scale": [2, 2, 2]}
    node["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": places}}
    file.document["nodes"] = [node]
    return file


def test_every_instance_of_a_node_is_drawn(tmp_path):
    """World = node, translation, rotation, scale of the instance, in this order."""
    half = np.sqrt(0.5)
    translations = np.float32([[0, 0, 0], [10, 0, 0], [0, 20, 5]])
    rotations = np.float32([[0, 0, 0, 1], [0, 0, half, half], [0, 0, 0, 1]])
    scales = np.float32([[1, 1, 1], [1, 3, 1], [0.5, 0.5, 0.5]])
    file = instanced(TRANSLATION=translations, ROTATION=rotations, SCALE=scales)
    scene = burnish.Scene.from_file(file.write(tmp_path / "scene.gltf"))
    assert scene.warnings == [] and scene.ignored_extensions == []
    assert len({one.name for one in scene.objects}) == 3 and len({one.mesh for one in scene.objects}) == 1
    expected = [[(-2, -2, 1), (2, 2, 1)], [(14, -2, 1), (26, 2, 1)], [(-1, 39, 11), (1, 41, 11)]]
    np.testing.assert_allclose([one.bounds() for one in scene.objects], expected, atol=1e-5)


def test_instances_by_the_hundred_and_by_rotation_alone(tmp_path):
    grid = np.stack(np.meshgrid(*[np.arange(5)] * 3), -1).reshape(-1, 3).astype(np.float32)
    scene = burnish.Scene.from_file(instanced(TRANSLATION=grid).write(tmp_path / "scene.gltf"))
    assert len(scene.objects) == 125 and scene.triangle_count == 250
    quarter = np.int8([[0, 0, 90, 90], [0, 0, 0, 127]])
    file = instanced(ROTATION=quarter)
    file.document["accessors"][0]["normalized"] = True
    scene = burnish.Scene.from_file(file.write(tmp_path / "turned.gltf"))
    assert len(scene.objects) == 2


def test_instances_that_disagree_are_named(tmp_path):
    file = instanced(TRANSLATION=np.zeros((3, 3), np.float32), SCALE=np.ones((2, 3), np.float32))
    with pytest.raises(
        burnish.FileError,
        match=r"EXT_mesh_gpu_instancing.SCALE: expected as many as TRANSLATION \(3\), got 2",
    ):
        burnish.Scene.from_file(file.write(tmp_path / "scene.gltf"))


@pytest.mark.parametrize(("distance", "lost"), [(1e3, None), (1e6, 5), (1e9, 7)])
def test_meshes_that_32_bit_floats_do_not_hold_say_so(tmp_path, distance, lost):
    file = GltfFile()
    positions = np.float32(SQUARE["POSITION"] + [0, distance, 0])
    file.document["nodes"] = [{"mesh": file.mesh({"POSITION": positions}, SQUARE_INDICES)}]
    scene = burnish.Scene.from_file(file.write(tmp_path / "scene.gltf"))
    sentences = [text for text in scene.warnings if "32-bit floats" in text]
    if lost is None:
        assert sentences == []
    else:
        (sentence,) = sentences
        assert (
            "meshes[0].primitives[0]: POSITION:" in sentence
            and f"{lost} of their 7 decimal digits" in sentence
        )
